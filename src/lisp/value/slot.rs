//! A place that holds one value and can be assigned through a shared reference.

use std::cell::Cell;
use std::mem::{forget, take};
use std::rc::Rc;

use super::Value;
use super::cons::Cons;

/// A mutable place for one value.
#[derive(Default)]
pub struct Slot(Cell<Value>);

impl Slot {
    /// A place that holds `value`.
    #[inline]
    pub fn new(value: Value) -> Slot {
        Slot(Cell::new(value))
    }

    /// The value.
    #[inline]
    pub fn get(&self) -> Value {
        let mut value = Value::Unbound;
        self.copy_into(&mut value);
        value
    }

    /// Stores a copy of the value where there is nothing to free.
    #[inline(always)]
    pub(crate) fn copy_into(&self, place: &mut Value) {
        // What is forgotten is plain, or has been put back; were it dropped, that would be checked.
        let value = self.0.take();
        match value {
            Value::Int(n) => {
                self.put_back(Value::Int(n));
                place.fill(Value::Int(n));
                forget(value);
            }
            Value::Cons(cons) => {
                let copy = cons.clone();
                self.put_back(Value::Cons(cons));
                place.fill(Value::Cons(copy));
            }
            Value::Symbol(sym, ref hold) if hold.is_none() => {
                self.put_back(Value::symbol(sym));
                place.fill(Value::symbol(sym));
                forget(value);
            }
            other => {
                self.put_back(other);
                self.copy_other_into(place);
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
        let mut value = self.0.take();
        self.fill_from(place);
        value.move_into(place);
        forget(value);
    }

    /// Moves a value here, where there is "no value", and leaves behind what needs not be freed.
    #[inline(always)]
    pub(crate) fn fill_from(&self, place: &mut Value) {
        match place {
            Value::Int(n) => self.put_back(Value::Int(*n)),
            Value::Symbol(sym, hold) if hold.is_none() => self.put_back(Value::symbol(*sym)),
            Value::Cons(_) => {
                if let Some(cons) = place.take_pair() {
                    self.put_back(Value::Cons(cons));
                }
            }
            other => self.put_back(take(other)),
        }
    }

    #[inline(never)]
    fn copy_other_into(&self, place: &mut Value) {
        place.fill(self.with(Value::clone_other));
    }

    /// Stores a value where it was just taken from. So what is replaced is "no value", which needs not
    /// be freed.
    #[inline(always)]
    fn put_back(&self, value: Value) {
        forget(self.0.replace(value));
    }

    /// Looks at the value without counting a reference. `look` must not touch this slot.
    #[inline]
    pub fn with<R>(&self, look: impl FnOnce(&Value) -> R) -> R {
        let value = self.0.take();
        let result = look(&value);
        self.put_back(value);
        result
    }

    /// Stores a value.
    #[inline]
    pub fn set(&self, value: Value) {
        self.0.set(value);
    }

    /// Takes the value out and leaves "no value".
    #[inline]
    pub fn take(&self) -> Value {
        self.0.take()
    }
}
