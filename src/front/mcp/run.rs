//! Running a plan within limits, and what there is to tell of it.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use serde_json::{Value, json};

use session::{Datum, Failure, Limits, PlanEventKind, Session};
use view::watch::{TaskId, TaskState};

/// Simulated time (s) that a plan may take unless the client says otherwise.
pub(super) const SIMULATED: f64 = 600.0;
/// Real time (s) that it may take unless the client says otherwise, and at most.
pub(super) const REAL: f64 = 60.0;
pub(super) const MAX_REAL: f64 = 600.0;
/// Looks for an interrupt that a plan may take: some seconds of pure calculation.
const LOOKS: u64 = 200_000;
/// Maximum number of characters that are told of what a plan prints, and of bytes that it may print.
const MAX_TOLD: usize = 20_000;
const MAX_PRINTED: usize = 1 << 20;
/// Maximum number of lines of the tree of tasks that are told.
const MAX_LINES: usize = 300;

/// What came of running something.
pub(super) struct Ran {
    pub(super) values: Result<String, Failure>,
    pub(super) printed: String,
    pub(super) trace: Vec<String>,
    pub(super) simulated: f64,
    is_loud: bool,
}

/// Runs a text within limits.
pub(super) fn run(
    session: &mut Session,
    name: &str,
    text: &str,
    simulated: f64,
    real: f64,
    page: Option<&Path>,
) -> Result<Ran, String> {
    if let Some(path) = page {
        // The page is the server's, not the plan's, which has no files.
        let closed = Arc::clone(&session.image().files);
        session.image_mut().files = Arc::clone(&session.options().outside.files);
        let kept = session.keep_run(path);
        session.image_mut().files = closed;
        kept.map_err(|error| error.to_string())?;
    }
    let (keeper, printed) = session.keep_output(MAX_TOLD, MAX_PRINTED);
    let nodes: Rc<RefCell<Vec<String>>> = Rc::default();
    let traced = Rc::clone(&nodes);
    let observer = session.on_event(move |event| match &event.kind {
        PlanEventKind::Ended(end) if !matches!(end.id, TaskId::Task(_)) => {
            let mut lines = traced.borrow_mut();
            if lines.len() < MAX_LINES {
                let kind = match end.id {
                    TaskId::Motion(_) => "motion",
                    _ => "action",
                };
                let how = match (&end.failure, end.state) {
                    (Some((class, report)), _) => format!("failed with {class}: {report}"),
                    (None, TaskState::Succeeded) => "succeeded".to_owned(),
                    (None, _) => "was given up".to_owned(),
                };
                lines.push(format!("{:.1} s: {kind} {} {how}", event.time, end.name));
            }
        }
        _ => {}
    });
    let began = session.time();
    let limits = Limits {
        simulated_time: Some(simulated),
        wall_clock: Some(Duration::from_secs_f64(real)),
        looks: Some(LOOKS),
        grace: Duration::from_millis(500),
        ..Limits::NONE
    };
    let ran = session.within(limits).run(name, text);
    session.remove_observer(observer);
    session.remove_observer(keeper);
    let values = match ran {
        // The values of the last form, as they are printed.
        Ok(_) => {
            let form = "(format nil \"~{~s~^~%~}\" cl:/)";
            let shown = session.within(limits).run("values", form);
            shown.map(|values| {
                values
                    .first()
                    .and_then(Datum::as_text)
                    .unwrap_or_default()
                    .to_owned()
            })
        }
        Err(failure) => Err(failure),
    };
    if page.is_some() {
        let written = session.write_kept_run();
        written.map_err(|error| error.to_string())?;
    }
    Ok(Ran {
        values,
        is_loud: printed.is_too_long(),
        printed: printed.take(),
        trace: nodes.take(),
        simulated: session.time() - began,
    })
}

impl Ran {
    /// Why it failed, in words.
    pub(super) fn failure(&self) -> Option<String> {
        let failure = self.values.as_ref().err()?;
        Some(match failure {
            Failure::Interrupted if self.is_loud => {
                format!("It prints more than {MAX_PRINTED} bytes.")
            }
            Failure::Unhandled(unhandled) => {
                let abort = &unhandled.abort;
                let mut text = match abort.main_place() {
                    Some(place) => format!(
                        "{place}: {}: {}\n{}",
                        abort.class,
                        abort.report.trim_end(),
                        place.underlined()
                    ),
                    None => format!("{}: {}", abort.class, abort.report.trim_end()),
                };
                for line in abort.hint.iter().cloned().chain(abort.context()) {
                    text.push('\n');
                    text.push_str(&line);
                }
                text
            }
            other => format!("It was ended: {other}."),
        })
    }

    /// What came of it, as data.
    pub(super) fn json(&self) -> Value {
        json!({
            "outcome": if self.values.is_ok() { "success" } else { "failure" },
            "values": self.values.as_ref().ok(),
            "failure": self.failure(),
            "class": self.values.as_ref().err().and_then(|failure| {
                failure.unhandled().map(|unhandled| unhandled.abort.class.clone())
            }),
            "printed": self.printed,
            "trace": self.trace,
            "simulated_seconds": self.simulated,
        })
    }
}
