//! Reads tables of layouts.

use std::sync::Arc;

use indexmap::IndexMap;
use thiserror::Error;

use super::layouts::{Field, FieldType, Multiplicity, Scalar};
use crate::Distribution;

/// A mistake in a table of layouts.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LayoutError {
    /// A line that cannot be read.
    #[error("line {line} of the table of messages: {wrong}")]
    Line {
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        wrong: String,
    },
    /// A field of a message that there is not.
    #[error("the table of messages: {message} has a field of type {missing}, which is not in it")]
    Missing {
        /// The message.
        message: String,
        /// The type of its field.
        missing: String,
    },
    /// A message that contains itself.
    #[error("the table of messages: {message} contains itself")]
    Circle {
        /// The message.
        message: String,
    },
}

type Messages = IndexMap<Arc<str>, Vec<Field>>;

/// The messages that a distribution has in a table.
pub(super) fn messages(table: &str, distribution: Distribution) -> Result<Messages, LayoutError> {
    let mut messages = Messages::new();
    // The message whose fields come next, with the first distribution that has it so.
    let mut current: Option<(Arc<str>, bool)> = None;
    let mut since: IndexMap<Arc<str>, Option<Distribution>> = IndexMap::new();
    for (i, text) in table.lines().enumerate() {
        let wrong = |wrong: String| LayoutError::Line { line: i + 1, wrong };
        let text = text.trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        if let Some(heading) = text.strip_prefix('[') {
            let heading = heading
                .strip_suffix(']')
                .ok_or_else(|| wrong(format!("{text} lacks a ] at its end")))?;
            let (name, begin) = match heading.split_once(" since ") {
                Some((name, begin)) => {
                    let begin = Distribution::named(begin.trim());
                    (name, Some(begin.map_err(|error| wrong(error.to_string()))?))
                }
                None => (heading, None),
            };
            let name: Arc<str> = name.trim().into();
            if since.get(&name).is_some_and(|before| *before >= begin) {
                return Err(wrong(format!(
                    "{name} stands there twice, or an older layout stands behind a newer one"
                )));
            }
            since.insert(Arc::clone(&name), begin);
            let applies = begin.is_none_or(|begin| begin <= distribution);
            if applies {
                messages.insert(Arc::clone(&name), Vec::new());
            }
            current = Some((name, applies));
            continue;
        }
        let field = field(text).map_err(wrong)?;
        let (name, applies) = current
            .as_ref()
            .ok_or_else(|| wrong(format!("{text} belongs to no message")))?;
        if *applies {
            let fields = messages.entry(Arc::clone(name)).or_default();
            if fields.iter().any(|known| known.name == field.name) {
                return Err(wrong(format!("{name} has two fields {}", field.name)));
            }
            fields.push(field);
        }
    }
    Ok(messages)
}

/// A field, as in `float64[9] k`.
fn field(text: &str) -> Result<Field, String> {
    let parts: Vec<&str> = text.split_whitespace().collect();
    let [kind, name] = parts.as_slice() else {
        return Err(format!(
            "{text} is no field: a type and a name were expected"
        ));
    };
    let (kind, multiplicity) = match kind.split_once('[') {
        None => (*kind, Multiplicity::One),
        Some((kind, "]")) => (kind, Multiplicity::Sequence),
        Some((kind, number)) => {
            let number = number.strip_suffix(']').and_then(|n| n.parse().ok());
            let number = number.filter(|n| (1..=1 << 16).contains(n));
            let number = number.ok_or_else(|| {
                format!("{text}: between [ and ] may be a number from 1, or nothing")
            })?;
            (kind, Multiplicity::Array(number))
        }
    };
    let integer = |bytes, signed| FieldType::Scalar(Scalar::Integer { bytes, signed });
    let kind = match kind {
        "bool" => FieldType::Scalar(Scalar::Bool),
        "int8" => integer(1, true),
        "int16" => integer(2, true),
        "int32" => integer(4, true),
        "int64" => integer(8, true),
        "byte" | "char" | "uint8" => integer(1, false),
        "uint16" => integer(2, false),
        "uint32" => integer(4, false),
        "float32" => FieldType::Scalar(Scalar::Single),
        "float64" => FieldType::Scalar(Scalar::Double),
        "string" => FieldType::Text,
        message if message.contains('/') => FieldType::Message(message.into()),
        other => return Err(format!("{text}: there is no type {other}")),
    };
    Ok(Field {
        name: (*name).into(),
        kind,
        multiplicity,
    })
}

/// Fails if a field names a message that is not there, or if a message contains itself.
pub(super) fn check(messages: &Messages) -> Result<(), LayoutError> {
    /// Looks at a message and those that it is made of, which are fewer than a table has lines.
    fn descend<'a>(
        messages: &'a Messages,
        name: &'a str,
        above: &mut Vec<&'a str>,
        done: &mut IndexMap<&'a str, ()>,
    ) -> Result<(), LayoutError> {
        if done.contains_key(name) {
            return Ok(());
        }
        if above.contains(&name) {
            return Err(LayoutError::Circle {
                message: name.to_owned(),
            });
        }
        above.push(name);
        for field in messages.get(name).into_iter().flatten() {
            let FieldType::Message(inner) = &field.kind else {
                continue;
            };
            if !messages.contains_key(inner) {
                return Err(LayoutError::Missing {
                    message: name.to_owned(),
                    missing: inner.to_string(),
                });
            }
            descend(messages, inner, above, done)?;
        }
        above.pop();
        done.insert(name, ());
        Ok(())
    }
    let mut done = IndexMap::new();
    for name in messages.keys() {
        descend(messages, name, &mut Vec::new(), &mut done)?;
    }
    Ok(())
}
