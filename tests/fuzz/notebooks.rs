//! Targets that are notebooks: Markdown that becomes one, and one that has been executed.

use serde_json::{Value, json};

use super::corpus;
use super::target::{Taken, Target};
use crate::jupyter::{notebook, outputs};

pub(super) fn targets() -> Vec<Target> {
    vec![
        Target {
            name: "markdown",
            share: 20,
            least_read: 90,
            words: &[
                "```session\n",
                "```\n",
                "~~~",
                "\nPP-TUT> ",
                "# ",
                "\n",
                "\r\n",
                "(",
                "\"",
                "\0",
                "\u{e4}",
            ],
            corpus: || corpus::stretches("docs", ".md"),
            open: || {
                Box::new(|input| {
                    let text = String::from_utf8_lossy(input);
                    let made = notebook("a.md", &text, "planwright");
                    let read: Value = serde_json::from_str(&made).map_err(|e| e.to_string())?;
                    outputs(&made).map_err(|error| error.to_string())?;
                    let cells = read["cells"].as_array().map_or(0, Vec::len);
                    Ok(Taken::if_read(cells > 0))
                })
            },
        },
        Target {
            name: "notebook",
            share: 20,
            least_read: 95,
            words: &[
                "{",
                "}",
                "[",
                "]",
                "\"",
                ",",
                ":",
                "null",
                "\"cells\":",
                "\"outputs\":",
                "\"text/plain\":",
                "\"traceback\":",
                "\\u0000",
                "\\ud800",
                "-1",
                "1e999",
            ],
            corpus: executed,
            open: || {
                Box::new(|input| {
                    let text = String::from_utf8_lossy(input);
                    Ok(Taken::if_read(outputs(&text).is_ok()))
                })
            },
        },
    ]
}

fn executed() -> Vec<Vec<u8>> {
    let outputs = [
        json!({"output_type": "stream", "name": "stdout", "text": ["a\n", "b"]}),
        json!({"output_type": "execute_result", "data": {"text/plain": "3"}, "metadata": {}}),
        json!({"output_type": "error", "ename": "E", "evalue": "e", "traceback": ["x", "y"]}),
        json!({"output_type": "display_data", "data": {"image/png": "AAAA"}}),
    ];
    let notebooks = outputs.into_iter().map(|output| {
        let cells = json!([
            {"cell_type": "markdown", "source": "# a"},
            {"cell_type": "code", "source": ["(list 1\n", " 2)"], "outputs": [output], "execution_count": 1},
        ]);
        json!({"cells": cells, "nbformat": 4}).to_string().into_bytes()
    });
    notebooks.collect()
}
