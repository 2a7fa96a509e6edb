//! Building forms: the tools of every macro that is written in Rust.

use std::rc::Rc;

use crate::value::Value;
use crate::value::known;

/// A list of the items; after a semicolon, the tail in which the list ends.
#[doc(hidden)]
#[macro_export]
macro_rules! __form {
    ($($item:expr),* $(,)?) => {
        $crate::value::Value::list([$($crate::value::Value::from($item)),*])
    };
    ($($item:expr),* ; $tail:expr) => {
        $crate::value::Value::list_with_tail(
            [$($crate::value::Value::from($item)),*],
            $tail,
        )
    };
}
pub use __form as form;

/// `(quote value)`, whatever the value is.
pub fn quoted(value: impl Into<Value>) -> Value {
    form![known::QUOTE, value.into()]
}

/// The forms as one form: a single form unchanged, others in a `progn`.
pub fn progn(forms: Value) -> Value {
    match &forms {
        Value::Cons(cons) if cons.cdr().is_nil() => cons.car(),
        _ => Value::cons(known::PROGN.into(), forms),
    }
}

/// `(quote value)`; values that evaluate to themselves stay as they are.
pub fn quote(value: impl Into<Value>) -> Value {
    let value = value.into();
    match value {
        Value::Symbol(known::NIL | known::T, ..) | Value::Int(_) | Value::Str(_) => value,
        other => form![known::QUOTE, other],
    }
}

/// The form that signals a style warning with a report.
pub(crate) fn style_warning(report: String) -> Value {
    form![
        known::WARN,
        quote(known::SIMPLE_STYLE_WARNING),
        known::K_FORMAT_CONTROL,
        Value::string("~a"),
        known::K_FORMAT_ARGUMENTS,
        form![known::LIST, Value::string(report)],
    ]
}

/// A body without its declarations and documentation.
pub struct Body {
    /// The `(declare …)` forms.
    pub declarations: Vec<Value>,
    /// The documentation string.
    pub doc: Option<Rc<str>>,
    pub forms: Value,
}

/// Splits the declarations and the documentation string from a body.
pub fn split_body(body: &Value) -> Body {
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

/// The form for an optional documentation string.
pub(crate) fn doc_form(doc: Option<&Rc<str>>) -> Value {
    doc.map_or(Value::NIL, |doc| Value::string(doc.as_ref()))
}

/// The value of a form that has the same value wherever and whenever it is evaluated.
pub(crate) fn constant_value(form: &Value) -> Option<Value> {
    match form {
        Value::Symbol(known::NIL | known::T, ..) => Some(form.clone()),
        Value::Symbol(..) => None,
        Value::Cons(cons) => match (cons.car().as_symbol(), cons.cdr()) {
            (Some(known::QUOTE), rest) => Some(rest.car_or_nil()),
            _ => None,
        },
        other => Some(other.clone()),
    }
}
