//! Where things are defined, as Emacs wants to know it.

use std::path::Path;

use super::hub::Request;
use super::package_text::package_of;
use super::sexp::Sexp;
use lisp::source::Location;
use session::dialogue::screen::is_input_name;
use session::dialogue::{Definition, Names};

/// How a text is called that was sent from a buffer without a file.
const BUFFER: &str = "buffer ";

/// The name for the text of a buffer without a file.
pub(super) fn buffer_source(buffer: &str) -> String {
    format!("{BUFFER}{buffer}")
}

/// The file or buffer in which a text is; none for other texts.
fn place_of_source(source: &str) -> Option<Sexp> {
    if let Some(buffer) = source.strip_prefix(BUFFER) {
        return Some(Sexp::list([Sexp::symbol(":buffer"), buffer.into()]));
    }
    let path = std::path::absolute(Path::new(source)).ok()?;
    let path = path.to_str().filter(|_| path.is_file())?;
    Some(Sexp::list([Sexp::symbol(":file"), path.into()]))
}

/// A place in a text: line and column from one.
fn in_source(source: &str, line: usize, column: usize) -> Option<Sexp> {
    let position = [
        Sexp::symbol(":line"),
        line.into(),
        column.saturating_sub(1).into(),
    ];
    Some(Sexp::list([
        Sexp::symbol(":location"),
        place_of_source(source)?,
        Sexp::list(position),
        Sexp::NIL,
    ]))
}

/// A text of its own as a place.
fn form(text: &str) -> Sexp {
    Sexp::list([
        Sexp::symbol(":location"),
        Sexp::list([Sexp::symbol(":source-form"), text.into()]),
        Sexp::list([Sexp::symbol(":position"), Sexp::Int(1)]),
        Sexp::NIL,
    ])
}

/// That there is no place, and why.
pub(super) fn nowhere(reason: &str) -> Sexp {
    Sexp::list([Sexp::symbol(":error"), reason.into()])
}

/// A place as Emacs wants it.
pub(super) fn location(place: Option<&Location>) -> Sexp {
    let Some(place) = place else {
        return nowhere("The place is not known.");
    };
    in_source(&place.name, place.line, place.column).unwrap_or_else(|| form(&place.line_text))
}

fn of_definition(definition: &Definition) -> Sexp {
    in_source(&definition.source, definition.line, definition.column)
        .unwrap_or_else(|| form(&definition.text))
}

/// `find-definitions-for-emacs`.
pub(super) fn find(names: &Names, request: &Request) -> Option<Sexp> {
    let typed = request.text(0)?;
    let package = package_of(names, request.package.as_deref());
    let bare = typed.rsplit(':').next()?.trim_start_matches('\'');
    let mut found: Vec<Sexp> = Vec::new();
    for definition in names
        .definitions
        .get(&bare.to_uppercase())
        .into_iter()
        .flatten()
    {
        let source = &definition.source;
        let label = match place_of_source(source) {
            Some(_) => definition.label.clone(),
            None if is_input_name(source) => format!("{} at the prompt", definition.label),
            None => format!("{} at {source}:{}", definition.label, definition.line),
        };
        found.push(Sexp::list([label.into(), of_definition(definition)]));
    }
    let function = names
        .typed(package, typed)
        .and_then(|s| s.function.as_ref());
    if let Some(library) = function.and_then(|function| function.library.as_ref()) {
        let label = format!("({} at {})", bare.to_uppercase(), library.place);
        found.push(Sexp::list([label.into(), form(library.text)]));
    } else if let (Some(function), true) = (function, found.is_empty()) {
        let reason = format!(
            "{} is a {} of planwright, written in Rust.",
            bare, function.kind
        );
        found.push(Sexp::list([bare.to_uppercase().into(), nowhere(&reason)]));
    }
    (!found.is_empty()).then_some(Sexp::List(found))
}
