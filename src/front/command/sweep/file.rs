//! The file that defines a sweep.

use std::path::{Path, PathBuf};

use crate::command::failure::{CommandError, read};
use session::Session;
use session::dialogue::{Abort, Evaluate, Event, Outcome};

/// A file that defines a sweep.
#[derive(Clone, Debug)]
pub(super) struct SweepFile {
    /// Its name in places.
    pub(super) name: String,
    pub(super) text: String,
}

impl SweepFile {
    /// Reads it.
    pub(super) fn read(path: &Path) -> Result<Self, CommandError> {
        Ok(Self {
            name: path.display().to_string(),
            text: read(&PathBuf::from(path))?,
        })
    }

    /// Evaluates it in a fresh session; its output is dropped. Returns the condition that ended it, if
    /// one did.
    pub(super) fn load(&self, session: &mut Session) -> Option<Box<Abort>> {
        let mut abort = None;
        let outcome = session.evaluate(&self.name, &self.text, &mut |event| {
            if let Event::Aborted(aborted) = event {
                abort = Some(aborted);
            }
        });
        match outcome {
            Outcome::Aborted | Outcome::Stopped => Some(abort.unwrap_or_default()),
            Outcome::Finished | Outcome::Quit(_) => None,
        }
    }
}
