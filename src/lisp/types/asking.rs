//! Running an operation on types as a builtin: its calls go through the machine.

use super::specifier::{Answers, Stop};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

/// An operation that may stop for a call.
pub(crate) type Operation = fn(&mut Image, &[Value], &mut Answers) -> Result<Value, Stop>;

/// Runs an operation, making the calls that it asks for.
pub(crate) fn run(
    machine: &mut Machine<'_>,
    name: &'static str,
    operation: Operation,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    Box::new(Asking {
        name,
        operation,
        args,
        answers: Answers::default(),
    })
    .advance(machine)
}

struct Asking {
    name: &'static str,
    operation: Operation,
    args: Vec<Value>,
    answers: Answers,
}

impl Asking {
    fn advance(mut self: Box<Self>, machine: &mut Machine<'_>) -> Result<Step, Box<Raise>> {
        match (self.operation)(machine.image, &self.args, &mut self.answers) {
            Ok(value) => Ok(Step::Return(value)),
            Err(Stop::Raise(raise) | Stop::UnknownType(raise)) => Err(raise),
            Err(Stop::Call { function, args }) => Ok(Step::Call {
                function,
                args,
                then: self,
            }),
        }
    }
}

impl Resume for Asking {
    fn resume(
        mut self: Box<Self>,
        machine: &mut Machine<'_>,
        value: Value,
    ) -> Result<Step, Box<Raise>> {
        self.answers.add(value);
        self.advance(machine)
    }

    fn name(&self) -> &'static str {
        self.name
    }
}
