//! The arguments of tools: their schemas and how they are read, from the one table of tools.

use serde_json::{Map, Value, json};

use super::table::Tool;
use closest_name::closest_name;

/// What an argument may be.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    /// A string.
    Text,
    /// One of some words.
    Word(&'static [&'static str]),
    /// An integer within bounds.
    Integer(i64, i64),
    /// A number within bounds.
    Number(f64, f64),
}

/// An argument of a tool.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parameter {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) is_required: bool,
    pub(super) doc: &'static str,
}

/// The arguments of a call, each of its kind.
pub(super) struct Arguments(Map<String, Value>);

impl Arguments {
    /// A string; empty if it was not given.
    pub(super) fn text(&self, name: &str) -> &str {
        self.0.get(name).and_then(Value::as_str).unwrap_or_default()
    }

    /// An integer.
    pub(super) fn integer(&self, name: &str) -> Option<u64> {
        self.0.get(name).and_then(Value::as_u64)
    }

    /// A number.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        self.0.get(name).and_then(Value::as_f64)
    }
}

/// A tool as clients learn of it.
pub(crate) fn described(tool: &Tool) -> Value {
    let properties = tool.parameters.iter().map(|parameter| {
        let mut schema = match parameter.kind {
            Kind::Text => json!({"type": "string"}),
            Kind::Word(words) => json!({"type": "string", "enum": words}),
            Kind::Integer(low, high) => json!({"type": "integer", "minimum": low, "maximum": high}),
            Kind::Number(low, high) => json!({"type": "number", "minimum": low, "maximum": high}),
        };
        schema["description"] = Value::from(parameter.doc);
        (parameter.name.to_owned(), schema)
    });
    let properties: Map<String, Value> = properties.collect();
    let required = tool
        .parameters
        .iter()
        .filter(|parameter| parameter.is_required);
    let required: Vec<&str> = required.map(|parameter| parameter.name).collect();
    json!({
        "name": tool.name,
        "description": tool.doc,
        "inputSchema": {
            "type": "object",
            "properties": properties,
            "required": required,
            "additionalProperties": false,
        },
    })
}

/// The arguments of a call.
///
/// # Errors
///
/// Which one is wrong, and what would be right.
pub(super) fn read(tool: &Tool, given: &Value) -> Result<Arguments, String> {
    let fields = match given {
        Value::Null => Map::new(),
        Value::Object(fields) => fields.clone(),
        _ => return Err("arguments are an object with a field for each of them".to_owned()),
    };
    for name in fields.keys() {
        if !tool
            .parameters
            .iter()
            .any(|parameter| parameter.name == name)
        {
            let names: Vec<&str> = tool.parameters.iter().map(|p| p.name).collect();
            let near = closest_name(name, names.iter().copied());
            return Err(match (near, names.as_slice()) {
                (_, []) => format!("{} takes no arguments", tool.name),
                (Some(near), _) => {
                    format!(
                        "{} takes no argument {name}; did you mean {near}?",
                        tool.name
                    )
                }
                (None, _) => format!(
                    "{} takes no argument {name}; it takes {}",
                    tool.name,
                    names.join(", ")
                ),
            });
        }
    }
    for parameter in tool.parameters {
        let name = parameter.name;
        match fields.get(name) {
            None if parameter.is_required => {
                return Err(format!("{name} is missing: {}", expected(parameter.kind)));
            }
            None => {}
            Some(value) if fits(parameter.kind, value) => {}
            Some(value) => {
                let shown: String = value.to_string().chars().take(80).collect();
                return Err(format!("{name} is {shown}: {}", expected(parameter.kind)));
            }
        }
    }
    Ok(Arguments(fields))
}

fn fits(kind: Kind, value: &Value) -> bool {
    match kind {
        Kind::Text => value.is_string(),
        Kind::Word(words) => value.as_str().is_some_and(|word| words.contains(&word)),
        Kind::Integer(low, high) => value.as_i64().is_some_and(|n| (low..=high).contains(&n)),
        Kind::Number(low, high) => value.as_f64().is_some_and(|n| (low..=high).contains(&n)),
    }
}

fn expected(kind: Kind) -> String {
    match kind {
        Kind::Text => "a string was expected".to_owned(),
        Kind::Word(words) => format!("one of {} was expected", words.join(", ")),
        Kind::Integer(low, high) => format!("an integer from {low} to {high} was expected"),
        Kind::Number(low, high) => format!("a number from {low} to {high} was expected"),
    }
}
