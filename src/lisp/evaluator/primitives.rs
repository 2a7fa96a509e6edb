//! Operations that compute a value from the topmost ones: pairs, tests, arithmetic.

use crate::lisp::value::Value;
use crate::lisp::value::cons::{self, Cons};
use crate::lisp::value::cycles;
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::operation::Comparison;
use crate::lisp::value::placing::push_made;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::machine::{Machine, UnderWay};

/// An operation on two numbers.
type Binary = fn(&Value, &Value) -> Result<Value, Box<Raise>>;

impl Machine<'_> {
    /// Pops the top value.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Value {
        self.fiber.stack.pop().unwrap_or_default()
    }

    /// Pushes `NIL`.
    #[inline(always)]
    pub(super) fn push_nil(&mut self) {
        push_made(&mut self.fiber.stack, || Value::NIL);
    }

    /// Pushes an integer.
    #[inline(always)]
    pub(super) fn push_int(&mut self, n: i64) {
        push_made(&mut self.fiber.stack, || Value::Int(n));
    }

    /// Pushes `T` or `NIL`.
    #[inline(always)]
    pub(super) fn push_bool(&mut self, truth: bool) {
        let sym = if truth { known::T } else { known::NIL };
        push_made(&mut self.fiber.stack, || Value::symbol(sym));
    }

    /// Drops the topmost `count` values.
    #[inline(always)]
    pub(super) fn drop_values(&mut self, count: u32) {
        self.cut_stack(self.fiber.stack.len() - count as usize);
    }

    /// Drops values down to a height: mostly one to three, of which few need to be freed.
    #[inline(always)]
    pub(super) fn cut_stack(&mut self, height: usize) {
        while self.fiber.stack.len() > height {
            self.drop_top();
        }
    }

    /// Drops the top, in its place.
    #[inline(always)]
    pub(super) fn drop_top(&mut self) {
        let stack = &mut self.fiber.stack;
        match stack.last_mut() {
            Some(value) if value.is_plain() => std::mem::forget(stack.pop()),
            Some(value @ Value::Cons(_)) => {
                let pair = value.take_pair();
                std::mem::forget(stack.pop());
                if let Some(pair) = pair {
                    cons::release(pair);
                }
            }
            _ => stack.truncate(stack.len().saturating_sub(1)),
        }
    }

    /// Drops `count` values below the top.
    #[inline(always)]
    pub(super) fn slide(&mut self, count: u32) {
        let stack = &mut self.fiber.stack;
        let height = stack.len() - count as usize;
        if let ([.., place], [.., top]) = stack.split_at_mut(height) {
            top.move_to(place);
        }
        self.cut_stack(height);
    }

    /// Pushes the top again.
    #[inline(always)]
    pub(super) fn duplicate(&mut self) {
        self.local(self.fiber.stack.len() - 1);
    }

    /// Pops the values of a call and pushes exactly `count` of them.
    pub(super) fn spread(&mut self, count: u32) {
        let count = count as usize;
        match self.pop() {
            Value::Multiple(values) => {
                for i in 0..count {
                    let value = values.get(i).cloned().unwrap_or(Value::NIL);
                    self.fiber.stack.push(value);
                }
            }
            single => {
                if count > 0 {
                    self.fiber.stack.push(single);
                }
                for _ in 1..count {
                    self.push_nil();
                }
            }
        }
    }

    /// Replaces the two topmost values with a pair of them.
    #[inline(always)]
    pub(super) fn join_top(&mut self) {
        let stack = &mut self.fiber.stack;
        if let [.., car, cdr] = stack.as_mut_slice() {
            let mut pair = Value::Cons(Cons::of_places(car, cdr));
            pair.move_to(car);
        }
        self.drop_top();
    }

    /// Replaces the top with its car.
    #[inline(always)]
    pub(super) fn car(&mut self) -> Result<(), Box<Raise>> {
        match self.fiber.stack.last_mut() {
            Some(value @ Value::Cons(_)) => {
                if let Some(cons) = value.take_pair() {
                    std::mem::forget(self.fiber.stack.pop());
                    cons.push_car(&mut self.fiber.stack);
                    cons::release(cons);
                }
            }
            Some(Value::Symbol(known::NIL, ..)) => {}
            _ => return Err(Raise::type_error(&self.pop(), known::LIST)),
        }
        Ok(())
    }

    /// Replaces the top with its cdr.
    #[inline(always)]
    pub(super) fn cdr(&mut self) -> Result<(), Box<Raise>> {
        match self.fiber.stack.last_mut() {
            Some(value @ Value::Cons(_)) => {
                if let Some(cons) = value.take_pair() {
                    std::mem::forget(self.fiber.stack.pop());
                    cons.push_cdr(&mut self.fiber.stack);
                    cons::release(cons);
                }
            }
            Some(Value::Symbol(known::NIL, ..)) => {}
            _ => return Err(Raise::type_error(&self.pop(), known::LIST)),
        }
        Ok(())
    }

    /// Pushes the car of a local.
    #[inline(always)]
    pub(super) fn local_car(&mut self, at: usize) -> Result<(), Box<Raise>> {
        // Another reference to the pair, since the stack that it stands in is pushed on.
        match &self.fiber.stack[at] {
            Value::Cons(cons) => {
                let cons = cons.clone();
                cons.push_car(&mut self.fiber.stack);
            }
            Value::Symbol(known::NIL, ..) => self.push_nil(),
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        Ok(())
    }

    /// Pushes the cdr of a local.
    #[inline(always)]
    pub(super) fn local_cdr(&mut self, at: usize) -> Result<(), Box<Raise>> {
        match &self.fiber.stack[at] {
            Value::Cons(cons) => {
                let cons = cons.clone();
                cons.push_cdr(&mut self.fiber.stack);
            }
            Value::Symbol(known::NIL, ..) => self.push_nil(),
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        Ok(())
    }

    /// Replaces a local by its cdr.
    #[inline(always)]
    pub(super) fn local_to_cdr(&mut self, at: usize) -> Result<(), Box<Raise>> {
        let local = &mut self.fiber.stack[at];
        match local {
            Value::Cons(cons) => {
                let cons = cons.clone();
                cons.copy_cdr_to(local);
            }
            Value::Symbol(known::NIL, ..) => {}
            other => return Err(Raise::type_error(other, known::LIST)),
        }
        Ok(())
    }

    /// Replaces the top with what a path leads to from it.
    pub(super) fn path(&mut self, path: u8) -> Result<(), Box<Raise>> {
        let value = self.pop();
        self.push_path(value, path)
    }

    /// Pushes what a path leads to from a local.
    pub(super) fn local_path(&mut self, at: usize, path: u8) -> Result<(), Box<Raise>> {
        self.push_path(self.fiber.stack[at].clone(), path)
    }

    #[inline(always)]
    fn push_path(&mut self, start: Value, mut path: u8) -> Result<(), Box<Raise>> {
        let Value::Cons(mut pair) = start else {
            return self.push_half_of_nil(&start);
        };
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
                return self.push_half_of_nil(&end);
            };
            pair = next;
            path >>= 1;
        }
        match path & 1 {
            0 => pair.push_car(&mut self.fiber.stack),
            _ => pair.push_cdr(&mut self.fiber.stack),
        }
        Ok(())
    }

    /// Pushes `NIL`, which is half of `NIL`; what else is no pair has none.
    fn push_half_of_nil(&mut self, value: &Value) -> Result<(), Box<Raise>> {
        if !value.is_nil() {
            return Err(Raise::type_error(value, known::LIST));
        }
        self.push_nil();
        Ok(())
    }

    /// `rplaca` of the two topmost values.
    pub(super) fn set_car(&mut self) -> Result<(), Box<Raise>> {
        match self.fiber.stack.as_mut_slice() {
            [.., Value::Cons(cons), value] => {
                cycles::note(cons, value);
                cons.exchange_car(value);
                self.drop_top();
            }
            _ => {
                self.drop_top();
                return Err(Raise::type_error(&self.pop(), known::CONS));
            }
        }
        Ok(())
    }

    /// `rplacd` of the two topmost values.
    pub(super) fn set_cdr(&mut self) -> Result<(), Box<Raise>> {
        match self.fiber.stack.as_mut_slice() {
            [.., Value::Cons(cons), value] => {
                cycles::note(cons, value);
                cons.exchange_cdr(value);
                self.drop_top();
            }
            _ => {
                self.drop_top();
                return Err(Raise::type_error(&self.pop(), known::CONS));
            }
        }
        Ok(())
    }

    /// Replaces a vector and an index by the element, and returns whether it can be done without
    /// the builtin: `aref` takes any vector, `svref` only simple ones.
    #[inline(always)]
    pub(super) fn element(&mut self, builtin: Sym) -> bool {
        let stack = &mut self.fiber.stack;
        let value = match stack.as_slice() {
            [.., Value::Vector(vector), Value::Int(index)]
                if builtin == known::AREF || vector.is_general_simple() =>
            {
                let index = usize::try_from(*index).unwrap_or(usize::MAX);
                vector.get(index)
            }
            _ => None,
        };
        let Some(value) = value else {
            return false;
        };
        stack.pop();
        stack.pop();
        stack.push(value);
        true
    }

    /// Stores the third value from the top in a vector at an index, leaving only the value, and
    /// returns whether it can be done without the builtin.
    #[inline(always)]
    pub(super) fn set_element(&mut self) -> bool {
        let stack = &mut self.fiber.stack;
        let done = match stack.as_slice() {
            [.., value, Value::Vector(vector), Value::Int(index)] if vector.is_general_simple() => {
                cycles::note(vector, value);
                let index = usize::try_from(*index).unwrap_or(usize::MAX);
                vector.set(index, value.clone())
            }
            _ => false,
        };
        if done {
            stack.pop();
            stack.pop();
        }
        done
    }

    /// Computes with numbers, which may be so large that this is left on the way; `pc` is the
    /// operation after this one, and its operands are off the stack.
    #[inline(never)]
    fn compute<T>(&mut self, pc: usize, work: impl FnOnce(&[Value]) -> T) -> T {
        let cut = self.fiber.stack.len();
        self.under_way = Some(UnderWay { pc, cut });
        let result = work(&self.fiber.stack);
        self.under_way = None;
        result
    }

    /// Replaces the two topmost values with the result of an operation on numbers.
    #[inline(always)]
    pub(super) fn arithmetic(
        &mut self,
        of_integers: fn(i64, i64) -> Option<i64>,
        of_numbers: Binary,
        pc: usize,
    ) -> Result<(), Box<Raise>> {
        let stack = &mut self.fiber.stack;
        if let [.., Value::Int(x), Value::Int(y)] = stack.as_mut_slice()
            && let Some(result) = of_integers(*x, *y)
        {
            *x = result;
            self.drop_top();
            return Ok(());
        }
        let b = self.pop();
        let a = self.pop();
        let value = self.compute(pc, |_| of_numbers(&a, &b))?;
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Adds a small integer to the top.
    #[inline(always)]
    pub(super) fn add_int(&mut self, n: i32, pc: usize) -> Result<(), Box<Raise>> {
        if let Some(Value::Int(x)) = self.fiber.stack.last_mut()
            && let Some(sum) = x.checked_add(i64::from(n))
        {
            *x = sum;
            return Ok(());
        }
        let a = self.pop();
        let value = self.compute(pc, |_| number::add(&a, &Value::Int(i64::from(n))))?;
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Pushes a local plus a small integer.
    #[inline(always)]
    pub(super) fn local_add_int(&mut self, at: usize, n: i32, pc: usize) -> Result<(), Box<Raise>> {
        let n = i64::from(n);
        if let Value::Int(x) = &self.fiber.stack[at]
            && let Some(sum) = x.checked_add(n)
        {
            self.push_int(sum);
            return Ok(());
        }
        let value = self.compute(pc, |stack| number::add(&stack[at], &Value::Int(n)))?;
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Adds a small integer to a local.
    #[inline(always)]
    pub(super) fn add_to_local(&mut self, at: usize, n: i32, pc: usize) -> Result<(), Box<Raise>> {
        let n = i64::from(n);
        if let Value::Int(x) = &mut self.fiber.stack[at]
            && let Some(sum) = x.checked_add(n)
        {
            *x = sum;
            return Ok(());
        }
        let value = self.compute(pc, |stack| number::add(&stack[at], &Value::Int(n)))?;
        self.fiber.stack[at] = value;
        Ok(())
    }

    /// Compares the two topmost values, and drops them.
    #[inline(always)]
    pub(super) fn compare(&mut self, comparison: Comparison) -> Result<bool, Box<Raise>> {
        let result = match self.fiber.stack.as_slice() {
            [.., a, b] => number::compare_like(comparison, a, b),
            _ => Ok(false),
        };
        self.drop_top();
        self.drop_top();
        result
    }

    /// Compares the top with a small integer, and drops it.
    #[inline(always)]
    pub(super) fn compare_int(
        &mut self,
        comparison: Comparison,
        n: i32,
    ) -> Result<bool, Box<Raise>> {
        let result = match self.fiber.stack.last() {
            Some(a) => number::compare_int(comparison, a, n),
            None => Ok(false),
        };
        self.drop_top();
        result
    }

    /// Has the top a property? Drops it.
    #[inline(always)]
    pub(super) fn test_top(&mut self, test: impl FnOnce(&Value) -> bool) -> bool {
        let result = self.fiber.stack.last().is_some_and(test);
        self.drop_top();
        result
    }

    /// Are the two topmost values the same object? Drops them.
    #[inline(always)]
    pub(super) fn are_eq(&mut self) -> bool {
        let result = match self.fiber.stack.as_slice() {
            [.., a, b] => a.is_eq(b),
            _ => false,
        };
        self.drop_top();
        self.drop_top();
        result
    }
}
