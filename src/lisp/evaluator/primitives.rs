//! Operations that compute a value from the topmost ones: pairs, elements, tests.
//!
//! The window is in registers as long as no function has its address. So all of its methods are
//! inlined, and what is not gets places or values.

use std::mem::forget;
use std::rc::Rc;

use crate::value::Value;
use crate::value::cons::{self, Cons};
use crate::value::cycles;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::stack::Window;

impl Window<'_> {
    /// The place of the value that is pushed next.
    #[inline(always)]
    pub(super) fn next(&mut self) -> &mut Value {
        let place = &mut self.slots[self.top];
        self.top += 1;
        place
    }

    /// Pushes a value.
    #[inline(always)]
    pub(super) fn push(&mut self, value: Value) {
        self.next().fill(value);
    }

    /// Pushes an integer.
    #[inline(always)]
    pub(super) fn push_int(&mut self, n: i64) {
        // Its place comes first: see `value::placing`.
        let place = self.next();
        place.fill(Value::Int(n));
    }

    /// Pushes `T` or `NIL`.
    #[inline(always)]
    pub(super) fn push_bool(&mut self, truth: bool) {
        let sym = if truth { known::T } else { known::NIL };
        let place = self.next();
        place.fill(Value::symbol(sym));
    }

    /// Pops the top value.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Value {
        self.top -= 1;
        std::mem::take(&mut self.slots[self.top])
    }

    /// The top value.
    #[inline(always)]
    pub(super) fn last(&self) -> &Value {
        &self.slots[self.top - 1]
    }

    /// The top value.
    #[inline(always)]
    pub(super) fn last_mut(&mut self) -> &mut Value {
        &mut self.slots[self.top - 1]
    }

    /// The two topmost values.
    #[inline(always)]
    pub(super) fn two(&self) -> (&Value, &Value) {
        (&self.slots[self.top - 2], &self.slots[self.top - 1])
    }

    /// The two topmost values.
    #[inline(always)]
    pub(super) fn two_mut(&mut self) -> Option<&mut [Value; 2]> {
        self.slots[..self.top].last_chunk_mut()
    }

    /// Drops the top, in its place.
    #[inline(always)]
    pub(super) fn drop_top(&mut self) {
        self.top -= 1;
        self.slots[self.top].clear();
    }

    /// Drops values down to a height: mostly one to three, of which few need to be freed.
    #[inline(always)]
    pub(super) fn cut(&mut self, top: usize) {
        while self.top > top {
            self.drop_top();
        }
    }

    /// Drops `count` values below the top.
    #[inline(always)]
    pub(super) fn slide(&mut self, count: u32) {
        let to = self.top - 1 - count as usize;
        if let [place, .., top] = &mut self.slots[to..self.top] {
            top.move_to(place);
        }
        self.cut(to + 1);
    }

    /// Makes the topmost values the arguments of the code again, which are its first slots.
    #[inline(always)]
    pub(super) fn take_arguments_again(&mut self, count: usize) {
        let (slots, arguments) = self.slots[..self.top].split_at_mut(self.top - count);
        for (place, argument) in slots.iter_mut().zip(arguments) {
            argument.move_to(place);
        }
        self.cut(count);
    }

    /// Pushes the top again.
    #[inline(always)]
    pub(super) fn duplicate(&mut self) {
        self.local(self.top - 1);
    }

    /// Replaces the two topmost values with a pair of them.
    #[inline(always)]
    pub(super) fn join_top(&mut self) {
        if let Some([car, cdr]) = self.two_mut() {
            let pair = Cons::of_places(car, cdr);
            car.fill(Value::Cons(pair));
        }
        self.top -= 1;
    }

    /// Replaces the top with its car.
    #[inline(always)]
    pub(super) fn car(&mut self) -> Result<(), Box<Raise>> {
        let value = self.last_mut();
        match value {
            Value::Cons(_) => {
                if let Some(cons) = value.take_pair() {
                    cons.copy_car_into(value);
                    cons::release(cons);
                }
                Ok(())
            }
            Value::Symbol(known::NIL, ..) => Ok(()),
            _ => self.no_list(),
        }
    }

    /// Replaces the top with its cdr.
    #[inline(always)]
    pub(super) fn cdr(&mut self) -> Result<(), Box<Raise>> {
        let value = self.last_mut();
        match value {
            Value::Cons(_) => {
                if let Some(cons) = value.take_pair() {
                    cons.copy_cdr_into(value);
                    cons::release(cons);
                }
                Ok(())
            }
            Value::Symbol(known::NIL, ..) => Ok(()),
            _ => self.no_list(),
        }
    }

    #[inline(always)]
    fn no_list(&mut self) -> Result<(), Box<Raise>> {
        Err(Raise::type_error(&self.pop(), known::LIST))
    }

    /// A local and the place of the value that is pushed next.
    #[inline(always)]
    fn local_and_next(&mut self, i: usize) -> (&mut Value, &mut Value) {
        let (used, room) = self.slots.split_at_mut(self.top);
        (&mut used[i], &mut room[0])
    }

    /// Pushes the car of a local.
    #[inline(always)]
    pub(super) fn local_car(&mut self, i: usize) -> Result<(), Box<Raise>> {
        let (local, next) = self.local_and_next(i);
        match local {
            Value::Cons(cons) => cons.copy_car_into(next),
            Value::Symbol(known::NIL, ..) => next.fill(Value::NIL),
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        self.top += 1;
        Ok(())
    }

    /// Pushes the cdr of a local.
    #[inline(always)]
    pub(super) fn local_cdr(&mut self, i: usize) -> Result<(), Box<Raise>> {
        let (local, next) = self.local_and_next(i);
        match local {
            Value::Cons(cons) => cons.copy_cdr_into(next),
            Value::Symbol(known::NIL, ..) => next.fill(Value::NIL),
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        self.top += 1;
        Ok(())
    }

    /// Replaces a local by its cdr.
    #[inline(always)]
    pub(super) fn local_to_cdr(&mut self, i: usize) -> Result<(), Box<Raise>> {
        let local = &mut self.slots[i];
        match local {
            Value::Cons(_) => {
                if let Some(cons) = local.take_pair() {
                    cons.copy_cdr_into(local);
                    cons::release(cons);
                }
            }
            Value::Symbol(known::NIL, ..) => {}
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        Ok(())
    }

    /// Replaces the top with what a path leads to from it.
    #[inline(always)]
    pub(super) fn path(&mut self, path: u8) -> Result<(), Box<Raise>> {
        let value = self.pop();
        let end = push_path(&value, path, self.next());
        self.unless_failed(end)
    }

    /// Pushes what a path leads to from a local.
    #[inline(always)]
    pub(super) fn local_path(&mut self, i: usize, path: u8) -> Result<(), Box<Raise>> {
        let (local, next) = self.local_and_next(i);
        let end = push_path(local, path, next);
        self.top += 1;
        self.unless_failed(end)
    }

    /// Takes back the place of a value that there is not.
    #[inline(always)]
    fn unless_failed(&mut self, result: Result<(), Box<Raise>>) -> Result<(), Box<Raise>> {
        if result.is_err() {
            self.top -= 1;
        }
        result
    }

    /// Pushes the element of a vector that is a local, at an index that is one, and returns whether it
    /// can be done without the builtin.
    #[inline(always)]
    pub(super) fn local_element(&mut self, is_simple: bool, vector: usize, index: usize) -> bool {
        let (used, room) = self.slots.split_at_mut(self.top);
        let (Value::Vector(vector), Value::Int(index)) = (&used[vector], &used[index]) else {
            return false;
        };
        if is_simple && !vector.is_general_simple() {
            return false;
        }
        let index = usize::try_from(*index).unwrap_or(usize::MAX);
        if !vector.copy_into(index, &mut room[0]) {
            return false;
        }
        self.top += 1;
        true
    }

    /// Pops a value and makes it the element of a vector that is a local, at an index that is one, and
    /// returns whether it can be done without the builtin.
    #[inline(always)]
    pub(super) fn set_local_element(&mut self, vector: usize, index: usize) -> bool {
        let (used, top) = self.slots.split_at_mut(self.top - 1);
        let (Value::Vector(vector), Value::Int(index)) = (&used[vector], &used[index]) else {
            return false;
        };
        if !vector.is_general_simple() {
            return false;
        }
        let value = &mut top[0];
        cycles::note(vector, value);
        let index = usize::try_from(*index).unwrap_or(usize::MAX);
        if !vector.move_into(index, value) {
            return false;
        }
        self.top -= 1;
        true
    }

    /// `rplaca` of the two topmost values.
    #[inline(always)]
    pub(super) fn set_car(&mut self) -> Result<(), Box<Raise>> {
        self.set_half(Cons::exchange_car)
    }

    /// `rplacd` of the two topmost values.
    #[inline(always)]
    pub(super) fn set_cdr(&mut self) -> Result<(), Box<Raise>> {
        self.set_half(Cons::exchange_cdr)
    }

    #[inline(always)]
    fn set_half(&mut self, exchange: impl FnOnce(&Cons, &mut Value)) -> Result<(), Box<Raise>> {
        if let Some([Value::Cons(cons), value]) = self.two_mut() {
            cycles::note(cons, value);
            exchange(cons, value);
            self.drop_top();
            return Ok(());
        }
        self.drop_top();
        Err(Raise::type_error(&self.pop(), known::CONS))
    }

    /// Replaces a vector and an index by the element, and returns whether it can be done without
    /// the builtin: `aref` takes any vector, `svref` only simple ones.
    #[inline(always)]
    pub(super) fn element(&mut self, builtin: Sym) -> bool {
        let Some([place, Value::Int(index)]) = self.two_mut() else {
            return false;
        };
        let index = usize::try_from(*index).unwrap_or(usize::MAX);
        match place {
            Value::Vector(vector) if builtin == known::AREF || vector.is_general_simple() => {}
            _ => return false,
        }
        // The element takes the place of the vector, which is there until it has been copied.
        if let Value::Vector(vector) = std::mem::take(place)
            && !vector.copy_into(index, place)
        {
            place.fill(Value::Vector(vector));
            return false;
        }
        self.top -= 1;
        true
    }

    /// Stores the third value from the top in a vector at an index, leaving only the value, and
    /// returns whether it can be done without the builtin.
    #[inline(always)]
    pub(super) fn set_element(&mut self) -> bool {
        let done = match &self.slots[..self.top] {
            [.., value, Value::Vector(vector), Value::Int(index)] if vector.is_general_simple() => {
                cycles::note(vector, value);
                let index = usize::try_from(*index).unwrap_or(usize::MAX);
                vector.set(index, value.clone())
            }
            _ => false,
        };
        if done {
            self.top -= 1;
            self.drop_top();
        }
        done
    }

    /// Puts the value of a call in place of its arguments, which begin at `start`; its first value only
    /// unless all are wanted.
    #[inline(always)]
    pub(super) fn return_value(&mut self, start: usize, mut value: Value, multi: bool) {
        self.cut(start);
        if !multi && matches!(value, Value::Multiple(_)) {
            value = value.primary();
        }
        value.move_into(self.next());
        // Nothing of it is left to be freed.
        forget(value);
    }

    /// Has the top a property? Drops it.
    #[inline(always)]
    pub(super) fn test_top(&mut self, test: impl FnOnce(&Value) -> bool) -> bool {
        let result = test(self.last());
        self.drop_top();
        result
    }

    /// Replaces the top with whether it has a property.
    #[inline(always)]
    pub(super) fn answer_top(&mut self, test: impl FnOnce(&Value) -> bool) {
        let result = self.test_top(test);
        self.push_bool(result);
    }

    /// Are the two topmost values the same object? Drops them.
    #[inline(always)]
    pub(super) fn are_eq(&mut self) -> bool {
        let (a, b) = self.two();
        let result = a.is_eq(b);
        self.drop_top();
        self.drop_top();
        result
    }
}

/// Is this a pair?
#[inline(always)]
pub(super) fn is_cons(value: &Value) -> bool {
    matches!(value, Value::Cons(_))
}

/// Stores what a path leads to from a value where there is nothing to free.
#[inline(never)]
fn push_path(start: &Value, mut path: u8, place: &mut Value) -> Result<(), Box<Raise>> {
    let Value::Cons(pair) = start else {
        return push_half_of_nil(start, place);
    };
    let mut pair = Rc::clone(pair);
    // The halves before the last one have to be pairs.
    while path > 0b11 {
        let next = match path & 1 {
            0 => pair.car_cons(),
            _ => pair.cdr_cons(),
        };
        let Some(next) = next else {
            let end = match path & 1 {
                0 => pair.car(),
                _ => pair.cdr(),
            };
            return push_half_of_nil(&end, place);
        };
        cons::release(std::mem::replace(&mut pair, next));
        path >>= 1;
    }
    match path & 1 {
        0 => pair.copy_car_into(place),
        _ => pair.copy_cdr_into(place),
    }
    cons::release(pair);
    Ok(())
}

/// Stores `NIL`, which is half of `NIL`; what else is no pair has none.
fn push_half_of_nil(value: &Value, place: &mut Value) -> Result<(), Box<Raise>> {
    if !value.is_nil() {
        return Err(Raise::type_error(value, known::LIST));
    }
    place.fill(Value::NIL);
    Ok(())
}
