//! Pairs.

use std::cell::Cell;
use std::rc::Rc;

use super::Value;
use super::release;
use super::slot::Slot;
use crate::lisp::source::Place;

/// A pair of two values, and where the reader found it.
pub(crate) struct Cons {
    car: Slot,
    cdr: Slot,
    place: Cell<Place>,
}

impl Cons {
    /// A pair without a place in a source.
    #[inline]
    pub(crate) fn new(car: Value, cdr: Value) -> Cons {
        Cons {
            car: Slot::new(car),
            cdr: Slot::new(cdr),
            place: Cell::new(Place::NONE),
        }
    }

    /// The first half.
    #[inline]
    pub(crate) fn car(&self) -> Value {
        self.car.get()
    }

    /// The second half.
    #[inline]
    pub(crate) fn cdr(&self) -> Value {
        self.cdr.get()
    }

    /// Looks at the first half. `look` must not touch this pair.
    pub(super) fn with_car<R>(&self, look: impl FnOnce(&Value) -> R) -> R {
        self.car.with(look)
    }

    /// Looks at the second half. `look` must not touch this pair.
    pub(super) fn with_cdr<R>(&self, look: impl FnOnce(&Value) -> R) -> R {
        self.cdr.with(look)
    }

    /// Pushes the first half onto a stack.
    #[inline(always)]
    pub(crate) fn push_car(&self, stack: &mut Vec<Value>) {
        self.car.push_copy(stack);
    }

    /// Pushes the second half onto a stack.
    #[inline(always)]
    pub(crate) fn push_cdr(&self, stack: &mut Vec<Value>) {
        self.cdr.push_copy(stack);
    }

    /// Puts the second half into a place.
    #[inline(always)]
    pub(crate) fn copy_cdr_to(&self, place: &mut Value) {
        self.cdr.with(|value| value.copy_to(place));
    }

    /// Replaces the first half.
    #[inline]
    pub(crate) fn set_car(&self, value: Value) {
        self.car.set(value);
    }

    /// Replaces the second half.
    #[inline]
    pub(crate) fn set_cdr(&self, value: Value) {
        self.cdr.set(value);
    }

    /// Looks at both halves. `visit` must not touch this pair.
    pub(super) fn for_each(&self, visit: &mut dyn FnMut(&Value)) {
        self.car.with(&mut *visit);
        self.cdr.with(visit);
    }

    /// Takes out both halves.
    pub(super) fn empty(&self) {
        drop(self.car.take());
        drop(self.cdr.take());
    }

    /// The place in the source of the list that starts with this pair.
    pub(crate) fn place(&self) -> Place {
        self.place.get()
    }

    /// Records the place in the source of the list that starts with this pair.
    pub(crate) fn set_place(&self, place: Place) {
        self.place.set(place);
    }
}

impl Drop for Cons {
    /// Frees long lists and deep trees with a loop: one level of the Rust stack, whatever the
    /// structure's depth.
    fn drop(&mut self) {
        let mut pending = Vec::new();
        collect_unshared(self, &mut pending);
        if !pending.is_empty() {
            free(pending, AT_ONCE);
        }
    }
}

/// Pairs that are freed in one go; longer lists are freed in parts.
const AT_ONCE: usize = 100_000;

/// Frees pairs that nobody else holds, and what only they hold; the rest is put off after so
/// many. Returns their number.
pub(super) fn free(mut pending: Vec<Rc<Cons>>, most: usize) -> usize {
    let mut count = 0;
    while let Some(cons) = pending.pop() {
        if let Ok(inner) = Rc::try_unwrap(cons) {
            collect_unshared(&inner, &mut pending);
        }
        count += 1;
        if count == most && !pending.is_empty() {
            release::put_off(std::mem::take(&mut pending));
        }
    }
    count
}

fn collect_unshared(cons: &Cons, pending: &mut Vec<Rc<Cons>>) {
    for slot in [&cons.car, &cons.cdr] {
        if slot.with(|v| matches!(v, Value::Cons(_)))
            && let Value::Cons(inner) = slot.take()
            && Rc::strong_count(&inner) == 1
        {
            pending.push(inner);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::lisp::value::cons::*;

    #[test]
    fn a_million_deep_list_is_freed_without_recursion() {
        let mut right = Value::NIL;
        let mut left = Value::NIL;
        for i in 0..1_000_000 {
            right = Value::cons(Value::Int(i), right);
            left = Value::cons(left, Value::Int(i));
        }
        drop(right);
        drop(left);
        release::all();
    }
}
