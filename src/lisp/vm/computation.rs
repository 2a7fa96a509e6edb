//! Computations that stop where they need the value of a Lisp call.

use super::calls::{Args, Calls, Suspended};
use super::machine::Machine;
use super::step::Step;
use crate::value::Value;
use crate::value::raise::Raise;

/// How far a computation has progressed.
pub enum Progress<T> {
    /// It has ended.
    Done(T),
    /// It needs the primary value of a call.
    Call {
        function: Value,
        /// The arguments.
        args: Vec<Value>,
    },
}

/// A computation that may need Lisp calls.
pub trait Computation: 'static {
    /// What it computes.
    type Output: 'static;

    /// Whether even pure builtins are called on top of a frame, for the sake of dynamic
    /// entries made for the call.
    const NEEDS_FRAME: bool = false;

    /// Continues as far as possible. `answer` is the value of the call that it stopped at.
    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Self::Output>, Box<Raise>>;
}

impl Calls {
    /// Carries a computation out.
    pub async fn compute<C: Computation>(&self, computation: C) -> Result<C::Output, Box<Raise>> {
        // Boxed, since it moves to the machine and back for every call.
        let mut computation = Box::new(computation);
        let mut answer = None;
        loop {
            let progress;
            (computation, progress) = self
                .with(move |machine| {
                    let progress = computation.advance(machine, answer);
                    (computation, progress)
                })
                .await;
            match progress? {
                Progress::Done(output) => return Ok(output),
                Progress::Call { function, args } => {
                    answer = Some(self.call(&function, Args::Many(args)).await);
                }
            }
        }
    }
}

/// A builtin that carries a computation out and ends with what it computes.
pub fn compute<C>(
    machine: &mut Machine<'_>,
    name: &'static str,
    mut computation: C,
) -> Result<Step, Box<Raise>>
where
    C: Computation,
    C::Output: Into<Step>,
{
    match computation.advance(machine, None)? {
        Progress::Done(output) => Ok(output.into()),
        Progress::Call { function, args } => {
            let suspended = Suspended::in_computation(name, Box::new(computation));
            Box::new(suspended).go_on_computing(machine, Progress::Call { function, args })
        }
    }
}

/// The rest of a builtin that is a computation.
pub(super) trait Remainder {
    /// See [`Computation::NEEDS_FRAME`].
    fn needs_frame(&self) -> bool;

    /// See [`Computation::advance`].
    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Step>, Box<Raise>>;
}

impl<C> Remainder for C
where
    C: Computation,
    C::Output: Into<Step>,
{
    fn needs_frame(&self) -> bool {
        C::NEEDS_FRAME
    }

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Step>, Box<Raise>> {
        Ok(match Computation::advance(self, machine, answer)? {
            Progress::Done(output) => Progress::Done(output.into()),
            Progress::Call { function, args } => Progress::Call { function, args },
        })
    }
}
