//! What a control builtin tells the machine to do next.

use std::any::Any;

use super::calls::Suspended;
use super::fiber::Target;
use crate::value::Value;

/// The next step of a control builtin.
pub enum Step {
    /// Return a value (`Value::values` for several).
    Return(Value),
    /// Call a function (or a symbol that names one) and hand its value to `then`.
    Call {
        function: Value,
        /// The arguments.
        args: Vec<Value>,
        /// Does `then` get all values (`Value::Multiple` unless exactly one), or the primary
        /// one?
        all: bool,
        /// What continues afterwards.
        then: Box<Suspended>,
    },
    /// Call a function in place of this builtin.
    TailCall {
        function: Value,
        /// The arguments.
        args: Vec<Value>,
    },
    /// Suspend the fiber with a request to the code that runs it; the answer is the value that the
    /// fiber is resumed with.
    Request(Box<dyn Any>),
    /// Like `Request`; the answer goes to `then`.
    RequestThen(Box<dyn Any>, Box<Suspended>),
    /// Leave everything inside a target, with a value.
    Unwind(Target, Value),
    /// Stop: a condition has found no handler.
    Unhandled(Value),
}

impl Step {
    /// Calls a function in place of this builtin.
    pub fn tail_call(function: impl Into<Value>, args: Vec<Value>) -> Step {
        Step::TailCall {
            function: function.into(),
            args,
        }
    }

    /// Makes a request whose answer is this builtin's value.
    pub fn request(request: impl Any) -> Step {
        Step::Request(Box::new(request))
    }
}

impl From<Value> for Step {
    fn from(value: Value) -> Step {
        Step::Return(value)
    }
}
