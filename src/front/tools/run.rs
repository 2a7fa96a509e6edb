//! Running a plan within limits, and what there is to tell of it.

use std::cell::{Cell, RefCell};
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Duration;

use serde_json::{Value, json};

use lisp::reader::{Lexer, TokenKind};
use lisp::source::Location;
use session::dialogue::Suggestion;
use session::{Datum, Failure, Limit, Limits, PlanEventKind, Session, suggested};
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
    /// Has a motion failed?
    pub(super) has_failed_motion: bool,
    is_loud: bool,
    /// Where it was when a limit ended it.
    ended_at: Option<Location>,
    /// What would help if a limit has ended it.
    remedy: String,
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
    let began = session.time();
    let motion_failed: Rc<Cell<bool>> = Rc::default();
    let failed = Rc::clone(&motion_failed);
    let observer = session.on_event(move |event| match &event.kind {
        PlanEventKind::Ended(end) if !matches!(end.id, TaskId::Task(_)) => {
            let mut lines = traced.borrow_mut();
            if matches!(end.id, TaskId::Motion(_)) && end.failure.is_some() {
                failed.set(true);
            }
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
                lines.push(format!(
                    "{:.1} s: {kind} {} {how}",
                    event.time - began,
                    end.name
                ));
            }
        }
        _ => {}
    });
    let limits = Limits {
        simulated_time: Some(simulated),
        wall_clock: Some(Duration::from_secs_f64(real)),
        looks: Some(LOOKS),
        grace: Duration::from_millis(500),
        ..Limits::NONE
    };
    let ran = session.within(limits).run(name, text);
    let ended_at = session.ended_at().cloned();
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
    let is_loud = printed.is_too_long();
    let remedy = match &values {
        Err(failure) => remedy(failure, is_loud, simulated, real),
        Ok(_) => String::new(),
    };
    Ok(Ran {
        ended_at: ended_at.or_else(|| place_of_quit(name, text, &values)),
        remedy,
        values,
        is_loud,
        printed: printed.take(),
        trace: nodes.take(),
        has_failed_motion: motion_failed.get(),
        simulated: session.time() - began,
    })
}

/// What would help a plan that did not end by itself.
fn remedy(failure: &Failure, is_loud: bool, simulated: f64, real: f64) -> String {
    match failure {
        Failure::Interrupted if is_loud => {
            "Print less: a loop that prints needs an end, as in (loop repeat 10 do …).".to_owned()
        }
        Failure::LimitReached(Limit::Looks) => {
            "It calculates without end: a loop needs an end that is reached, as in (loop repeat 10 do …) or \
             (return), a recursion a case in which it does not call itself."
                .to_owned()
        }
        Failure::LimitReached(Limit::SimulatedTime) => format!(
            "It waits or tries again without end, or takes longer than simulated_seconds = {simulated}: bound \
             retries by (cpl:with-retry-counters ((tries 3)) … (cpl:do-retry tries (cpl:retry))), give loops an \
             end, or allow more."
        ),
        Failure::LimitReached(Limit::WallClock) => format!(
            "It takes longer than real_seconds = {real}: allow more, or give loops and retries an end."
        ),
        Failure::Quit(_) => {
            "A plan that a program runs ends with its last form: leave (quit) out.".to_owned()
        }
        _ => String::new(),
    }
}

/// Where a plan asks to exit, if that has ended it.
fn place_of_quit(name: &str, text: &str, values: &Result<String, Failure>) -> Option<Location> {
    let Err(Failure::Quit(_)) = values else {
        return None;
    };
    let mut tokens = Lexer::new(text).filter(|token| token.kind == TokenKind::Atom);
    let found = tokens.find(|token| {
        let word = text.get(token.start..token.end).unwrap_or_default();
        let word = word.rsplit(':').next().unwrap_or_default();
        word.eq_ignore_ascii_case("quit") || word.eq_ignore_ascii_case("exit")
    })?;
    let mut sources = lisp::source::Sources::default();
    let source = sources.add(name, text);
    let place = sources.place(source, found.start, found.end);
    sources.locate(place)
}

/// A report at a place, with the place underlined.
fn placed(place: Option<&Location>, report: &str) -> String {
    match place {
        Some(place) => format!("{place}: {report}\n{}", place.underlined()),
        None => report.to_owned(),
    }
}

impl Ran {
    /// Why it failed, in words.
    pub(super) fn failure(&self) -> Option<String> {
        let failure = self.values.as_ref().err()?;
        let place = self.ended_at.as_ref();
        Some(match failure {
            Failure::Unhandled(unhandled) => {
                let abort = &unhandled.abort;
                let report = format!("{}: {}", abort.class, abort.report.trim_end());
                let mut text = placed(abort.main_place(), &report);
                for line in abort.hint.iter().cloned().chain(abort.context()) {
                    text.push('\n');
                    text.push_str(&line);
                }
                text
            }
            other => {
                let report = match other {
                    Failure::Interrupted if self.is_loud => {
                        format!("It prints more than {MAX_PRINTED} bytes.")
                    }
                    other => format!("It was ended: {other}."),
                };
                format!("{}\n{}", placed(place, &report), self.remedy)
            }
        })
    }

    /// Where it failed.
    fn place(&self) -> Option<&Location> {
        match self.values.as_ref().err()? {
            Failure::Unhandled(unhandled) => unhandled.abort.main_place(),
            _ => self.ended_at.as_ref(),
        }
    }

    /// What to write instead in a plan that failed.
    pub(super) fn suggestion(&self, name: &str, text: &str) -> Option<Suggestion> {
        let unhandled = self.values.as_ref().err()?.unhandled()?;
        suggested(name, text, &unhandled.abort)
    }

    /// What came of it, as data.
    pub(super) fn json(&self) -> Value {
        json!({
            "outcome": if self.values.is_ok() { "success" } else { "failure" },
            "values": self.values.as_ref().ok(),
            "failure": self.failure(),
            "line": self.place().map(|place| place.line),
            "column": self.place().map(|place| place.column),
            "class": self.values.as_ref().err().and_then(|failure| {
                failure.unhandled().map(|unhandled| unhandled.abort.class.clone())
            }),
            "printed": self.printed,
            "trace": self.trace,
            "simulated_seconds": self.simulated,
        })
    }
}
