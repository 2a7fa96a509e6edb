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
    /// Pushes a copy onto a stack.
    #[inline(always)]
    pub(crate) fn push_copy(&self, stack: &mut Vec<Value>) {
        match self {
            Value::Int(n) => push_made(stack, || Value::Int(*n)),
            Value::Cons(cons) => push_made(stack, || Value::Cons(cons.clone())),
            Value::Symbol(sym, hold) if hold.is_none() => push_made(stack, || Value::symbol(*sym)),
            Value::Vector(vector) => push_made(stack, || Value::Vector(vector.clone())),
            other => other.push_other(stack),
        }
    }

    /// Pushes a copy of a value of one of the less frequent kinds.
    #[inline(never)]
    fn push_other(&self, stack: &mut Vec<Value>) {
        stack.push(self.clone_other());
    }

    /// Moves the value to another place, and leaves behind what needs not be freed.
    #[inline(always)]
    pub(crate) fn move_to(&mut self, place: &mut Value) {
        match self {
            Value::Int(n) => place.become_plain(Value::Int(*n)),
            Value::Symbol(sym, hold) if hold.is_none() => place.become_plain(Value::symbol(*sym)),
            Value::Cons(_) => {
                if let Some(cons) = self.take_pair() {
                    place.become_cons(cons);
                }
            }
            _ => self.move_other_to(place),
        }
    }

    #[inline(never)]
    fn move_other_to(&mut self, place: &mut Value) {
        *place = std::mem::take(self);
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

    /// Puts a value of which there is nothing to free into this place.
    #[inline(always)]
    fn become_plain(&mut self, value: Value) {
        if self.is_plain() {
            std::mem::forget(std::mem::replace(self, value));
        } else {
            *self = value;
        }
    }

    /// Puts a pair into this place, where there is often one.
    #[inline(always)]
    pub(super) fn become_cons(&mut self, cons: Rc<Cons>) {
        match self {
            Value::Cons(old) => cons::release(std::mem::replace(old, cons)),
            _ if self.is_plain() => {
                std::mem::forget(std::mem::replace(self, Value::Cons(cons)));
            }
            _ => *self = Value::Cons(cons),
        }
    }
}
