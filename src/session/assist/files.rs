//! Completions of file names in strings.

use std::path::Path;

use crate::dialogue::{Candidate, Completions};

/// Maximum number of files offered.
const MOST_FILES: usize = 100;

/// The files whose names begin with the text, the contents so far of a string that starts
/// at byte `start` of the input.
pub(super) fn completions(text: &str, start: usize) -> Completions {
    let (directory, name) = match text.rfind('/') {
        Some(slash) => text.split_at(slash + 1),
        None => ("", text),
    };
    let searched = if directory.is_empty() { "." } else { directory };
    let entries = std::fs::read_dir(Path::new(searched));
    let mut candidates: Vec<Candidate> = entries
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| {
            let found = entry.file_name().into_string().ok()?;
            let is_wanted =
                found.starts_with(name) && (name.starts_with('.') || !found.starts_with('.'));
            let end = if entry.path().is_dir() { "/" } else { "" };
            is_wanted.then(|| Candidate {
                text: format!("{found}{end}"),
                doc: String::new(),
            })
        })
        .collect();
    candidates.sort();
    candidates.truncate(MOST_FILES);
    Completions {
        start: start + directory.len(),
        candidates,
    }
}
