//! Sets up what evaluates: the one place that knows how.

use clap::Parser;

use super::arguments::{Arguments, Options};
use super::failure::CommandError;
use crate::dialogue::Evaluate;
use crate::session::Session;

/// A fresh evaluator with a world of its own.
pub(super) fn open(_options: &Options) -> Result<Box<dyn Evaluate>, CommandError> {
    Ok(Box::new(Session::new()))
}

/// A fresh evaluator as a command line without options has it.
pub fn open_default() -> Result<Box<dyn Evaluate>, String> {
    let arguments = Arguments::try_parse_from(["planwright"]).map_err(|error| error.to_string())?;
    open(&arguments.options).map_err(|error| error.to_string())
}
