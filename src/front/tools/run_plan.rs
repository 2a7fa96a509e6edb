//! Running a plan: what came of it, why it failed, and what to write instead.

use serde_json::{Value, json};

use super::answer::Answer;
use super::arguments::Arguments;
use super::check::{NAME, as_data, findings, proposed, replacing, told};
use super::look::{aside, picture};
use super::run::{REAL, Ran, SIMULATED, run};
use super::world::World;
use session::dialogue::Finding;
use session::{Failure, Session};

/// Simulated and real time (s) that a call may take.
pub(super) fn limits(arguments: &Arguments) -> (f64, f64) {
    let simulated = arguments.number("simulated_seconds").unwrap_or(SIMULATED);
    (simulated, arguments.number("real_seconds").unwrap_or(REAL))
}

/// What came of an attempt.
struct Attempt {
    ran: Ran,
    explanation: String,
    picture: Option<String>,
}

/// Runs a plan, in the world that its arguments name.
pub(super) fn run_plan(world: &mut World, arguments: &Arguments) -> Result<Answer, String> {
    let page = match arguments.text("page") {
        "" => None,
        name => Some(world.page(name)?),
    };
    let (simulated, real) = limits(arguments);
    let plan = arguments.text("plan");
    let attempt = |session: &mut Session| {
        let ran = run(session, NAME, plan, simulated, real, page.as_deref())?;
        let explanation = match &ran.values {
            // It explains the last failure of a motion, which may be one before this run.
            Err(Failure::Unhandled(_)) if ran.has_failed_motion => explained(session),
            _ => String::new(),
        };
        let picture = picture(session, arguments.text("view"))?;
        Ok::<_, String>(Attempt {
            ran,
            explanation,
            picture,
        })
    };
    let attempt = match arguments.text("in") {
        "continue" => attempt(world.at_hand())?,
        "copy" => aside(world, attempt)?,
        _ => {
            let mut session = world.fresh()?;
            let attempt = attempt(&mut session)?;
            world.take(session);
            attempt
        }
    };
    // What is found without running is often the reason.
    let found = match &attempt.ran.values {
        Ok(_) => Vec::new(),
        Err(_) => findings(world, arguments.text("in"), plan)?,
    };
    Ok(answer(attempt, &found, plan))
}

fn answer(attempt: Attempt, found: &[Finding], plan: &str) -> Answer {
    let Attempt {
        ran,
        explanation,
        picture,
    } = attempt;
    let suggestion = ran.suggestion(NAME, plan);
    let mut text = said(&ran);
    if let Some(suggestion) = &suggestion {
        text.push('\n');
        text.push_str(&proposed(suggestion));
    }
    if !explanation.is_empty() {
        text.push_str(&format!("\n\nExplanation:\n{explanation}"));
    }
    if !found.is_empty() {
        text.push_str(&format!("\n\nFound without running it:\n{}", told(found)));
    }
    let mut data = ran.json();
    data["explanation"] = Value::from(explanation);
    data["findings"] = json!(as_data(found));
    data["suggestion"] = json!(suggestion.as_ref().map(replacing));
    Answer {
        picture,
        data: Some(data),
        is_error: ran.values.is_err(),
        ..Answer::text(text)
    }
}

/// What came of a run, in words.
fn said(ran: &Ran) -> String {
    let mut text = match ran.failure() {
        None => format!(
            "The plan ended without a failure after {:.1} s.",
            ran.simulated
        ),
        Some(why) => format!("The plan failed after {:.1} s.\n{why}", ran.simulated),
    };
    if let Ok(values) = &ran.values
        && !values.is_empty()
    {
        text.push_str(&format!("\n\nValues:\n{values}"));
    }
    if !ran.printed.is_empty() {
        text.push_str(&format!("\n\nPrinted:\n{}", ran.printed));
    }
    if !ran.trace.is_empty() {
        text.push_str(&format!("\n\nPerformed:\n{}", ran.trace.join("\n")));
    }
    text
}

/// What `explain` tells of the last failure.
fn explained(session: &mut Session) -> String {
    let ran = run(session, "explain", "(planwright:explain)", 1.0, REAL, None);
    ran.map(|ran| ran.printed).unwrap_or_default()
}
