//! Pairs.

use std::cell::Cell;
use std::rc::Rc;

use super::Value;
use super::cycles::Mark;
use super::release;
use super::slot::Slot;
use super::spare;
use crate::source::Place;

/// A pair of two values, and where the reader found it.
pub struct Cons {
    car: Slot,
    cdr: Slot,
    place: Cell<Place>,
    mark: Mark,
}

impl Cons {
    /// A pair without a place in a source.
    #[inline]
    pub fn new(car: Value, cdr: Value) -> Cons {
        Cons {
            car: Slot::new(car),
            cdr: Slot::new(cdr),
            place: Cell::new(Place::NONE),
            mark: Mark::default(),
        }
    }

    /// A pair that is shared, without a place in a source.
    #[inline]
    pub fn shared(mut car: Value, mut cdr: Value) -> Rc<Cons> {
        Cons::of_places(&mut car, &mut cdr)
    }

    /// The same of values that are moved out of their places.
    #[inline(always)]
    pub(crate) fn of_places(car: &mut Value, cdr: &mut Value) -> Rc<Cons> {
        let cons = spare::take();
        cons.car.fill_from(car);
        cons.cdr.fill_from(cdr);
        cons
    }

    /// The first half.
    #[inline]
    pub fn car(&self) -> Value {
        self.car.get()
    }

    /// The second half.
    #[inline]
    pub fn cdr(&self) -> Value {
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

    /// Stores a copy of the first half where there is nothing to free.
    #[inline(always)]
    pub(crate) fn copy_car_into(&self, place: &mut Value) {
        self.car.copy_into(place);
    }

    /// Stores a copy of the second half where there is nothing to free.
    #[inline(always)]
    pub(crate) fn copy_cdr_into(&self, place: &mut Value) {
        self.cdr.copy_into(place);
    }

    /// The first half, if it is a pair.
    #[inline(always)]
    pub(crate) fn car_cons(&self) -> Option<Rc<Cons>> {
        self.car.get_cons()
    }

    /// The second half, if it is a pair.
    #[inline(always)]
    pub(crate) fn cdr_cons(&self) -> Option<Rc<Cons>> {
        self.cdr.get_cons()
    }

    /// Exchanges the first half for the value in a place.
    #[inline(always)]
    pub(crate) fn exchange_car(&self, place: &mut Value) {
        self.car.exchange(place);
    }

    /// Exchanges the second half for the value in a place.
    #[inline(always)]
    pub(crate) fn exchange_cdr(&self, place: &mut Value) {
        self.cdr.exchange(place);
    }

    /// Replaces the first half.
    #[inline]
    pub fn set_car(&self, value: Value) {
        self.car.set(value);
    }

    /// Replaces the second half.
    #[inline]
    pub fn set_cdr(&self, value: Value) {
        self.cdr.set(value);
    }

    /// Looks at both halves, the second one first. `visit` must not touch this pair.
    pub(super) fn for_each(&self, visit: &mut dyn FnMut(&Value)) {
        self.cdr.with(&mut *visit);
        self.car.with(visit);
    }

    /// What the collector has written on the pair.
    pub(super) fn mark(&self) -> &Mark {
        &self.mark
    }

    /// The pair is another one from now on.
    pub(super) fn renew(&mut self) {
        self.set_place(Place::NONE);
        self.mark = Mark::default();
    }

    /// Takes out both halves.
    pub(super) fn empty(&self) {
        drop(self.car.take());
        drop(self.cdr.take());
    }

    /// The place in the source of the list that starts with this pair.
    pub fn place(&self) -> Place {
        self.place.get()
    }

    /// Records the place in the source of the list that starts with this pair.
    pub fn set_place(&self, place: Place) {
        self.place.set(place);
    }
}

impl Drop for Cons {
    /// Frees long lists and deep trees with a loop: one level of the Rust stack, whatever the
    /// structure's depth.
    fn drop(&mut self) {
        let mut pending = Pending::default();
        pending.add_halves(self);
        if pending.next.is_some() {
            free_pending(pending, AT_ONCE);
        }
    }
}

/// Pairs that are freed in one go; longer lists are freed in parts.
const AT_ONCE: usize = 100_000;

/// Drops a reference to a pair.
#[inline(always)]
pub fn release(cons: Rc<Cons>) {
    if Rc::strong_count(&cons) == 1 {
        release_last(cons);
    }
}

#[inline(never)]
fn release_last(cons: Rc<Cons>) {
    let pending = Pending {
        next: Some(cons),
        others: Vec::new(),
    };
    free_pending(pending, AT_ONCE);
}

/// Frees pairs that nobody else holds, and what only they hold; the rest is put off after so
/// many. Returns their number.
pub(super) fn free(conses: Vec<Rc<Cons>>, most: usize) -> usize {
    let pending = Pending {
        next: None,
        others: conses,
    };
    free_pending(pending, most)
}

/// Pairs that nobody else holds.
#[derive(Default)]
struct Pending {
    next: Option<Rc<Cons>>,
    others: Vec<Rc<Cons>>,
}

impl Pending {
    /// Takes the halves out of a pair that is being freed.
    #[inline(always)]
    fn add_halves(&mut self, cons: &Cons) {
        for half in [&cons.car, &cons.cdr] {
            match half.take() {
                Value::Cons(inner) if Rc::strong_count(&inner) == 1 => {
                    if let Some(other) = self.next.replace(inner) {
                        self.others.push(other);
                    }
                }
                other => {
                    if !other.is_plain() {
                        drop(other);
                    }
                }
            }
        }
    }
}

fn free_pending(mut pending: Pending, most: usize) -> usize {
    let mut count = 0;
    while let Some(cons) = pending.next.take().or_else(|| pending.others.pop()) {
        pending.add_halves(&cons);
        spare::keep(cons);
        count += 1;
        if count == most {
            pending.others.extend(pending.next.take());
            if !pending.others.is_empty() {
                release::put_off(std::mem::take(&mut pending.others));
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use crate::value::cons::*;

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
