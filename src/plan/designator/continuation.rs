//! What is done with the value of a call, as a function.

use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

pub(crate) type Result<T> = std::result::Result<T, Box<Raise>>;

/// The rest of a builtin after a value is known.
pub(crate) type Next = Box<dyn FnOnce(&mut Machine<'_>, Value) -> Result<Step>>;

struct Then {
    next: Next,
    name: &'static str,
    subject: Option<Value>,
    motions_before: Option<u64>,
}

impl Resume for Then {
    fn resume(self: Box<Self>, machine: &mut Machine<'_>, value: Value) -> Result<Step> {
        (self.next)(machine, value)
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn subject(&self) -> Option<&Value> {
        self.subject.as_ref()
    }

    fn motions_before(&self) -> Option<u64> {
        self.motions_before
    }
}

/// Calls a function and goes on with its primary value; `name` is shown in backtraces.
pub(crate) fn call(function: Value, args: Vec<Value>, name: &'static str, next: Next) -> Step {
    let subject = None;
    Step::Call {
        function,
        args,
        then: Box::new(Then {
            next,
            name,
            subject,
            motions_before: None,
        }),
    }
}

/// Calls the plan of an action for `PERFORM`: a condition inside it is told with the
/// action.
pub(crate) fn call_for(
    (action, motions_before): (Value, u64),
    plan: Value,
    args: Vec<Value>,
    next: Next,
) -> Step {
    Step::Call {
        function: plan,
        args,
        then: Box::new(Then {
            next,
            name: "PERFORM",
            subject: Some(action),
            motions_before: Some(motions_before),
        }),
    }
}

/// Ends with the value.
pub(crate) fn done() -> Next {
    Box::new(|_, value| Ok(Step::Return(value)))
}
