//! Counting the polls of the interrupt flag. The count depends only on the program, so it tells
//! when an interrupt came and when to repeat it.

use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The interrupt flag, and a count of polls of it.
#[derive(Debug, Default)]
pub struct Polls {
    flag: Arc<AtomicBool>,
    count: Cell<u64>,
    seen_at: Cell<Option<u64>>,
    put_off: Cell<u32>,
    due_at: Cell<Option<u64>>,
    again: Cell<Option<u64>>,
    breathe: Cell<Option<fn()>>,
}

/// Number of polls from one breath to the next.
const BETWEEN_BREATHS: u64 = 64;

/// How often may interrupts be put off from one poll to the next? For some ten milliseconds.
const MAX_PUT_OFF: u32 = 256;

impl Polls {
    /// Begins a new count. At the given poll, if any, the flag will be found set.
    pub fn begin(&self, due_at: Option<u64>) {
        self.count.set(0);
        self.seen_at.set(None);
        self.put_off.set(0);
        self.due_at.set(due_at);
    }

    /// After a poll at which it was due, the flag will be found set again after so many more.
    pub fn set_again(&self, after: Option<u64>) {
        self.again.set(after);
    }

    /// What is called at some of the polls.
    pub fn breathe(&self) -> Option<fn()> {
        self.breathe.get()
    }

    /// Sets what is called at some of the polls.
    pub fn set_breathe(&self, breathe: Option<fn()>) {
        self.breathe.set(breathe);
    }

    /// The first poll at which the flag was set.
    pub fn seen_at(&self) -> Option<u64> {
        self.seen_at.get()
    }

    /// Something else has found the flag set since the last poll: as if that poll had.
    pub fn seen_since_last(&self) {
        if self.seen_at.get().is_none() {
            self.seen_at.set(Some(self.count.get()));
        }
    }

    /// The number of polls so far.
    #[cfg(test)]
    pub fn count(&self) -> u64 {
        self.count.get()
    }

    /// The flag.
    pub fn flag(&self) -> &Arc<AtomicBool> {
        &self.flag
    }

    /// Polls the flag and clears it.
    pub fn take(&self) -> bool {
        let was_set = self.look();
        if was_set {
            self.flag.store(false, Ordering::Relaxed);
        }
        was_set
    }

    /// Puts off an interrupt that [`take`](Self::take) has told: the next poll tells it again.
    /// Returns false where that has been done so often that it is to be heard at once.
    pub fn put_off(&self) -> bool {
        let put_off = self.put_off.get();
        if put_off == MAX_PUT_OFF {
            return false;
        }
        self.put_off.set(put_off + 1);
        self.flag.store(true, Ordering::Relaxed);
        true
    }

    /// Polls the flag.
    pub fn look(&self) -> bool {
        let count = self.count.get() + 1;
        self.count.set(count);
        if let Some(breathe) = self
            .breathe
            .get()
            .filter(|_| count.is_multiple_of(BETWEEN_BREATHS))
        {
            breathe();
        }
        let is_due = self.due_at.get() == Some(count);
        if let Some(after) = self.again.get().filter(|_| is_due) {
            self.due_at.set(Some(count + after));
        }
        let is_set = self.flag.load(Ordering::Relaxed) || is_due;
        if is_set {
            self.flag.store(true, Ordering::Relaxed);
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
        let polls = Polls::default();
        let flag = Arc::clone(polls.flag());
        assert!(!polls.look());
        flag.store(true, Ordering::Relaxed);
        assert!(polls.look());
        assert_eq!(polls.seen_at(), Some(2));

        flag.store(false, Ordering::Relaxed);
        polls.begin(Some(2));
        assert!(!polls.look());
        assert!(polls.look());
        assert!(flag.load(Ordering::Relaxed));
    }
}
