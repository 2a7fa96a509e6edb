//! Names and documentation as they are shown.

/// A name as users type it.
pub(super) fn lower(name: &str) -> String {
    name.to_lowercase()
}

/// The first sentence of a text, on one line.
pub(super) fn first_sentence(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.find(". ") {
        Some(end) => line.get(..=end).unwrap_or(&line).to_owned(),
        None => line,
    }
}
