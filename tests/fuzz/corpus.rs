//! The project's own files, in pieces.

use std::fs;
use std::path::{Path, PathBuf};

use crate::transcript::Transcript;

/// Maximum size (bytes) of a piece.
const MAX_BYTES: usize = 2000;

/// Texts of the files with that ending in a folder of the project, in order of their names.
pub(super) fn files(folder: &str, ending: &str) -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(folder).expect("the folder can be read");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let wanted = paths
        .iter()
        .filter(|path| path.to_string_lossy().ends_with(ending));
    wanted
        .map(|path| {
            (
                path.display().to_string(),
                fs::read_to_string(path).unwrap(),
            )
        })
        .collect()
}

/// The inputs of transcripts in a folder.
pub(super) fn inputs(folder: &str, ending: &str) -> Vec<Vec<u8>> {
    let entries = files(folder, ending)
        .into_iter()
        .flat_map(|(name, text)| Transcript::parse(&name, &text).entries);
    small(entries.map(|entry| entry.input.into_bytes()))
}

/// The forms of source files: what begins with a parenthesis in the first column.
pub(super) fn forms(folder: &str, ending: &str) -> Vec<Vec<u8>> {
    let texts = files(folder, ending);
    let forms = texts.iter().flat_map(|(_, text)| text.split("\n("));
    small(forms.map(|form| format!("({}", form.trim_start_matches('(')).into_bytes()))
}

/// Files in pieces of several lines.
pub(super) fn stretches(folder: &str, ending: &str) -> Vec<Vec<u8>> {
    let mut pieces = Vec::new();
    for (_, text) in files(folder, ending) {
        let lines: Vec<&str> = text.lines().collect();
        pieces.extend(lines.chunks(30).map(|lines| lines.join("\n").into_bytes()));
    }
    small(pieces.into_iter())
}

pub(super) fn small(pieces: impl Iterator<Item = Vec<u8>>) -> Vec<Vec<u8>> {
    pieces
        .filter(|piece| (1..=MAX_BYTES).contains(&piece.len()))
        .collect()
}

/// The forms of the conformance suite, of the plans and of the library.
pub(super) fn programs() -> Vec<Vec<u8>> {
    [
        inputs("tests/conformance", ".transcript"),
        inputs("docs", ".md"),
        forms("src/lisp/library", ".lisp"),
        forms("src/cram/library", ".lisp"),
        forms("plans/lib", ".plan"),
    ]
    .concat()
}
