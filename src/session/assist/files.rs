//! Completions of file names in strings.

use lisp::files::Files;

use crate::dialogue::{Candidate, Completions};

/// Maximum number of files offered.
const MAX_FILES: usize = 100;

/// The files whose names begin with the text, the contents so far of a string that starts
/// at byte `start` of the input.
pub(super) fn completions(files: &dyn Files, text: &str, start: usize) -> Completions {
    let (directory, name) = match text.rfind('/') {
        Some(slash) => text.split_at(slash + 1),
        None => ("", text),
    };
    let searched = if directory.is_empty() { "." } else { directory };
    let found = files.names(searched).unwrap_or_default().into_iter();
    let wanted = found.filter(|found| {
        found.starts_with(name) && (name.starts_with('.') || !found.starts_with('.'))
    });
    let mut candidates: Vec<Candidate> = wanted
        .map(|text| Candidate {
            text,
            doc: String::new(),
        })
        .collect();
    candidates.sort();
    candidates.truncate(MAX_FILES);
    Completions {
        start: start + directory.len(),
        candidates,
    }
}
