//! What clients have to say before anything else, if they have to.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Why a secret cannot be read.
pub(crate) type SecretError = (PathBuf, io::Error);

/// The first line of a file; without one, of the file from which SLIME takes it, if that exists.
pub(crate) fn secret(file: Option<&Path>) -> Result<Option<String>, SecretError> {
    let usual = std::env::home_dir().map(|home| home.join(".slime-secret"));
    let (path, is_needed) = match (file, usual) {
        (Some(path), _) => (path.to_owned(), true),
        (None, Some(path)) => (path, false),
        (None, None) => return Ok(None),
    };
    match fs::read_to_string(&path) {
        Ok(text) => Ok(Some(text.lines().next().unwrap_or_default().to_owned())),
        Err(error) if !is_needed && error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err((path, error)),
    }
}
