//! What is found in a plan without running it.

use serde_json::{Value, json};

use super::answer::Answer;
use super::arguments::Arguments;
use super::world::World;
use session::Session;
use session::dialogue::{Finding, Severity, Suggestion};

/// The name of a plan in places.
pub(super) const NAME: &str = "plan";
/// Looks for an interrupt that macros of a plan may take, and what cleans up after them.
const LOOKS: u64 = 100_000;
/// Maximum number of findings that are told.
const MAX_FINDINGS: usize = 200;

/// Checks a plan, in the world that its arguments name.
pub(super) fn check_plan(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let found = findings(world, arguments.text("in"), arguments.text("plan"))?;
    let text = match found.as_slice() {
        [] => "No mistakes were found.".to_owned(),
        found => told(found),
    };
    Ok(Answer {
        data: Some(json!({"findings": as_data(&found)})),
        ..Answer::text(text)
    })
}

/// What is found in a plan: for a fresh world, or for the world at hand, where what it defines is known afterwards.
pub(super) fn findings(world: &mut World, place: &str, text: &str) -> Result<Vec<Finding>, String> {
    Ok(match place {
        "" | "fresh" => {
            let mut session = world.fresh()?;
            session.close();
            found(&mut session, text)
        }
        _ => found(world.at_hand(), text),
    })
}

fn found(session: &mut Session, text: &str) -> Vec<Finding> {
    // Macros of the plan are expanded.
    session.image_mut().polls().begin(Some(LOOKS));
    session.image_mut().polls().set_again(Some(LOOKS / 10));
    let found = session.check_once(NAME, text);
    session.image_mut().polls().set_again(None);
    session.image_mut().polls().begin(None);
    found
}

/// Findings in words, each with its place, and what to write instead.
pub(super) fn told(found: &[Finding]) -> String {
    let lines = found.iter().take(MAX_FINDINGS).map(|finding| {
        let mut line = match &finding.place {
            Some(place) => format!("{place}: {}\n{}", finding.message, place.underlined()),
            None => finding.message.clone(),
        };
        if let Some(suggestion) = &finding.suggestion {
            line.push('\n');
            line.push_str(&proposed(suggestion));
        }
        line
    });
    let mut lines: Vec<String> = lines.collect();
    if found.len() > MAX_FINDINGS {
        lines.push(format!("… and {} more.", found.len() - MAX_FINDINGS));
    }
    lines.join("\n")
}

/// What to write instead, in words.
pub(super) fn proposed(suggestion: &Suggestion) -> String {
    let Suggestion {
        line,
        column,
        wrong,
        replacement,
    } = suggestion;
    let place = format!("{NAME}:{line}:{column}");
    match (wrong.as_str(), replacement.as_str()) {
        ("", new) => format!("Suggestion: insert {new} at {place}"),
        (old, "") => format!("Suggestion: leave out {old} at {place}"),
        (old, new) => format!("Suggestion: write {new} instead of {old} at {place}"),
    }
}

/// Findings as data.
pub(super) fn as_data(found: &[Finding]) -> Vec<Value> {
    let data = found.iter().take(MAX_FINDINGS).map(|finding| {
        json!({
            "line": finding.place.as_ref().map(|place| place.line),
            "column": finding.place.as_ref().map(|place| place.column),
            "severity": match finding.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            "message": finding.message,
            "suggestion": finding.suggestion.as_ref().map(replacing),
        })
    });
    data.collect()
}

/// A suggestion as data: at a line and a column, what is wrong there and what to write in its place.
pub(super) fn replacing(suggestion: &Suggestion) -> Value {
    json!({
        "line": suggestion.line,
        "column": suggestion.column,
        "wrong": suggestion.wrong,
        "replacement": suggestion.replacement,
    })
}
