//! Why an evaluation does not go on, as its followers learn it.

use crate::dialogue::{Abort, Event};
use view::watch::{Halt, HaltKind};

/// What an event says about the end of an input.
pub(crate) fn end_of(event: &Event) -> Option<Halt> {
    match event {
        Event::Aborted(abort) => Some(halt_of(HaltKind::Aborted, abort)),
        _ => None,
    }
}

/// The halt at a condition or an interrupt.
pub(super) fn halt_of(kind: HaltKind, abort: &Abort) -> Halt {
    let place = abort.main_place();
    Halt {
        class: abort.class.clone(),
        place: place.map_or_else(String::new, ToString::to_string),
        ..Halt::new(kind, abort.report.clone())
    }
}
