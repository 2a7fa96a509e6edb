//! Counting the polls of the interrupt flag. The count depends only on the program, so it tells
//! when an interrupt came and when to repeat it.

use std::cell::Cell;
use std::sync::atomic::{AtomicBool, Ordering};

/// A count of polls of the interrupt flag.
#[derive(Debug, Default)]
pub(crate) struct Polls {
    count: Cell<u64>,
    seen_at: Cell<Option<u64>>,
    due_at: Cell<Option<u64>>,
}

impl Polls {
    /// Begins a new count. At the given poll, if any, the flag will be found set.
    pub(crate) fn begin(&self, due_at: Option<u64>) {
        self.count.set(0);
        self.seen_at.set(None);
        self.due_at.set(due_at);
    }

    /// The first poll at which the flag was set.
    pub(crate) fn seen_at(&self) -> Option<u64> {
        self.seen_at.get()
    }

    /// Something else has found the flag set since the last poll: as if that poll had.
    pub(crate) fn seen_since_last(&self) {
        if self.seen_at.get().is_none() {
            self.seen_at.set(Some(self.count.get()));
        }
    }

    /// Polls the flag.
    pub(super) fn look(&self, flag: &AtomicBool) -> bool {
        let count = self.count.get() + 1;
        self.count.set(count);
        let is_set = flag.load(Ordering::Relaxed) || self.due_at.get() == Some(count);
        if is_set {
            flag.store(true, Ordering::Relaxed);
            if self.seen_at.get().is_none() {
                self.seen_at.set(Some(count));
            }
        }
        is_set
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interrupt_can_be_repeated() {
        let flag = AtomicBool::new(false);
        let polls = Polls::default();
        assert!(!polls.look(&flag));
        flag.store(true, Ordering::Relaxed);
        assert!(polls.look(&flag));
        assert_eq!(polls.seen_at(), Some(2));

        flag.store(false, Ordering::Relaxed);
        polls.begin(Some(2));
        assert!(!polls.look(&flag));
        assert!(polls.look(&flag));
        assert!(flag.load(Ordering::Relaxed));
    }
}
