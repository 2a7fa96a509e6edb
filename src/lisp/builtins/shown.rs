//! How values appear in the messages of errors.

use crate::lisp::image::Image;
use crate::lisp::value::Value;

/// A value as the printer writes it.
pub fn shown(image: &Image, value: &Value) -> String {
    match value {
        Value::Symbol(s) if image.is_keyword(*s) => format!(":{}", image.name(*s)),
        Value::Symbol(s) => image.name(*s).to_owned(),
        Value::Int(n) => n.to_string(),
        Value::Str(s) => format!("{:?}", s.text()),
        _ => "…".to_owned(),
    }
}
