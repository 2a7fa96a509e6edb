//! The printer.

use super::image::Image;
use super::value::Value;

/// A stand-in until the printer is here.
pub fn to_string(image: &Image, value: &Value, escape: bool) -> String {
    let mut out = String::new();
    let mut rest = value.clone();
    match value {
        Value::Cons(_) => {
            out.push('(');
            while let Value::Cons(c) = &rest {
                if out.len() > 1 {
                    out.push(' ');
                }
                out.push_str(&to_string(image, &c.car(), escape));
                let next = c.cdr();
                rest = next;
            }
            if !rest.is_nil() {
                out.push_str(" . ");
                out.push_str(&to_string(image, &rest, escape));
            }
            out.push(')');
        }
        Value::Symbol(s) => out.push_str(image.name(*s)),
        Value::Int(n) => out.push_str(&n.to_string()),
        Value::Str(s) => out.push_str(&s.text()),
        Value::Foreign(f) => out = f.object().print(image, escape),
        Value::Instance(i) => {
            out = super::condition::report(value)
                .unwrap_or_else(|| image.name(i.class().name).to_owned());
        }
        _ => out.push_str("#<?>"),
    }
    out
}

#[cfg(test)]
pub(crate) mod test_image;
