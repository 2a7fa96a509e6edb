//! Running an operation on types as a builtin: its calls go through the machine.

use super::specifier::{Answers, Stop};
use crate::image::Image;
use crate::value::Value;
use crate::value::raise::Raise;
use crate::vm::computation::{Computation, Progress, compute};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// An operation that may stop for a call.
pub type Operation = fn(&mut Image, &[Value], &mut Answers) -> Result<Value, Stop>;

/// Runs an operation, making the calls that it asks for.
pub fn run(
    machine: &mut Machine<'_>,
    name: &'static str,
    operation: Operation,
    args: Vec<Value>,
) -> Result<Step, Box<Raise>> {
    let asking = Asking {
        operation,
        args,
        answers: Answers::default(),
    };
    compute(machine, name, asking)
}

/// An operation with the answers to the calls that it has asked for so far. It starts again after
/// each answer.
struct Asking {
    operation: Operation,
    args: Vec<Value>,
    answers: Answers,
}

impl Computation for Asking {
    type Output = Value;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Value>, Box<Raise>> {
        if let Some(answer) = answer {
            self.answers.add(answer);
        }
        match (self.operation)(machine.image, &self.args, &mut self.answers) {
            Ok(value) => Ok(Progress::Done(value)),
            Err(Stop::Raise(raise) | Stop::UnknownType(raise)) => Err(raise),
            Err(Stop::Call { function, args }) => Ok(Progress::Call { function, args }),
        }
    }
}
