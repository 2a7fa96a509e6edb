//! Values written straight into their places.
//!
//! A value that exists before its place is known has to be freed should finding the place panic. So it
//! is put together in memory, part by part, and then copied as a whole; and a processor that is to
//! load as a whole what it has just stored in parts waits until all of that has left for the cache,
//! which takes longer than most operations. What is made once its place is there is only stored.

use std::rc::Rc;

use super::Value;
use super::cons::{self, Cons};

/// Pushes what a function makes once there is room for it.
#[inline(always)]
pub(crate) fn push_made<T>(stack: &mut Vec<T>, make: impl FnOnce() -> T) {
    stack.extend(std::iter::once_with(make));
}

impl Value {
    /// Stores a value where there is nothing to free.
    #[inline(always)]
    pub fn fill(&mut self, value: Value) {
        std::mem::forget(std::mem::replace(self, value));
    }

    /// Stores a copy where there is nothing to free.
    #[inline(always)]
    pub(crate) fn copy_into(&self, place: &mut Value) {
        match self {
            Value::Int(n) => place.fill(Value::Int(*n)),
            Value::Cons(cons) => place.fill(Value::Cons(cons.clone())),
            Value::Symbol(sym, hold) if hold.is_none() => place.fill(Value::symbol(*sym)),
            other => other.copy_other_into(place),
        }
    }

    /// The same for a value of one of the less frequent kinds.
    #[inline(never)]
    fn copy_other_into(&self, place: &mut Value) {
        match self {
            Value::Vector(vector) => place.fill(Value::Vector(vector.clone())),
            other => place.fill(other.clone_other()),
        }
    }

    /// Drops the value, and leaves behind what needs not be freed.
    #[inline(always)]
    pub fn clear(&mut self) {
        if self.is_plain() {
            return;
        }
        if let Value::Cons(_) = self {
            if let Some(pair) = self.take_pair() {
                cons::release(pair);
            }
        } else {
            self.clear_other();
        }
    }

    #[inline(never)]
    fn clear_other(&mut self) {
        drop(std::mem::take(self));
    }

    /// Moves the value to a place where there is nothing to free, and leaves behind what needs not be
    /// freed.
    #[inline(always)]
    pub(crate) fn move_into(&mut self, place: &mut Value) {
        match self {
            Value::Int(n) => place.fill(Value::Int(*n)),
            Value::Symbol(sym, hold) if hold.is_none() => place.fill(Value::symbol(*sym)),
            Value::Cons(_) => {
                if let Some(cons) = self.take_pair() {
                    place.fill(Value::Cons(cons));
                }
            }
            _ => self.move_other_into(place),
        }
    }

    #[inline(never)]
    fn move_other_into(&mut self, place: &mut Value) {
        place.fill(std::mem::take(self));
    }

    /// Moves the value to another place, and leaves behind what needs not be freed.
    #[inline(always)]
    pub(crate) fn move_to(&mut self, place: &mut Value) {
        place.clear();
        self.move_into(place);
    }

    /// Takes out the pair, if the value is one, and leaves "no value" behind; a value of another kind
    /// must be one that needs not be freed.
    #[inline(always)]
    pub(crate) fn take_pair(&mut self) -> Option<Rc<Cons>> {
        match std::mem::take(self) {
            Value::Cons(cons) => Some(cons),
            other => {
                // Were it dropped, it would have to be put together in memory.
                std::mem::forget(other);
                None
            }
        }
    }
}
