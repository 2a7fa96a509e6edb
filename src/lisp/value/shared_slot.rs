//! A place that several share: a variable that a closure captures, or a slot of a class.

use std::ops::Deref;

use super::Value;
use super::cycles::Mark;
use super::slot::Slot;

/// A place for one value that several share.
#[derive(Default)]
pub struct SharedSlot {
    slot: Slot,
    mark: Mark,
}

impl SharedSlot {
    /// A place that holds `value`.
    #[inline]
    pub fn new(value: Value) -> SharedSlot {
        SharedSlot {
            slot: Slot::new(value),
            mark: Mark::default(),
        }
    }

    /// What the collector has written on it.
    pub(super) fn mark(&self) -> &Mark {
        &self.mark
    }
}

impl Deref for SharedSlot {
    type Target = Slot;

    #[inline]
    fn deref(&self) -> &Slot {
        &self.slot
    }
}
