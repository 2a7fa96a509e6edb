//! What the Rust functions of builtins return.

use crate::value::Value;
use crate::value::raise::Raise;

/// A type that a builtin's function may return: all that is a value, or the result of such.
/// `()` is `NIL`, a tuple several values, an `Option` or a `Vec` a value or `NIL` or a list.
pub trait Returned {
    /// The values of the call, or the condition that it signals.
    fn returned(self) -> Result<Value, Box<Raise>>;
}

impl<T: Into<Value>> Returned for T {
    #[inline]
    fn returned(self) -> Result<Value, Box<Raise>> {
        Ok(self.into())
    }
}

impl<T: Into<Value>> Returned for Result<T, Box<Raise>> {
    #[inline]
    fn returned(self) -> Result<Value, Box<Raise>> {
        self.map(Into::into)
    }
}

impl From<()> for Value {
    fn from((): ()) -> Value {
        Value::NIL
    }
}

impl From<char> for Value {
    fn from(c: char) -> Value {
        Value::Char(c)
    }
}

impl From<String> for Value {
    fn from(text: String) -> Value {
        Value::string(text)
    }
}

impl From<u32> for Value {
    fn from(n: u32) -> Value {
        Value::Int(n.into())
    }
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Value {
        value.map_or(Value::NIL, Into::into)
    }
}

impl<T: Into<Value>> From<Vec<T>> for Value {
    fn from(items: Vec<T>) -> Value {
        Value::list(items.into_iter().map(Into::into))
    }
}

impl<A: Into<Value>, B: Into<Value>> From<(A, B)> for Value {
    fn from((first, second): (A, B)) -> Value {
        Value::values(vec![first.into(), second.into()])
    }
}
