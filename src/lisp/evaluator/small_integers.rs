//! Arithmetic with the topmost values and locals as long as they and the result are small integers.

use crate::value::Value;
use crate::vm::stack::Window;

impl Window<'_> {
    /// Replaces the top with the result of an operation on it and a local, if both are integers and
    /// there is one.
    #[inline(always)]
    pub(super) fn combine_with(
        &mut self,
        i: usize,
        operation: fn(i64, i64) -> Option<i64>,
    ) -> bool {
        let Value::Int(y) = self.slots[i] else {
            return false;
        };
        if let Value::Int(x) = self.last_mut()
            && let Some(result) = operation(*x, y)
        {
            *x = result;
            return true;
        }
        false
    }

    /// Replaces the two topmost integers with the result of an operation, if they are that and have
    /// one.
    #[inline(always)]
    pub(super) fn combine(&mut self, operation: fn(i64, i64) -> Option<i64>) -> bool {
        if let Some([Value::Int(x), Value::Int(y)]) = self.two_mut()
            && let Some(result) = operation(*x, *y)
        {
            *x = result;
            self.top -= 1;
            return true;
        }
        false
    }

    /// Adds an integer to the top, if that is an integer and the sum is one.
    #[inline(always)]
    pub(super) fn add_int(&mut self, n: i64) -> bool {
        if let Value::Int(x) = self.last_mut()
            && let Some(sum) = x.checked_add(n)
        {
            *x = sum;
            return true;
        }
        false
    }

    /// Pushes the sum of a local and an integer, if both are integers and there is one.
    #[inline(always)]
    pub(super) fn local_add_int(&mut self, i: usize, n: i64) -> bool {
        if let Value::Int(x) = &self.slots[i]
            && let Some(sum) = x.checked_add(n)
        {
            self.push_int(sum);
            return true;
        }
        false
    }

    /// Adds an integer to a local, if that is an integer and the sum is one.
    #[inline(always)]
    pub(super) fn add_to_local(&mut self, i: usize, n: i64) -> bool {
        if let Value::Int(x) = &mut self.slots[i]
            && let Some(sum) = x.checked_add(n)
        {
            *x = sum;
            return true;
        }
        false
    }

    /// Two locals.
    #[inline(always)]
    pub(super) fn locals(&self, a: usize, b: usize) -> (&Value, &Value) {
        (&self.slots[a], &self.slots[b])
    }

    /// A local and the top.
    #[inline(always)]
    pub(super) fn local_and_last(&self, i: usize) -> (&Value, &Value) {
        (&self.slots[i], self.last())
    }
}

/// The integer, if the value is a small one.
#[inline(always)]
pub(super) fn int(value: &Value) -> Option<i64> {
    match value {
        Value::Int(n) => Some(*n),
        _ => None,
    }
}

/// The integers, if both values are small ones.
#[inline(always)]
pub(super) fn both_ints((a, b): (&Value, &Value)) -> Option<(i64, i64)> {
    Some((int(a)?, int(b)?))
}
