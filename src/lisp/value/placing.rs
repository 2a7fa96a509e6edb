//! Values written straight into their places.
//!
//! A value that exists before its place is known has to be freed should finding the place panic. So it
//! is put together in memory, part by part, and then copied as a whole; and a processor that is to
//! load as a whole what it has just stored in parts waits until all of that has left for the cache,
//! which takes longer than most operations. What is made once its place is there is only stored.

use super::Value;

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

    /// Puts a copy into a place.
    #[inline(always)]
    pub(crate) fn copy_to(&self, place: &mut Value) {
        match self {
            Value::Cons(cons) => *place = Value::Cons(cons.clone()),
            Value::Symbol(sym, hold) if hold.is_none() => *place = Value::symbol(*sym),
            other => *place = other.clone_other(),
        }
    }
}
