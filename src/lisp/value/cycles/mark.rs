//! What the collector writes on an object while it works, so that it needs no memory of its own for
//! each.

use std::cell::Cell;

/// The mark of an object.
///
/// Its highest bit says that a collection has found the object alive. The next two are its state in the
/// collection that is under way; the others count the references to it that were found.
#[derive(Default)]
pub struct Mark(Cell<u32>);

/// How far the collection has come with an object.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum State {
    /// Not yet there, or done with it.
    Idle,
    /// The references to it are being counted.
    Counted,
    /// Nobody is known yet to hold it.
    Unheld,
}

const OLD: u32 = 1 << 31;
const COUNTED: u32 = 1 << 30;
const UNHELD: u32 = 1 << 29;
/// Maximum number of references that are counted. An object that has more counts as held.
const MAX_COUNT: u32 = UNHELD - 1;

impl Mark {
    /// Has an earlier collection found the object alive?
    pub(super) fn is_old(&self) -> bool {
        self.0.get() & OLD != 0
    }

    pub(super) fn state(&self) -> State {
        match self.0.get() {
            bits if bits & COUNTED != 0 => State::Counted,
            bits if bits & UNHELD != 0 => State::Unheld,
            _ => State::Idle,
        }
    }

    /// Begins to count references to the object.
    pub(super) fn count_from_zero(&self) {
        self.0.set(self.0.get() & OLD | COUNTED);
    }

    /// Counts a reference.
    pub(super) fn count(&self) {
        let bits = self.0.get();
        if bits & MAX_COUNT < MAX_COUNT {
            self.0.set(bits + 1);
        }
    }

    /// The references that were found; none if they are too many.
    pub(super) fn found(&self) -> Option<usize> {
        let found = self.0.get() & MAX_COUNT;
        (found < MAX_COUNT).then_some(found as usize)
    }

    /// The object is not known to be held, for all that has been seen.
    pub(super) fn set_unheld(&self) {
        self.0.set(self.0.get() & (OLD | MAX_COUNT) | UNHELD);
    }

    /// The object is alive, and the collection has done with it.
    pub(super) fn set_old(&self) {
        self.0.set(OLD);
    }

    /// The collection has done with the object, or is given up.
    pub(super) fn reset(&self) {
        self.0.set(self.0.get() & OLD);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_remembers_age_state_and_count() {
        let mark = Mark::default();
        assert_eq!((mark.state(), mark.is_old()), (State::Idle, false));
        mark.count_from_zero();
        mark.count();
        mark.count();
        mark.set_unheld();
        assert_eq!((mark.state(), mark.found()), (State::Unheld, Some(2)));
        mark.set_old();
        mark.count_from_zero();
        assert_eq!((mark.state(), mark.found()), (State::Counted, Some(0)));
        assert!(mark.is_old());
        mark.reset();
        assert_eq!((mark.state(), mark.is_old()), (State::Idle, true));
    }

    #[test]
    fn too_many_references_are_no_number() {
        let mark = Mark(Cell::new(COUNTED | (MAX_COUNT - 1)));
        mark.count();
        mark.count();
        assert_eq!((mark.state(), mark.found()), (State::Counted, None));
    }
}
