//! Questions about the implementation.

use crate::lisp::builtin::{Builtin, pure};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::VariableKind;

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = &[
    pure(
        "CONSTANTP",
        "form &optional environment",
        "Does the form always have the same value?",
        &["(constantp 5) => T", "(constantp '(+ 1 2)) => NIL"],
        constantp,
    ),
    pure(
        "COMPILED-FUNCTION-P",
        "object",
        "Is it a function? All functions are compiled.",
        &["(compiled-function-p #'car) => T"],
        |_, args| Ok(matches!(args[0], Value::Function(_)).into()),
    ),
    pure(
        "LISP-IMPLEMENTATION-TYPE",
        "",
        "The name of the implementation.",
        &["(lisp-implementation-type) => \"planwright\""],
        |_, _| Ok(env!("CARGO_PKG_NAME").into()),
    ),
    pure(
        "LISP-IMPLEMENTATION-VERSION",
        "",
        "The version of the implementation.",
        &["(stringp (lisp-implementation-version)) => T"],
        |_, _| Ok(env!("CARGO_PKG_VERSION").into()),
    ),
];

fn constantp(image: &mut Image, args: &[Value]) -> Result<Value, Box<Raise>> {
    let is_constant = match &args[0] {
        Value::Symbol(sym) => image.symbol(*sym).kind == VariableKind::Constant,
        Value::Cons(cons) => cons.car().as_symbol() == Some(known::QUOTE),
        _ => true,
    };
    Ok(is_constant.into())
}
