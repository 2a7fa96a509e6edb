//! Answers to questions about a text that is being typed.

use serde_json::{Value, json};

use crate::prompt::indent::indentation;
use crate::prompt::pasted::Inputs;
use lisp::reader::{Completeness, is_complete};
use session::dialogue::Illustrate;

/// The byte at which a character of a text begins; clients count characters.
fn byte_at(text: &str, character: usize) -> usize {
    let found = text.char_indices().nth(character);
    found.map_or(text.len(), |(byte, _)| byte)
}

/// The text and the byte of the cursor in a request.
fn cursor(content: &Value) -> (&str, usize) {
    let code = content.get("code").and_then(Value::as_str).unwrap_or("");
    let at = content.get("cursor_pos").and_then(Value::as_u64);
    let at = at.and_then(|at| usize::try_from(at).ok());
    (code, at.map_or(code.len(), |at| byte_at(code, at)))
}

/// The answer to a `complete_request`.
pub(crate) fn complete(session: &impl Illustrate, content: &Value) -> Value {
    let (code, at) = cursor(content);
    let found = session.completions(code, at);
    let characters = |end: usize| code.get(..end).unwrap_or(code).chars().count();
    let matches: Vec<&str> = found.candidates.iter().map(|c| c.text.as_str()).collect();
    json!({
        "status": "ok",
        "matches": matches,
        "cursor_start": characters(found.start.min(at)),
        "cursor_end": characters(at),
        "metadata": {},
    })
}

/// The answer to an `inspect_request`.
pub(crate) fn inspect(session: &impl Illustrate, content: &Value) -> Value {
    let (code, at) = cursor(content);
    match session.description(code, at) {
        Some(text) => {
            json!({"status": "ok", "found": true, "data": {"text/plain": text}, "metadata": {}})
        }
        None => json!({"status": "ok", "found": false, "data": {}, "metadata": {}}),
    }
}

/// The answer to an `is_complete_request`.
pub(crate) fn whole(content: &Value) -> Value {
    let code = content.get("code").and_then(Value::as_str).unwrap_or("");
    match is_complete(code) {
        Completeness::Complete => json!({"status": "complete"}),
        Completeness::Unmatched { .. } => json!({"status": "invalid"}),
        // A pasted session has prompts.
        Completeness::Incomplete { .. } if Inputs::of(code).are_whole() => {
            json!({"status": "complete"})
        }
        Completeness::Incomplete { .. } => {
            json!({"status": "incomplete", "indent": " ".repeat(indentation(code, 0))})
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_are_counted_not_bytes() {
        assert_eq!(byte_at("aé😀b", 3), 7);
        assert_eq!(byte_at("aé", 9), 3);
        let content = json!({"code": "(é c", "cursor_pos": 3});
        assert_eq!(cursor(&content), ("(é c", 4));
    }

    #[test]
    fn an_input_is_whole_or_goes_on() {
        let status = |code: &str| whole(&json!({"code": code}));
        assert_eq!(status("(+ 1 2)"), json!({"status": "complete"}));
        assert_eq!(
            status("(let ((a 1))"),
            json!({"status": "incomplete", "indent": "  "})
        );
        assert_eq!(status("(a))"), json!({"status": "invalid"}));
    }
}
