//! Types of objects as data: what a plan says of one, as a record of a file of objects.

use lisp::image::Image;
use lisp::print;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The keys whose values are names, which may be written as keywords.
const NAMES: [&str; 2] = ["KIND", "GRASPS"];

/// The record `(object NAME KEY VALUE …)` of a property list.
pub(super) fn record(image: &Image, name: &str, properties: &Value) -> Result<String> {
    let mut text = format!("(object {name}");
    let items = properties.list_to_vec().unwrap_or_default();
    let mut mesh = None;
    for pair in items.chunks(2) {
        let key = pair[0].as_symbol().filter(|key| image.is_keyword(*key));
        let (Some(key), Some(value)) = (key, pair.get(1)) else {
            return Err(Raise::simple(format!(
                "{} is no key with a value: (def-object-type {name} :shapes '((sphere :radius 0.03)) :mass 0.1) was expected.",
                print::to_string(image, &pair[0], true)
            )));
        };
        let key = image.name(key);
        match key {
            "MESH" => mesh = Some((value.clone(), mesh.and_then(|(_, scale)| scale))),
            "SCALE" => {
                let file = mesh.map_or(Value::NIL, |(file, _)| file);
                mesh = Some((file, Some(value.clone())));
            }
            _ => {
                text.push_str(&format!(" :{} ", key.to_lowercase()));
                write(image, value, NAMES.contains(&key), &mut text)?;
            }
        }
    }
    if let Some((file, scale)) = mesh {
        text.push_str(" :shapes ((mesh ");
        write(image, &file, false, &mut text)?;
        if let Some(scale) = scale {
            text.push_str(" :scale ");
            write(image, &scale, false, &mut text)?;
        }
        text.push_str("))");
    }
    text.push(')');
    Ok(text)
}

/// Writes a value as data; keywords are names if `as_names`.
fn write(image: &Image, value: &Value, as_names: bool, text: &mut String) -> Result<()> {
    match value {
        Value::Cons(_) => {
            text.push('(');
            for item in value.list_to_vec().unwrap_or_default() {
                write(image, &item, as_names, text)?;
                text.push(' ');
            }
            text.push(')');
        }
        value if !value.is_true() => text.push_str("()"),
        Value::Symbol(sym, ..) => {
            if image.is_keyword(*sym) && !as_names {
                text.push(':');
            }
            let name = image.name(*sym).to_lowercase().replace('_', "-");
            let is_plain = |c: char| c.is_alphanumeric() || "-+*/.<>=!?".contains(c);
            if name.is_empty() || !name.chars().all(is_plain) {
                return Err(Raise::simple(format!(
                    "{} is no name of a type, a shape or a key.",
                    print::to_string(image, value, true)
                )));
            }
            text.push_str(&name);
        }
        Value::Str(string) => text.push_str(&quoted(&string.text())),
        Value::Int(number) => text.push_str(&number.to_string()),
        Value::Single(number) if number.is_finite() => text.push_str(&format!("{number:?}")),
        other => match number::to_f64(other).filter(|number| number.is_finite()) {
            Some(number) => text.push_str(&format!("{number:?}")),
            // A pathname, for one, is written as its text.
            None => match print::to_string(image, other, true).strip_prefix("#P") {
                Some(path) => text.push_str(path),
                None => {
                    return Err(Raise::simple(format!(
                        "{} is no part of a type of objects: a name, a number, a text or a list of these was expected.",
                        print::to_string(image, other, true)
                    )));
                }
            },
        },
    }
    Ok(())
}

/// A text between quotes.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}
