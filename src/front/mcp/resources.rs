//! What clients can read: the manual, the tutorial, the lessons, and the built-in plans.

use serde_json::{Value, json};

use super::World;
use crate::manual;

const TUTORIAL: &str = include_str!("../../../docs/tutorial.md");
const QUESTIONS: &str = include_str!("../../../docs/ask.md");
const SWEEPS: &str = include_str!("../../../docs/sweeps.md");

/// Address, name and description of the documents.
const DOCUMENTS: &[(&str, &str, &str)] = &[
    (
        "planwright://manual",
        "Manual",
        "Every function, action, motion, failure and type of objects",
    ),
    (
        "planwright://tutorial",
        "Tutorial",
        "How plans are written, chapter by chapter",
    ),
    (
        "planwright://questions",
        "Questions",
        "What can be asked about the world",
    ),
    (
        "planwright://sweeps",
        "Sweeps",
        "How a plan is run in many worlds",
    ),
];

/// All resources.
pub(super) fn list() -> Vec<Value> {
    let documents = DOCUMENTS.iter().map(|(uri, name, doc)| {
        json!({"uri": uri, "name": name, "description": doc, "mimeType": "text/markdown"})
    });
    let files = plan_files::LESSONS.iter().chain(plan_files::TUTORIAL);
    let files = files.map(|(file, _)| {
        json!({"uri": format!("planwright://{file}"), "name": file, "mimeType": "text/plain"})
    });
    documents.chain(files).collect()
}

/// The contents of a resource; an error says which there are.
pub(super) fn read(world: &mut World, uri: &str) -> Result<Value, String> {
    let (kind, text) = match uri {
        "planwright://manual" => ("text/markdown", manual::markdown(world.at_hand())),
        "planwright://tutorial" => ("text/markdown", TUTORIAL.to_owned()),
        "planwright://questions" => ("text/markdown", QUESTIONS.to_owned()),
        "planwright://sweeps" => ("text/markdown", SWEEPS.to_owned()),
        _ => {
            let file = uri.strip_prefix("planwright://");
            let text = file.and_then(plan_files::text_of);
            let text = text.ok_or_else(|| {
                format!("there is no resource {uri}: resources/list tells which there are")
            })?;
            ("text/plain", text.to_owned())
        }
    };
    Ok(json!({"contents": [{"uri": uri, "mimeType": kind, "text": text}]}))
}
