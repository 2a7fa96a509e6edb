//! Values and conditions as text.

use super::check;
use super::dialogue::screen::INTERRUPT;
use super::dialogue::{Abort, ActionStep};
use lisp::condition;
use lisp::evaluator::nested;
use lisp::guard::stoppable;
use lisp::image::Image;
use lisp::image::open_call::OpenCall;
use lisp::print;
use lisp::source::Location;
use lisp::types::type_of::type_of;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::{Raise, is_interrupt};
use lisp::value::symbol::Sym;

/// Maximum number of enclosing actions shown with a condition.
const MAX_ACTIONS: usize = 8;
/// Maximum length of an action as shown, in characters.
const MAX_ACTION_LENGTH: usize = 100;

/// Whether the place is in a built-in plan.
pub(super) fn is_built_in(place: &Location) -> bool {
    place.name.starts_with("plans/lib/")
}

/// `#<AN ACTION …>` as `(AN ACTION …)` on one line, truncated if it is long.
pub(super) fn on_one_line(shown: &str) -> String {
    on_line_of(shown, MAX_ACTION_LENGTH)
}

/// The same, truncated to so many characters.
pub(super) fn on_line_of(shown: &str, longest: usize) -> String {
    let words: Vec<&str> = shown.split_whitespace().collect();
    let line = words.join(" ");
    let line = match line.strip_prefix("#<").and_then(|l| l.strip_suffix('>')) {
        Some(inner) => format!("({inner})"),
        None => line,
    };
    match line.char_indices().nth(longest) {
        Some((end, _)) => format!("{} …)", line.get(..end).unwrap_or(&line)),
        None => line,
    }
}

/// A value as the prompt prints it.
pub(super) fn printed(image: &mut Image, value: &Value) -> String {
    printed_by(image, known::PRIN1_TO_STRING, value)
}

/// What is shown for an unhandled condition.
pub(super) fn describe(image: &mut Image, condition: &Value) -> Abort {
    let calls = image.condition_calls(condition);
    let sources = &image.sources;
    let mut places = calls.iter().filter_map(|call| sources.locate(call.place));
    let place = places.next();
    let is_own = place.as_ref().is_some_and(is_built_in);
    let user_place = places.find(|place| is_own && !is_built_in(place));
    let is_interrupt = is_interrupt(condition);
    Abort {
        report: printed_by(image, known::PRINC_TO_STRING, condition),
        class: if is_interrupt {
            String::new()
        } else {
            let class = type_of(image, condition);
            print::to_string(image, &class, false)
        },
        condition: if is_interrupt {
            INTERRUPT.to_owned()
        } else {
            without_message(&printed(image, condition))
        },
        hint: check::hint(image, condition),
        place,
        user_place,
        actions: actions(image, &calls),
    }
}

/// The printed form of a condition, `#<CLASS "message" {identity}>`, without the message, which is shown
/// above it.
fn without_message(printed: &str) -> String {
    let parts = printed.split_once(" \"").zip(printed.rsplit_once("\" {"));
    match parts {
        Some(((class, _), (_, identity)))
            if class.starts_with("#<") && identity.ends_with("}>") =>
        {
            format!("{class} {{{identity}")
        }
        _ => printed.to_owned(),
    }
}

/// The actions among the calls, each with the place where it is performed.
fn actions(image: &Image, calls: &[OpenCall]) -> Vec<ActionStep> {
    let steps = calls.iter().enumerate().filter_map(|(at, call)| {
        let shown = print::to_string(image, call.subject.as_ref()?, false);
        let outer = calls.get(at + 1..).unwrap_or_default();
        Some(ActionStep {
            call: format!("(PERFORM {})", on_one_line(&shown)),
            place: outer.iter().find_map(|c| image.sources.locate(c.place)),
        })
    });
    steps.take(MAX_ACTIONS).collect()
}

/// What is shown for an error in Rust code.
pub(super) fn raised(image: &mut Image, raise: Box<Raise>) -> Abort {
    let place = raise.place();
    let mut abort = match condition::make(image, &raise) {
        Ok(condition) => describe(image, &condition),
        Err(_) => Abort {
            report: "An error could not be described.".to_owned(),
            condition: "#<ERROR>".to_owned(),
            ..Abort::default()
        },
    };
    if abort.place.is_none() {
        abort.place = image.sources.locate(place);
    }
    abort
}

/// A value printed by a Lisp function, so that the user's print methods apply; if they
/// fail, by the printer alone.
fn printed_by(image: &mut Image, function: Sym, value: &Value) -> String {
    let args = vec![value.clone()];
    match nested::call_nested(image, function.into(), args) {
        Ok(text) => text.as_text(),
        Err(raise) if raise.is_interrupt() => return "(printing was interrupted)".to_owned(),
        Err(_) => None,
    }
    .unwrap_or_else(|| printed_plainly(image, value, function == known::PRIN1_TO_STRING))
}

/// A value printed by the printer alone, as far as nothing stops that.
fn printed_plainly(image: &Image, value: &Value, escape: bool) -> String {
    let _watch = image.limits.watch();
    stoppable(|| print::to_string(image, value, escape))
        .unwrap_or_else(|_| "(printing was stopped)".to_owned())
}
