//! The tools as plain lines of JSON, for editors and tests: `{"id": 1, "tool": "check_plan", "arguments":
//! {"plan": "…"}}` is answered by `{"id": 1, "is_error": false, "text": "…", "data": …}`. The tool `tools` tells
//! which there are, with the schemas of their arguments.

use std::io::{self, BufRead, Write};

use serde_json::{Value, json};

use super::{Answer, MAX_REQUEST, TOOLS, TooLong, World, called, described, next_line};
use closest_name::closest_name;

/// The tool that tells which there are.
const TABLE: &str = "tools";
/// The fields that a request may have.
const FIELDS: [&str; 3] = ["id", "tool", "arguments"];

/// Answers requests, one on a line.
pub(crate) struct Lines {
    world: World,
}

impl Lines {
    /// For a world.
    pub(crate) fn new(world: World) -> Lines {
        Lines { world }
    }

    /// Answers what comes until it ends. What is no request is answered, too, with an error.
    pub(crate) fn serve(&mut self, input: impl BufRead, mut output: impl Write) -> io::Result<()> {
        let mut input = input;
        while let Some(line) = next_line(&mut input)? {
            let answer = match line {
                Ok(line) if line.iter().all(u8::is_ascii_whitespace) => continue,
                Ok(line) => self.answer(&line),
                Err(TooLong) => refused(
                    &Value::Null,
                    format!("a request has {MAX_REQUEST} bytes at most"),
                ),
            };
            writeln!(output, "{answer}")?;
            output.flush()?;
        }
        Ok(())
    }

    fn answer(&mut self, line: &[u8]) -> Value {
        let request: Value = match serde_json::from_slice(line) {
            Ok(request) => request,
            Err(why) => return refused(&Value::Null, format!("this is no JSON: {why}")),
        };
        let Value::Object(fields) = &request else {
            let why =
                "a request is an object: {\"id\": 1, \"tool\": \"check_plan\", \"arguments\": {…}}";
            return refused(&Value::Null, why);
        };
        let id = fields.get("id").unwrap_or(&Value::Null);
        if id.is_array() || id.is_object() {
            return refused(&Value::Null, "an id is a string or a number");
        }
        if let Some(other) = fields.keys().find(|name| !FIELDS.contains(&name.as_str())) {
            let why = match closest_name(other, FIELDS) {
                Some(near) => format!("a request has no field {other}; did you mean {near}?"),
                None => format!(
                    "a request has no field {other}; it has {}",
                    FIELDS.join(", ")
                ),
            };
            return refused(id, why);
        }
        let Some(tool) = fields.get("tool").and_then(Value::as_str) else {
            return refused(
                id,
                "tool is missing: a string was expected, such as \"check_plan\"",
            );
        };
        if tool == TABLE {
            let tools: Vec<Value> = TOOLS.iter().map(described).collect();
            return json!({"id": id, "is_error": false, "data": {"tools": tools}});
        }
        let given = fields.get("arguments").unwrap_or(&Value::Null);
        let answer = called(&mut self.world, tool, given).unwrap_or_else(Answer::refused);
        let mut answer = answer.plain();
        answer["id"] = id.clone();
        answer
    }
}

fn refused(id: &Value, why: impl Into<String>) -> Value {
    json!({"id": id, "is_error": true, "text": why.into()})
}
