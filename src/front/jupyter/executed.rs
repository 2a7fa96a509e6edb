//! What an executed notebook shows, cell by cell, as the prompt would show it.

use serde_json::Value;
use thiserror::Error;

/// Why a text is no notebook.
#[derive(Debug, Error)]
pub(crate) enum NotebookError {
    /// It is not JSON.
    #[error("it is not JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// It has no cells.
    #[error("it has no cells")]
    NoCells,
}

/// The outputs of the cells with code, in order. Pictures and progress are left out.
pub(crate) fn outputs(notebook: &str) -> Result<Vec<String>, NotebookError> {
    let notebook: Value = serde_json::from_str(notebook)?;
    let cells = notebook.get("cells").and_then(Value::as_array);
    let cells = cells.ok_or(NotebookError::NoCells)?.iter();
    let code = cells.filter(|cell| cell["cell_type"] == "code");
    Ok(code.map(output).collect())
}

fn output(cell: &Value) -> String {
    let mut text = String::new();
    for output in cell["outputs"].as_array().into_iter().flatten() {
        match output["output_type"].as_str() {
            Some("stream") => text.push_str(&lines(&output["text"], "")),
            Some("execute_result") => {
                add_line(&mut text, &lines(&output["data"]["text/plain"], ""))
            }
            Some("error") => add_line(&mut text, &lines(&output["traceback"], "\n")),
            _ => {}
        }
    }
    text
}

/// A text that may be given in parts.
fn lines(value: &Value, between: &str) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(parts) => {
            let parts: Vec<&str> = parts.iter().filter_map(Value::as_str).collect();
            parts.join(between)
        }
        _ => String::new(),
    }
}

/// Adds a text on lines of its own.
fn add_line(text: &mut String, line: &str) {
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    text.push_str(line);
    text.push('\n');
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_are_shown_as_at_the_prompt() {
        let notebook = r#"{"cells": [
            {"cell_type": "markdown", "source": "a"},
            {"cell_type": "code", "outputs": [
                {"output_type": "stream", "text": ["1 ", "2"]},
                {"output_type": "display_data", "data": {"text/plain": "picture"}},
                {"output_type": "execute_result", "data": {"text/plain": "3"}}]},
            {"cell_type": "code", "outputs": [
                {"output_type": "error", "traceback": ["no", "; at 1"]}]},
            {"cell_type": "code"}]}"#;
        let outputs = outputs(notebook).expect("it is a notebook");
        assert_eq!(outputs, ["1 2\n3\n", "no\n; at 1\n", ""]);
    }

    #[test]
    fn other_texts_are_refused() {
        for text in ["", "[]", "{\"cells\": 1}"] {
            assert!(outputs(text).is_err(), "{text}");
        }
    }
}
