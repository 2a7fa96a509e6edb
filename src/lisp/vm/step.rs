//! What a control builtin tells the machine to do next.

use std::any::Any;

use super::fiber::Target;
use super::machine::Machine;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;

/// The next step of a control builtin.
pub(crate) enum Step {
    /// Return a value (`Value::values` for several).
    Return(Value),
    /// Call a function (or a symbol that names one) and hand its primary value to `then`.
    Call {
        /// The function.
        function: Value,
        /// The arguments.
        args: Vec<Value>,
        /// What goes on afterwards.
        then: Box<dyn Resume>,
    },
    /// Like `Call`, but `then` gets all values (`Value::Multiple` unless exactly one).
    CallForValues {
        /// The function.
        function: Value,
        /// The arguments.
        args: Vec<Value>,
        /// What goes on afterwards.
        then: Box<dyn Resume>,
    },
    /// Call a function in place of this builtin.
    TailCall {
        /// The function.
        function: Value,
        /// The arguments.
        args: Vec<Value>,
    },
    /// Suspend the fiber with a request to whoever runs it; the answer is the value that
    /// the fiber is resumed with.
    Request(Box<dyn Any>),
    /// Like `Request`; the answer goes to `then`.
    RequestThen(Box<dyn Any>, Box<dyn Resume>),
    /// Leave everything inside a target, with a value.
    Unwind(Target, Value),
    /// Stop: a condition has found no handler.
    Unhandled(Value),
}

/// The rest of a control builtin that waits for the value of a call.
pub(crate) trait Resume {
    /// Goes on with the value.
    fn resume(self: Box<Self>, machine: &mut Machine<'_>, value: Value)
    -> Result<Step, Box<Raise>>;

    /// The builtin's name, for backtraces.
    fn name(&self) -> &'static str;

    /// What the builtin is about, if that is worth telling when something goes wrong
    /// inside it: the action that a plan carries out.
    fn subject(&self) -> Option<&Value> {
        None
    }

    /// How many motions had been begun before it, if that is worth knowing.
    fn motions_before(&self) -> Option<u64> {
        None
    }
}
