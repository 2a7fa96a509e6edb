//! Sets up what evaluates: the one place that knows how.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::Parser;

use super::arguments::{Arguments, Options};
use super::failure::CommandError;
use crate::dialogue::{Abort, Evaluate, Event, Finding, Outcome};

/// A fresh evaluator with a world of its own.
pub(super) fn open(_options: &Options) -> Result<Box<dyn Evaluate>, CommandError> {
    Ok(Box::new(Echo::default()))
}

/// A fresh evaluator as a command line without options has it.
pub fn open_default() -> Result<Box<dyn Evaluate>, String> {
    let arguments = Arguments::try_parse_from(["planwright"]).map_err(|error| error.to_string())?;
    open(&arguments.options).map_err(|error| error.to_string())
}

/// Stands in until the session is there: gives each input back as its value.
#[derive(Default)]
struct Echo {
    interrupt: Arc<AtomicBool>,
}

impl Evaluate for Echo {
    fn evaluate(&mut self, _: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        match text.trim() {
            "(quit)" => Outcome::Quit(0),
            text if text.contains("error") => {
                sink(Event::Aborted(Box::new(Abort {
                    report: "An error".to_owned(),
                    condition: "#<SIMPLE-ERROR>".to_owned(),
                    place: None,
                })));
                Outcome::Aborted
            }
            text => {
                sink(Event::Values(vec![text.to_owned()]));
                Outcome::Finished
            }
        }
    }

    fn check(&mut self, _: &str, _: &str) -> Vec<Finding> {
        Vec::new()
    }

    fn prompt(&self) -> String {
        "CL-USER".to_owned()
    }

    fn interrupt_handle(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.interrupt)
    }
}
