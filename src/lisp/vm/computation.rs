//! Computations that stop where they need the value of a Lisp call.

use super::calls::{Args, Calls, run};
use super::machine::Machine;
use super::step::Step;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;

/// How far a computation has come.
pub(crate) enum Progress<T> {
    /// It has ended.
    Done(T),
    /// It needs the primary value of a call.
    Call {
        /// The function.
        function: Value,
        /// The arguments.
        args: Vec<Value>,
    },
}

/// A computation that may need Lisp calls.
pub(crate) trait Computation: 'static {
    /// What it computes.
    type Output: 'static;

    /// Goes on as far as possible. `answer` is the value of the call that it stopped at.
    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Self::Output>, Box<Raise>>;
}

impl Calls {
    /// Carries a computation out.
    pub(crate) async fn compute<C: Computation>(
        &self,
        mut computation: C,
    ) -> Result<C::Output, Box<Raise>> {
        let progress;
        (computation, progress) = self.advance(computation, None).await;
        self.finish(computation, progress?).await
    }

    async fn finish<C: Computation>(
        &self,
        mut computation: C,
        mut progress: Progress<C::Output>,
    ) -> Result<C::Output, Box<Raise>> {
        loop {
            let (function, args) = match progress {
                Progress::Done(output) => return Ok(output),
                Progress::Call { function, args } => (function, args),
            };
            let answer = self.call(&function, Args::Many(args)).await;
            let next;
            (computation, next) = self.advance(computation, Some(answer)).await;
            progress = next?;
        }
    }

    async fn advance<C: Computation>(
        &self,
        mut computation: C,
        answer: Option<Value>,
    ) -> (C, Result<Progress<C::Output>, Box<Raise>>) {
        self.with(move |machine| {
            let progress = computation.advance(machine, answer);
            (computation, progress)
        })
        .await
    }
}

/// A builtin that carries a computation out and ends with what it computes.
pub(crate) fn compute<C>(
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
        call @ Progress::Call { .. } => run(machine, name, |calls| async move {
            calls.finish(computation, call).await
        }),
    }
}
