//! A place that holds one value and can be assigned through a shared reference.

use std::cell::Cell;
use std::rc::Rc;

use super::Value;
use super::cons::Cons;
use super::placing::push_made;

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
        match self.0.take() {
            Value::Int(n) => {
                self.put_back(Value::Int(n));
                Value::Int(n)
            }
            Value::Cons(cons) => {
                let copy = cons.clone();
                self.put_back(Value::Cons(cons));
                Value::Cons(copy)
            }
            other => {
                self.put_back(other);
                self.with(Value::clone_other)
            }
        }
    }

    /// Pushes a copy of the value onto a stack.
    #[inline(always)]
    pub(crate) fn push_copy(&self, stack: &mut Vec<Value>) {
        match self.0.take() {
            Value::Int(n) => {
                self.put_back(Value::Int(n));
                push_made(stack, || Value::Int(n));
            }
            Value::Cons(cons) => {
                let copy = cons.clone();
                self.put_back(Value::Cons(cons));
                push_made(stack, || Value::Cons(copy));
            }
            Value::Symbol(sym, hold) if hold.is_none() => {
                self.put_back(Value::symbol(sym));
                push_made(stack, || Value::symbol(sym));
            }
            other => {
                self.put_back(other);
                self.push_other(stack);
            }
        }
    }

    /// Puts a copy of the value into a place.
    #[inline(always)]
    pub(crate) fn copy_to(&self, place: &mut Value) {
        match self.0.take() {
            Value::Cons(cons) => {
                let copy = cons.clone();
                self.put_back(Value::Cons(cons));
                place.become_cons(copy);
            }
            other => {
                self.put_back(other);
                *place = self.with(Value::clone);
            }
        }
    }

    /// The pair, if the value is one.
    #[inline(always)]
    pub(crate) fn get_cons(&self) -> Option<Rc<Cons>> {
        match self.0.take() {
            Value::Cons(cons) => {
                let copy = cons.clone();
                self.put_back(Value::Cons(cons));
                Some(copy)
            }
            other => {
                self.put_back(other);
                None
            }
        }
    }

    /// Exchanges the value for one in another place.
    #[inline(always)]
    pub(crate) fn exchange(&self, place: &mut Value) {
        match self.0.take() {
            Value::Int(n) => {
                self.fill_from(place);
                std::mem::forget(std::mem::replace(place, Value::Int(n)));
            }
            Value::Cons(cons) => {
                self.fill_from(place);
                std::mem::forget(std::mem::replace(place, Value::Cons(cons)));
            }
            other => {
                self.fill_from(place);
                std::mem::forget(std::mem::replace(place, other));
            }
        }
    }

    /// Moves a value here, where there is "no value", and leaves that behind.
    #[inline(always)]
    pub(crate) fn fill_from(&self, place: &mut Value) {
        match std::mem::take(place) {
            Value::Int(n) => self.put_back(Value::Int(n)),
            Value::Symbol(sym, hold) if hold.is_none() => self.put_back(Value::symbol(sym)),
            Value::Cons(cons) => self.put_back(Value::Cons(cons)),
            other => self.put_back(other),
        }
    }

    #[inline(never)]
    fn push_other(&self, stack: &mut Vec<Value>) {
        stack.push(self.with(Value::clone_other));
    }

    /// Stores a value where it was just taken from. So what is replaced is "no value", which needs not
    /// be freed.
    #[inline(always)]
    fn put_back(&self, value: Value) {
        std::mem::forget(self.0.replace(value));
    }

    /// Looks at the value without counting a reference. `look` must not touch this slot.
    #[inline]
    pub(crate) fn with<R>(&self, look: impl FnOnce(&Value) -> R) -> R {
        let value = self.0.take();
        let result = look(&value);
        self.put_back(value);
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
