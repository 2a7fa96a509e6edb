//! `prolog`, `prove-one` and the like.

use super::engine::{Engine, Progress};
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::calls::Calls;
use crate::lisp::vm::computation::{self, Computation, compute};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Maximum number of solutions of a query.
const MOST_SOLUTIONS: usize = 100_000;

/// Functions of package `CRAM-PROLOG`.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "PROLOG",
        "query",
        "All proofs of a goal: a list of lists of bindings; NIL if there is none.",
        &["(prolog:prolog '(prolog:member ?x (1 2))) => (((?X . 1)) ((?X . 2)))"],
        |machine, args| start(machine, &args[0], MOST_SOLUTIONS),
    ),
    control(
        "PROVE-ALL",
        "query &optional bindings",
        "All proofs of a goal: a list of lists of bindings.",
        &["(prolog:prove-all '(prolog:member ?x (1 2))) => (((?X . 1)) ((?X . 2)))"],
        |machine, args| start(machine, &args[0], MOST_SOLUTIONS),
    ),
    control(
        "PROVE-ONE",
        "query &optional bindings",
        "The first proof of a goal: a list that holds its list of bindings; NIL if there is none.",
        &["(prolog:prove-one '(prolog:member ?x (1 2))) => (((?X . 1)))"],
        |machine, args| start(machine, &args[0], 1),
    ),
];

fn start(machine: &mut Machine<'_>, query: &Value, most: usize) -> Result<Step> {
    let engine = Engine::new(machine.image, query)?;
    compute(machine, "PROLOG", Solve::new(engine, most))
}

/// The list of the bindings of up to `most` solutions.
pub(crate) async fn solve(calls: &Calls, engine: Engine, most: usize) -> Result<Value> {
    calls.compute(Solve::new(engine, most)).await
}

/// The search for solutions of a query.
struct Solve {
    engine: Engine,
    found: Vec<Value>,
    most: usize,
}

impl Solve {
    fn new(engine: Engine, most: usize) -> Solve {
        Solve {
            engine,
            found: Vec::new(),
            most,
        }
    }
}

impl Computation for Solve {
    type Output = Value;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<computation::Progress<Value>> {
        let mut progress = match answer {
            Some(value) => self.engine.deliver(machine.image, value)?,
            None => self.engine.run(machine.image)?,
        };
        loop {
            match progress {
                Progress::Call { function, args } => {
                    return Ok(computation::Progress::Call { function, args });
                }
                Progress::Failed => break,
                Progress::Proved => {
                    self.found.push(self.engine.solution()?);
                    if self.found.len() >= self.most {
                        break;
                    }
                }
            }
            progress = self.engine.run(machine.image)?;
        }
        let found = Value::list(std::mem::take(&mut self.found));
        Ok(computation::Progress::Done(found))
    }
}
