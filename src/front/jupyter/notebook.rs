//! Notebooks made of Markdown with transcripts: each input becomes a cell, without its output.

use serde_json::{Value, json};

use crate::transcript::{Transcript, session_blocks};

/// The notebook of a Markdown file, as JSON, for the kernel of that name.
pub(crate) fn notebook(file: &str, text: &str, kernel: &str) -> String {
    let transcript = Transcript::parse(file, text);
    let lines = &transcript.lines;
    let mut cells = Vec::new();
    let mut done = 0;
    for block in session_blocks(lines) {
        // The line before a block opens it.
        let before = lines.get(done..block.start.saturating_sub(1));
        explain(before.unwrap_or_default(), &mut cells);
        let inside = |line: usize| block.contains(&(line - 1));
        for entry in transcript.entries.iter().filter(|e| inside(e.line)) {
            let input = entry.input.trim_end();
            if !input.is_empty() {
                cells.push(cell(cells.len(), "code", input));
            }
        }
        done = block.end + 1;
    }
    explain(lines.get(done..).unwrap_or_default(), &mut cells);
    let notebook = json!({
        "cells": cells,
        "metadata": {
            "kernelspec": {"name": kernel, "display_name": kernel, "language": "plan"},
            "language_info": {"name": "plan", "file_extension": ".plan"},
        },
        "nbformat": 4,
        "nbformat_minor": 5,
    });
    format!("{notebook:#}\n")
}

/// Adds cells of text, one for each heading.
fn explain(lines: &[String], cells: &mut Vec<Value>) {
    let mut text = String::new();
    let mut is_fenced = false;
    let mut add = |text: &mut String| {
        let trimmed = text.trim();
        if !trimmed.is_empty() {
            cells.push(cell(cells.len(), "markdown", trimmed));
        }
        text.clear();
    };
    for line in lines {
        if line.trim_start().starts_with("```") {
            is_fenced = !is_fenced;
        }
        if !is_fenced && line.starts_with('#') {
            add(&mut text);
        }
        text.push_str(line);
        text.push('\n');
    }
    add(&mut text);
}

fn cell(number: usize, kind: &str, text: &str) -> Value {
    let source: Vec<&str> = text.split_inclusive('\n').collect();
    let mut cell = json!({
        "cell_type": kind,
        "id": format!("cell-{}", number + 1),
        "metadata": {},
        "source": source,
    });
    if kind == "code" {
        cell["execution_count"] = Value::Null;
        cell["outputs"] = json!([]);
    }
    cell
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_become_cells_between_the_text() {
        let text =
            "# A\nb\n## C\n```session\nX> (a\n  1)\n2\nX> (b)\n```\n\n```lisp\n# no\n```\nend\n";
        let notebook: Value = serde_json::from_str(&notebook("t.md", text, "k")).expect("JSON");
        let cells = notebook["cells"].as_array().expect("a list");
        let shown: Vec<String> = cells
            .iter()
            .map(|cell| {
                let source = cell["source"].as_array().expect("lines");
                let lines: Vec<&str> = source.iter().filter_map(Value::as_str).collect();
                format!("{} {}", cell["cell_type"], lines.concat())
            })
            .collect();
        assert_eq!(
            shown,
            [
                "\"markdown\" # A\nb",
                "\"markdown\" ## C",
                "\"code\" (a\n  1)",
                "\"code\" (b)",
                "\"markdown\" ```lisp\n# no\n```\nend"
            ]
        );
        assert_eq!(notebook["metadata"]["kernelspec"]["name"], json!("k"));
    }
}
