//! Control builtins as closures: what goes on after a call or a request.

use std::any::Any;

use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

pub(crate) type Result<T> = std::result::Result<T, Box<Raise>>;

struct Then<F> {
    name: &'static str,
    go_on: F,
}

impl<F> Resume for Then<F>
where
    F: FnOnce(&mut Machine<'_>, Value) -> Result<Step>,
{
    fn resume(self: Box<Self>, machine: &mut Machine<'_>, value: Value) -> Result<Step> {
        (self.go_on)(machine, value)
    }

    fn name(&self) -> &'static str {
        self.name
    }
}

/// Calls a function and goes on with its primary value.
pub(crate) fn call_then(
    name: &'static str,
    function: impl Into<Value>,
    args: Vec<Value>,
    go_on: impl FnOnce(&mut Machine<'_>, Value) -> Result<Step> + 'static,
) -> Step {
    Step::Call {
        function: function.into(),
        args,
        then: Box::new(Then { name, go_on }),
    }
}

/// Makes a request and goes on with the answer.
pub(crate) fn request_then(
    name: &'static str,
    request: impl Any,
    go_on: impl FnOnce(&mut Machine<'_>, Value) -> Result<Step> + 'static,
) -> Step {
    Step::RequestThen(Box::new(request), Box::new(Then { name, go_on }))
}
