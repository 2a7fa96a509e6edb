//! Reading the file that defines a sweep.

use std::path::Path;

use crate::command::failure::{CommandError, read};
use session::sweeping::SweepFile;

/// The file with that path.
pub(super) fn sweep_file(path: &Path) -> Result<SweepFile, CommandError> {
    Ok(SweepFile {
        name: path.display().to_string(),
        text: read(path)?,
    })
}
