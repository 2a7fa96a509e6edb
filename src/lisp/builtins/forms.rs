//! Building forms in the expansions of macros.

use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::package::PackageTable;

/// The symbol of a name in `COMMON-LISP`.
pub(crate) fn cl(image: &mut Image, name: &str) -> Value {
    image.intern(PackageTable::CL, name).into()
}

/// The symbol of a name in `SYSTEM`.
pub(crate) fn system(image: &mut Image, name: &str) -> Value {
    image.intern(PackageTable::SYSTEM, name).into()
}

/// `(quote value)`.
pub(crate) fn quoted(value: Value) -> Value {
    Value::list([known::QUOTE.into(), value])
}

/// `(function name)`.
pub(crate) fn function(name: impl Into<Value>) -> Value {
    Value::list([known::FUNCTION.into(), name.into()])
}

/// `(let bindings declarations… body…)`.
pub(crate) fn let_form(
    bindings: Vec<Value>,
    declarations: Vec<Value>,
    body: impl IntoIterator<Item = Value>,
) -> Value {
    let rest: Vec<Value> = declarations.into_iter().chain(body).collect();
    Value::list_with_tail(
        [known::LET.into(), Value::list(bindings)],
        Value::list(rest),
    )
}

/// `(variable value)`.
pub(crate) fn binding(variable: &Value, value: Value) -> Value {
    Value::list([variable.clone(), value])
}

/// Splits the declarations off a body.
pub(crate) fn split_declarations(body: Vec<Value>) -> (Vec<Value>, Vec<Value>) {
    let is_declaration = |form: &Value| {
        form.as_cons()
            .is_some_and(|c| c.car().as_symbol() == Some(known::DECLARE))
    };
    let count = body.iter().take_while(|f| is_declaration(f)).count();
    let mut declarations = body;
    let forms = declarations.split_off(count);
    (declarations, forms)
}

/// `(progn forms…)`.
pub(crate) fn progn(forms: Vec<Value>) -> Value {
    Value::cons(known::PROGN.into(), Value::list(forms))
}
