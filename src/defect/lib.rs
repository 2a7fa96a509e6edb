//! Defects: panics, in the program or in a library, which end no session.
//!
//! Whoever can go on after a panic catches it here. Nothing is written to the terminal then; what
//! the panic says, and where, is in the [`Defect`].

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::fmt;
use std::panic::{self, AssertUnwindSafe, catch_unwind};

/// A panic that was caught.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Defect {
    /// What the panic says.
    message: String,
    /// The file and line of the source, if known.
    place: Option<String>,
}

impl Defect {
    /// What the panic says.
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.place {
            Some(place) => write!(f, "{} (at {place})", self.message),
            None => write!(f, "{}", self.message),
        }
    }
}

thread_local! {
    /// Will somebody catch a panic of this thread?
    static IS_CAUGHT: Cell<bool> = const { Cell::new(false) };
    /// Where the last panic of this thread was.
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Panics that are caught are no longer told on standard error. To be called once, by a program
/// that is not embedded.
pub fn keep_caught_panics_quiet() {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !IS_CAUGHT.get() {
            return usual(info);
        }
        let place = info
            .location()
            .map(|place| format!("{}:{}", place.file(), place.line()));
        PLACE.set(place);
    }));
}

/// Runs something; an error if it panics.
pub fn caught<T>(work: impl FnOnce() -> T) -> Result<T, Defect> {
    let outer = IS_CAUGHT.replace(true);
    PLACE.set(None);
    let done = catch_unwind(AssertUnwindSafe(work));
    IS_CAUGHT.set(outer);
    done.map_err(|payload| Defect {
        message: message(payload.as_ref()),
        place: PLACE.take(),
    })
}

fn message(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
    text.unwrap_or("a panic without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_an_error() {
        assert_eq!(caught(|| 1), Ok(1));
        let defect = caught(|| -> u8 { panic!("no {}", 7) }).map_err(|defect| defect.message);
        assert_eq!(defect, Err("no 7".to_owned()));
    }
}
