//! Prints the reference manual.

use std::io::{self, Write};

use super::failure::{CommandError, Status};
use crate::manual;
use session::{Session, SessionOptions};

/// Prints the manual of what is built in; options make no difference.
pub(crate) fn print() -> Result<Status, CommandError> {
    let session = Session::new(&SessionOptions::default())
        .map_err(|error| CommandError::Open(error.to_string()))?;
    io::stdout().write_all(manual::markdown(&session).as_bytes())?;
    Ok(Status::Good)
}
