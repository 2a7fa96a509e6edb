//! What clients can read: the manual, the tutorial, the lessons, and the built-in plans.

use serde_json::{Value, json};

use super::answer::Answer;
use super::arguments::Arguments;
use super::look;
use super::world::World;
use crate::manual;
use closest_name::closest_name;

const TUTORIAL: &str = include_str!("../../../docs/tutorial.md");
const QUESTIONS: &str = include_str!("../../../docs/ask.md");
const SWEEPS: &str = include_str!("../../../docs/sweeps.md");

/// What addresses of documents begin with.
const SCHEME: &str = "planwright://";

/// Address, name and description of the documents.
const DOCUMENTS: &[(&str, &str, &str)] = &[
    (
        "planwright://manual",
        "Manual",
        "Every function, action, motion, failure and type of objects",
    ),
    (
        "planwright://session",
        "Session",
        "The world at hand: the robot, the objects and where they stand, what was performed, the last failure",
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

/// All documents, as resources of the Model Context Protocol.
pub(crate) fn list() -> Vec<Value> {
    let documents = DOCUMENTS.iter().map(|(uri, name, doc)| {
        json!({"uri": uri, "name": name, "description": doc, "mimeType": "text/markdown"})
    });
    let files = plan_files::LESSONS.iter().chain(plan_files::TUTORIAL);
    let files = files.map(|(file, _)| {
        json!({"uri": format!("planwright://{file}"), "name": file, "mimeType": "text/plain"})
    });
    documents.chain(files).collect()
}

/// The contents of a document as a resource; an error says which there are.
pub(crate) fn read(world: &mut World, uri: &str) -> Result<Value, String> {
    let name = uri.strip_prefix(SCHEME);
    let found = name.and_then(|name| Some((kind(name), text(world, name)?)));
    let (kind, text) = found.ok_or_else(|| {
        format!("there is no resource {uri}: resources/list tells which there are")
    })?;
    Ok(json!({"contents": [{"uri": uri, "mimeType": kind, "text": text}]}))
}

/// The document with a name; without a name, which there are.
pub(super) fn read_document(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let names = || {
        let all = list().into_iter();
        let uris = all.filter_map(|document| document["uri"].as_str().map(str::to_owned));
        uris.map(|uri| uri.trim_start_matches(SCHEME).to_owned())
    };
    let name = arguments.text("name").trim_start_matches(SCHEME);
    if name.is_empty() {
        let names: Vec<String> = names().collect();
        return Ok(Answer::text(names.join("\n")));
    }
    let found = text(world, name);
    found.map(Answer::text).ok_or_else(|| {
        let names: Vec<String> = names().collect();
        match closest_name(name, names.iter().map(String::as_str)) {
            Some(near) => format!("there is no document {name}; did you mean {near}?"),
            None => format!(
                "there is no document {name}: without a name, this tool tells which there are"
            ),
        }
    })
}

fn kind(name: &str) -> &'static str {
    match plan_files::text_of(name) {
        Some(_) => "text/plain",
        None => "text/markdown",
    }
}

fn text(world: &mut World, name: &str) -> Option<String> {
    Some(match name {
        "manual" => manual::markdown(world.at_hand()),
        "session" => look::session(world).unwrap_or_else(|why| why),
        "tutorial" => TUTORIAL.to_owned(),
        "questions" => QUESTIONS.to_owned(),
        "sweeps" => SWEEPS.to_owned(),
        name => plan_files::text_of(name)?.to_owned(),
    })
}
