//! Warnings about what is evaluated at the prompt or by `load`, as `check` words them.

use super::judge::Judge;
use super::known::KnownNames;
use super::text::placed;
use crate::dialogue::screen::is_input_name;
use lisp::image::Image;
use lisp::image::notes::Note;
use lisp::image::warnings;
use lisp::image::warnings::Warning;
use lisp::source::Place;

/// Lets an image judge the compiler's notes.
pub(crate) fn install(image: &mut Image) {
    image.extend(warnings::Judge(judged));
}

/// The warnings about notes, in the order of the text.
fn judged(image: &mut Image, notes: &[Note]) -> Vec<Warning> {
    let names = KnownNames::default();
    let mistakes = Judge::new(image, &names).judge_all(notes);
    let mut found = placed(image, mistakes);
    found.sort_by_key(|(place, _)| image.sources.bytes_of(*place).map(|(_, start, _)| start));
    let warnings = found.into_iter().map(|(place, mistake)| Warning {
        text: match shown(image, place) {
            Some(place) => format!("{}\n; at {place}", mistake.text),
            None => mistake.text,
        },
        is_style: mistake.is_style,
    });
    warnings.collect()
}

/// A place in words, as the prompt shows places: none in an input of one line.
fn shown(image: &Image, place: Place) -> Option<String> {
    let location = image.sources.locate(place)?;
    if !is_input_name(&location.name) {
        return Some(location.to_string());
    }
    let has_lines = image.sources.has_lines(place);
    has_lines.then(|| format!("line {}, column {}", location.line, location.column))
}
