//! Messages between JSON and Protobuf, by the tables of their types.

use serde_json::{Map, Number, Value};

use super::schema::{Count, Field, Kind, MessageType};
use super::wire::{Content, Out, field};
use crate::watch::base64::{base64, from_base64};

/// A message as Protobuf. What the type does not know is left out.
pub(super) fn encoded(kind: &MessageType, message: &Value) -> Vec<u8> {
    let mut out = Out::default();
    for field in kind.fields {
        match (&message[field.json], field.count) {
            (Value::Array(items), Count::Many) => add_many(&mut out, field, items),
            (Value::Null, _) => {}
            (value, count) => add(&mut out, field, value, count == Count::Optional),
        }
    }
    out.0
}

fn add_many(out: &mut Out, field: &Field, items: &[Value]) {
    match field.kind {
        Kind::Double | Kind::Fixed32 if !items.is_empty() => {
            let mut packed = Vec::with_capacity(items.len() * 8);
            for item in items {
                match field.kind {
                    Kind::Double => packed.extend(item.as_f64().unwrap_or(0.0).to_le_bytes()),
                    _ => packed.extend(fixed32(item).to_le_bytes()),
                }
            }
            out.bytes(field.number, &packed);
        }
        _ => {
            for item in items {
                add(out, field, item, true);
            }
        }
    }
}

/// Adds a field; one that is zero or empty only if `is_said`, since it means the same without.
fn add(out: &mut Out, field: &Field, value: &Value, is_said: bool) {
    let number = field.number;
    match field.kind {
        Kind::Double => {
            let value = value.as_f64().unwrap_or(0.0);
            // Minus zero is written as zero.
            if is_said || value != 0.0 {
                out.double(number, value + 0.0);
            }
        }
        Kind::Fixed32 => {
            let value = fixed32(value);
            if is_said || value != 0 {
                out.fixed32(number, value);
            }
        }
        Kind::Int64 | Kind::Int32 | Kind::Names(_) | Kind::Bool => {
            let value = match value {
                Value::Bool(truth) => u64::from(*truth),
                number => number.as_u64().unwrap_or(0),
            };
            if is_said || value != 0 {
                out.number(number, value);
            }
        }
        Kind::Text => {
            let value = value.as_str().unwrap_or_default();
            if is_said || !value.is_empty() {
                out.text(number, value);
            }
        }
        Kind::Bytes => {
            let value = from_base64(value.as_str().unwrap_or_default()).unwrap_or_default();
            if is_said || !value.is_empty() {
                out.bytes(number, &value);
            }
        }
        Kind::Message(kind) => out.bytes(number, &encoded(kind, value)),
    }
}

fn fixed32(value: &Value) -> u32 {
    value
        .as_u64()
        .and_then(|v| u32::try_from(v).ok())
        .unwrap_or(0)
}

/// A message from Protobuf, with all its fields; `None` if it is malformed.
pub(super) fn decoded(kind: &MessageType, mut bytes: &[u8]) -> Option<Value> {
    let mut message = empty(kind);
    while !bytes.is_empty() {
        let (number, content, rest) = field(bytes)?;
        bytes = rest;
        let Some(field) = kind.fields.iter().find(|f| u64::from(f.number) == number) else {
            continue;
        };
        if field.count == Count::Many {
            let items = message.get_mut(field.json)?.as_array_mut()?;
            match (field.kind, content) {
                (Kind::Double | Kind::Fixed32, Content::Bytes(packed)) => {
                    unpack(field.kind, packed, items)?;
                }
                _ => items.push(value(field.kind, content)?),
            }
        } else {
            message.insert(field.json.to_owned(), value(field.kind, content)?);
        }
    }
    Some(Value::Object(message))
}

/// A message in which nothing was said.
fn empty(kind: &MessageType) -> Map<String, Value> {
    let fields = kind.fields.iter().filter(|f| f.count != Count::Optional);
    fields
        .map(|field| {
            let value = match (field.count, field.kind) {
                (Count::Many, _) => Value::Array(Vec::new()),
                (_, Kind::Double) => Value::from(0.0),
                (_, Kind::Int64 | Kind::Int32 | Kind::Fixed32 | Kind::Names(_)) => Value::from(0),
                (_, Kind::Bool) => Value::from(false),
                (_, Kind::Text | Kind::Bytes) => Value::from(""),
                (_, Kind::Message(inner)) => Value::Object(empty(inner)),
            };
            (field.json.to_owned(), value)
        })
        .collect()
}

fn unpack(kind: Kind, mut packed: &[u8], items: &mut Vec<Value>) -> Option<()> {
    while !packed.is_empty() {
        if matches!(kind, Kind::Double) {
            let (bytes, rest) = packed.split_first_chunk()?;
            items.push(double(f64::from_le_bytes(*bytes))?);
            packed = rest;
        } else {
            let (bytes, rest) = packed.split_first_chunk()?;
            items.push(u32::from_le_bytes(*bytes).into());
            packed = rest;
        }
    }
    Some(())
}

/// A number, if it is finite.
fn double(value: f64) -> Option<Value> {
    Number::from_f64(value).map(Value::Number)
}

fn value(kind: Kind, content: Content<'_>) -> Option<Value> {
    Some(match (kind, content) {
        (Kind::Double, Content::Fixed64(bytes)) => double(f64::from_le_bytes(bytes))?,
        (Kind::Fixed32, Content::Fixed32(bytes)) => u32::from_le_bytes(bytes).into(),
        (Kind::Bool, Content::Number(number)) => (number != 0).into(),
        (Kind::Int64 | Kind::Int32 | Kind::Names(_), Content::Number(number)) => number.into(),
        (Kind::Text, Content::Bytes(bytes)) => str::from_utf8(bytes).ok()?.into(),
        (Kind::Bytes, Content::Bytes(bytes)) => base64(bytes).into(),
        (Kind::Message(inner), Content::Bytes(bytes)) => decoded(inner, bytes)?,
        _ => return None,
    })
}

/// The descriptors of a type and of all types that it uses, as a `FileDescriptorSet` with a file
/// for each, those that are used first.
pub(super) fn descriptors(kind: &'static MessageType) -> Vec<u8> {
    let mut types: Vec<&MessageType> = Vec::new();
    collect(kind, &mut types);
    let mut out = Out::default();
    for kind in types {
        out.bytes(1, &file(kind));
    }
    out.0
}

/// Adds a type after those that it uses.
fn collect(kind: &'static MessageType, types: &mut Vec<&'static MessageType>) {
    for inner in used(kind) {
        collect(inner, types);
    }
    if !types.iter().any(|known| known.name == kind.name) {
        types.push(kind);
    }
}

fn used(kind: &'static MessageType) -> impl Iterator<Item = &'static MessageType> {
    kind.fields.iter().filter_map(|field| match field.kind {
        Kind::Message(inner) => Some(inner),
        _ => None,
    })
}

fn file_name(kind: &MessageType) -> String {
    let (package, name) = kind.parts();
    let folder = package.replace('.', "/");
    match package {
        "google.protobuf" => format!("{folder}/{}.proto", name.to_lowercase()),
        _ => format!("{folder}/{name}.proto"),
    }
}

/// A `FileDescriptorProto`.
fn file(kind: &'static MessageType) -> Vec<u8> {
    let mut out = Out::default();
    out.text(1, &file_name(kind));
    out.text(2, kind.parts().0);
    let mut needed: Vec<String> = used(kind).map(file_name).collect();
    needed.sort();
    needed.dedup();
    for name in needed {
        out.text(3, &name);
    }
    out.bytes(4, &descriptor(kind));
    out.text(12, "proto3");
    out.0
}

/// A `DescriptorProto`.
fn descriptor(kind: &MessageType) -> Vec<u8> {
    let mut out = Out::default();
    out.text(1, kind.parts().1);
    let mut choices = 0;
    for field in kind.fields {
        out.bytes(2, &field_descriptor(kind, field, choices));
        choices += u64::from(field.count == Count::Optional);
    }
    if let Some(names) = kind.names {
        let mut list = Out::default();
        list.text(1, names.name);
        for (number, name) in (0..).zip(names.values) {
            let mut value = Out::default();
            value.text(1, name);
            value.number(2, number);
            list.bytes(2, &value.0);
        }
        out.bytes(4, &list.0);
    }
    // What is optional counts as a choice with one alternative.
    for field in kind.fields.iter().filter(|f| f.count == Count::Optional) {
        let mut choice = Out::default();
        choice.text(1, &format!("_{}", field.name));
        out.bytes(8, &choice.0);
    }
    out.0
}

/// A `FieldDescriptorProto`.
fn field_descriptor(of: &MessageType, field: &Field, choice: u64) -> Vec<u8> {
    const OPTIONAL: u64 = 1;
    const REPEATED: u64 = 3;
    let mut out = Out::default();
    out.text(1, field.name);
    out.number(3, field.number.into());
    let is_many = field.count == Count::Many;
    out.number(4, if is_many { REPEATED } else { OPTIONAL });
    let (kind, name) = match field.kind {
        Kind::Double => (1, None),
        Kind::Int64 => (3, None),
        Kind::Int32 => (5, None),
        Kind::Fixed32 => (7, None),
        Kind::Bool => (8, None),
        Kind::Text => (9, None),
        Kind::Message(inner) => (11, Some(format!(".{}", inner.name))),
        Kind::Bytes => (12, None),
        Kind::Names(names) => (14, Some(format!(".{}.{}", of.name, names.name))),
    };
    out.number(5, kind);
    if let Some(name) = name {
        out.text(6, &name);
    }
    if field.count == Count::Optional {
        out.number(9, choice);
        out.number(17, 1);
    }
    out.0
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::watch::recording::schema;
    use crate::watch::recording::wire::varint;

    #[test]
    fn a_message_is_read_back_and_what_is_damaged_never_otherwise() {
        let message = json!({
            "timestamp": {"sec": 3, "nsec": 5},
            "joints": [{"name": "knee", "position": 0.0, "velocity": -1.5}, {"name": "é"}],
        });
        let bytes = encoded(&schema::JOINT_STATES, &message);
        assert_eq!(decoded(&schema::JOINT_STATES, &bytes), Some(message));
        for at in 0..bytes.len() {
            let _ = decoded(&schema::JOINT_STATES, &bytes[..at]);
            let mut damaged = bytes.clone();
            damaged[at] ^= 0x55;
            let _ = decoded(&schema::JOINT_STATES, &damaged);
        }
    }

    #[test]
    fn lists_of_numbers_are_packed_and_unknown_fields_skipped() {
        let message = json!({"D": [0.0, 2.0], "frame_id": "camera"});
        let mut bytes = encoded(&schema::CAMERA_CALIBRATION, &message);
        bytes.extend([0xf8, 0x07, 0x01]);
        let read = decoded(&schema::CAMERA_CALIBRATION, &bytes).unwrap();
        assert_eq!(read["D"], message["D"]);
        assert_eq!(read["K"], json!([]));
        assert_eq!(
            (read["width"].clone(), read["frame_id"].clone()),
            (0.into(), "camera".into())
        );
    }

    #[test]
    fn numbers_that_do_not_end_are_refused() {
        assert!(varint(&[0xff; 11]).is_none());
        assert_eq!(varint(&[0xac, 0x02, 9]), Some((300, &[9][..])));
    }
}
