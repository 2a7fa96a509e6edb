//! Operations that compute a value from the topmost ones: pairs, tests, arithmetic.

use crate::lisp::value::Value;
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::machine::Machine;

/// An operation on two numbers.
type Binary = fn(&Value, &Value) -> Result<Value, Box<Raise>>;

impl Machine<'_> {
    /// Pops the top value.
    #[inline(always)]
    pub(super) fn pop(&mut self) -> Value {
        self.fiber.stack.pop().unwrap_or_default()
    }

    /// Drops the topmost `count` values.
    #[inline(always)]
    pub(super) fn drop_values(&mut self, count: u32) {
        let height = self.fiber.stack.len() - count as usize;
        self.fiber.stack.truncate(height);
    }

    /// Drops `count` values below the top.
    #[inline(always)]
    pub(super) fn slide(&mut self, count: u32) {
        let top = self.pop();
        self.drop_values(count);
        self.fiber.stack.push(top);
    }

    /// Pushes the top again.
    #[inline(always)]
    pub(super) fn duplicate(&mut self) {
        let top = self.fiber.stack.last().cloned().unwrap_or_default();
        self.fiber.stack.push(top);
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
                    self.fiber.stack.push(Value::NIL);
                }
            }
        }
    }

    /// Replaces the top with the result of a function.
    #[inline(always)]
    pub(super) fn map_top(&mut self, function: impl FnOnce(Value) -> Value) {
        let value = function(self.pop());
        self.fiber.stack.push(value);
    }

    /// Replaces the two topmost values with the result of a function.
    #[inline(always)]
    pub(super) fn join_top(&mut self, function: impl FnOnce(Value, Value) -> Value) {
        let b = self.pop();
        let a = self.pop();
        self.fiber.stack.push(function(a, b));
    }

    /// Replaces the top with its car.
    #[inline(always)]
    pub(super) fn car(&mut self) -> Result<(), Box<Raise>> {
        let value = match self.pop() {
            Value::Cons(cons) => cons.car(),
            Value::Symbol(known::NIL, ..) => Value::NIL,
            other => return Err(Raise::type_error(&other, known::LIST)),
        };
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Replaces the top with its cdr.
    #[inline(always)]
    pub(super) fn cdr(&mut self) -> Result<(), Box<Raise>> {
        let value = match self.pop() {
            Value::Cons(cons) => cons.cdr(),
            Value::Symbol(known::NIL, ..) => Value::NIL,
            other => return Err(Raise::type_error(&other, known::LIST)),
        };
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Replaces the two topmost values with the result of an operation on numbers.
    #[inline(always)]
    pub(super) fn arithmetic(&mut self, operation: Binary) -> Result<(), Box<Raise>> {
        let b = self.pop();
        let a = self.pop();
        let value = operation(&a, &b)?;
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Adds a small integer to the top.
    #[inline(always)]
    pub(super) fn add_int(&mut self, n: i32) -> Result<(), Box<Raise>> {
        let n = i64::from(n);
        let a = self.pop();
        let value = match &a {
            Value::Int(x) if x.checked_add(n).is_some() => Value::Int(x.wrapping_add(n)),
            _ => number::add(&a, &Value::Int(n))?,
        };
        self.fiber.stack.push(value);
        Ok(())
    }

    /// Replaces the two topmost values with the result of comparing them.
    #[inline(always)]
    pub(super) fn compare(
        &mut self,
        of_integers: fn(&i64, &i64) -> bool,
        of_numbers: fn(&Value, &Value) -> Result<bool, Box<Raise>>,
    ) -> Result<(), Box<Raise>> {
        let b = self.pop();
        let a = self.pop();
        let holds = match (&a, &b) {
            (Value::Int(x), Value::Int(y)) => of_integers(x, y),
            _ => of_numbers(&a, &b)?,
        };
        self.fiber.stack.push(Value::bool(holds));
        Ok(())
    }
}
