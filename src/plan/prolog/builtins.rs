//! `prolog`, `prove-one` and their kin.

use super::engine::{Engine, Progress};
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::{Resume, Step};

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Solutions that one query may have.
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
    let solutions = solve(engine, most, Box::new(|_, found| Ok(Step::Return(found))));
    solutions.go_on(machine)
}

/// What is done with the solutions.
type Finish = Box<dyn FnOnce(&mut Machine<'_>, Value) -> Result<Step>>;

/// The search for solutions of a query.
pub(crate) struct Solve {
    engine: Engine,
    found: Vec<Value>,
    most: usize,
    finish: Finish,
}

/// A search for at most so many solutions; `finish` gets the list of their bindings.
pub(crate) fn solve(engine: Engine, most: usize, finish: Finish) -> Box<Solve> {
    Box::new(Solve {
        engine,
        found: Vec::new(),
        most,
        finish,
    })
}

impl Solve {
    /// Starts the search.
    pub(crate) fn go_on(mut self: Box<Self>, machine: &mut Machine<'_>) -> Result<Step> {
        let progress = self.engine.run(machine.image)?;
        self.take(machine, progress)
    }

    fn take(mut self: Box<Self>, machine: &mut Machine<'_>, progress: Progress) -> Result<Step> {
        let mut progress = progress;
        loop {
            match progress {
                Progress::Call { function, args } => {
                    return Ok(Step::Call {
                        function,
                        args,
                        then: self,
                    });
                }
                Progress::Failed => break,
                Progress::Proved => {
                    let solution = self.engine.solution()?;
                    self.found.push(solution);
                    if self.found.len() >= self.most {
                        break;
                    }
                }
            }
            progress = self.engine.run(machine.image)?;
        }
        (self.finish)(machine, Value::list(self.found))
    }
}

impl Resume for Solve {
    fn resume(mut self: Box<Self>, machine: &mut Machine<'_>, value: Value) -> Result<Step> {
        let progress = self.engine.deliver(machine.image, value)?;
        self.take(machine, progress)
    }

    fn name(&self) -> &'static str {
        "PROLOG"
    }
}
