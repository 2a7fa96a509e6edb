//! A place that holds one value and can be assigned through a shared reference.

use std::cell::Cell;

use super::Value;

/// A mutable place for one value.
#[derive(Default)]
pub(crate) struct Slot(Cell<Value>);

impl Slot {
    /// A place that holds `value`.
    #[inline]
    pub(crate) fn new(value: Value) -> Slot {
        Slot(Cell::new(value))
    }

    /// The value.
    #[inline]
    pub(crate) fn get(&self) -> Value {
        let value = self.0.take();
        let copy = value.clone();
        // What is replaced is "no value", which needs not be freed.
        std::mem::forget(self.0.replace(value));
        copy
    }

    /// Looks at the value without counting a reference. `look` must not touch this slot.
    #[inline]
    pub(crate) fn with<R>(&self, look: impl FnOnce(&Value) -> R) -> R {
        let value = self.0.take();
        let result = look(&value);
        std::mem::forget(self.0.replace(value));
        result
    }

    /// Stores a value.
    #[inline]
    pub(crate) fn set(&self, value: Value) {
        self.0.set(value);
    }

    /// Takes the value out and leaves "no value".
    #[inline]
    pub(crate) fn take(&self) -> Value {
        self.0.take()
    }
}
