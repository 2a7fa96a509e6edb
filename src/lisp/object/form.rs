//! Building the forms that definitions expand into.

use std::rc::Rc;

use crate::lisp::value::Value;
use crate::lisp::value::known;

pub(crate) use crate::lisp::compile::form::form;

/// `(quote value)`; values that evaluate to themselves stay as they are.
pub(crate) fn quote(value: impl Into<Value>) -> Value {
    let value = value.into();
    match value {
        Value::Symbol(known::NIL | known::T) | Value::Int(_) | Value::Str(_) => value,
        other => form![known::QUOTE, other],
    }
}

/// A body without its declarations and documentation.
pub(crate) struct Body {
    /// The `(declare …)` forms.
    pub(crate) declarations: Vec<Value>,
    /// The documentation string.
    pub(crate) doc: Option<Rc<str>>,
    /// The forms.
    pub(crate) forms: Value,
}

/// Takes the declarations and the documentation string off a body.
pub(crate) fn split_body(body: &Value) -> Body {
    let mut split = Body {
        declarations: Vec::new(),
        doc: None,
        forms: body.clone(),
    };
    while let Value::Cons(cons) = split.forms.clone() {
        match cons.car() {
            Value::Str(text) if split.doc.is_none() && !cons.cdr().is_nil() => {
                split.doc = Some(text.text().into());
            }
            form @ Value::Cons(_) if form.car_or_nil().as_symbol() == Some(known::DECLARE) => {
                split.declarations.push(form);
            }
            _ => break,
        }
        split.forms = cons.cdr();
    }
    split
}

/// The text of an optional documentation string as a form.
pub(crate) fn doc_form(doc: Option<&Rc<str>>) -> Value {
    doc.map_or(Value::NIL, |doc| Value::string(doc.as_ref()))
}

/// Does a form's value not depend on when or where it is evaluated? Then that value.
pub(crate) fn constant_value(form: &Value) -> Option<Value> {
    match form {
        Value::Symbol(known::NIL | known::T) => Some(form.clone()),
        Value::Symbol(_) => None,
        Value::Cons(cons) => match (cons.car().as_symbol(), cons.cdr()) {
            (Some(known::QUOTE), rest) => Some(rest.car_or_nil()),
            _ => None,
        },
        other => Some(other.clone()),
    }
}
