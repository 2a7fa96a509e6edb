//! Inputs whose comments have swallowed code, since the text has lost its line breaks on its way.

use crate::dialogue::Event;
use crate::dialogue::screen::is_input_name;
use lisp::reader::flattened::{forms_in_comment, unflattened};

/// How many of the places are shown where a comment ends now.
const SHOWN_PLACES: usize = 3;

/// An input at a prompt with the line breaks that it must have had, if there is something to
/// restore, which is said. What may or may not be a comment stays one, and that is said, too.
pub(super) fn restored(
    source_name: &str,
    text: &str,
    sink: &mut dyn FnMut(Event),
) -> Option<String> {
    if !is_input_name(source_name) {
        return None;
    }
    let Some(found) = unflattened(text) else {
        if let Some(comment) = forms_in_comment(text) {
            let forms = comment.code_in(text);
            sink(Event::Output(format!(
                "; Not evaluated, since it is in a comment: {forms}\n"
            )));
        }
        return None;
    };
    let places = found.comments.iter().take(SHOWN_PLACES);
    let mut places: Vec<String> = places
        .map(|comment| format!(";   {}\n", comment.code_in(text)))
        .collect();
    if found.comments.len() > SHOWN_PLACES {
        places.push(";   …\n".to_owned());
    }
    sink(Event::Output(format!(
        "; Line breaks were lost, so that a comment had swallowed code. It ends before:\n{}",
        places.concat()
    )));
    Some(found.text)
}
