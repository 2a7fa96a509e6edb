//! The files that a session has loaded, and what was in them.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::reading::Earlier;
use super::{End, Recorded};
use lisp::files::text_of;

/// A file that was loaded.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Loaded {
    /// Its name from the root.
    pub(super) file: String,
    /// A digest of its text.
    pub(super) digest: String,
}

/// Bytes of a digest.
const DIGEST: usize = 16;

impl Loaded {
    /// What is in files now. One that cannot be read is told of when it is used.
    pub(crate) fn all<'f>(files: impl Iterator<Item = &'f PathBuf>) -> Vec<Loaded> {
        let read = |path: &PathBuf| {
            let text = text_of(path).ok()?;
            Some(Loaded::of(&path.to_string_lossy(), &text))
        };
        files.filter_map(read).collect()
    }

    /// A file with that text.
    pub(crate) fn of(file: &str, text: &str) -> Loaded {
        let absolute = std::path::absolute(file);
        Loaded {
            file: absolute.map_or_else(|_| file.to_owned(), |path| path.to_string_lossy().into()),
            digest: digest(text),
        }
    }
}

fn digest(text: &str) -> String {
    let bytes = Sha256::digest(text.as_bytes());
    bytes
        .iter()
        .take(DIGEST)
        .fold(String::new(), |mut text, byte| {
            // Writing to a string does not fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
}

/// A file that is not any more what it was when it was loaded.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Changed {
    file: String,
    /// The number of the input that loaded it, from one; `None` for one with which the session began.
    input: Option<usize>,
    /// Why it cannot be read, if it cannot.
    error: Option<String>,
}

impl std::fmt::Display for Changed {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let file = &self.file;
        let when = match self.input {
            Some(number) => format!("since input {number} loaded it"),
            None => "since the session began with it".to_owned(),
        };
        match &self.error {
            Some(error) => write!(f, "; {file} cannot be read any more: {error}."),
            None => write!(f, "; {file} has changed {when}."),
        }
    }
}

impl Earlier {
    /// The files that are not what they were, each with the first input that would notice it.
    pub(crate) fn changed(&self) -> Vec<Changed> {
        let mut now: BTreeMap<&str, Result<String, String>> = BTreeMap::new();
        let mut changed: Vec<Changed> = Vec::new();
        let began = self.beginning.digests.iter().map(|loaded| (None, loaded));
        let inputs = self.inputs.iter().zip(1..);
        let is_wanted = |(input, _): &(&Recorded, usize)| input.end != End::Skipped;
        let inputs = inputs.filter(is_wanted).flat_map(|(input, number)| {
            input
                .loaded
                .iter()
                .map(move |loaded| (Some(number), loaded))
        });
        for (input, Loaded { file, digest }) in began.chain(inputs) {
            if changed.iter().any(|known| known.file == *file) {
                continue;
            }
            let found = now.entry(file).or_insert_with(|| {
                let text = text_of(Path::new(file)).map_err(|error| error.to_string())?;
                Ok(self::digest(&text))
            });
            let error = match found {
                Ok(now) if now == digest => continue,
                Ok(_) => None,
                Err(error) => Some(error.clone()),
            };
            changed.push(Changed {
                file: file.clone(),
                input,
                error,
            });
        }
        changed
    }
}
