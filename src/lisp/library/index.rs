//! Finding the definitions in a file without reading it: a form begins with a parenthesis
//! in the first column.

use super::Library;
use super::definition::{Definition, File, Kind, take_item};

/// Adds the forms of a file to a library.
pub(super) fn find(file: &'static File, library: &mut Library) {
    let mut package = String::new();
    let mut starts = starts(file.text).peekable();
    while let Some(start) = starts.next() {
        let end = starts.peek().copied().unwrap_or(file.text.len());
        let mut definition = Definition::new(file, start, end);
        let mut rest = &file.text[start + 1..end];
        let operator = take_item(&mut rest);
        let name = take_item(&mut rest);
        if operator == "in-package" {
            package = name.trim_start_matches([':', '#']).to_uppercase();
            continue;
        }
        definition.reading_package.clone_from(&package);
        definition.kind = match operator {
            "defun" if name.starts_with('(') => Kind::Setter,
            "defun" => Kind::Function,
            "defmacro" | "define-modify-macro" => Kind::Macro,
            _ => Kind::Form,
        };
        let name = match definition.kind {
            Kind::Setter => name.trim_start_matches("(setf").trim_matches([' ', ')']),
            _ => name,
        };
        let (home, name) = match name.split_once(':') {
            Some((home, name)) if !home.is_empty() => (home.to_uppercase(), name),
            _ => (package.clone(), name),
        };
        definition.package = home;
        definition.name = name.trim_start_matches(':').to_uppercase();
        match definition.kind {
            Kind::Form => library.forms.push(definition),
            _ => library.definitions.push(definition),
        }
    }
}

/// The bytes at which forms begin.
fn starts(text: &str) -> impl Iterator<Item = usize> {
    let bytes = text.as_bytes();
    let lines = memchr::memchr_iter(b'\n', bytes).map(|end| end + 1);
    let lines = std::iter::once(0).chain(lines);
    lines.filter(|start| bytes.get(*start) == Some(&b'('))
}
