//! `prove-one`, and what `prolog` is made of.

use super::engine::{Engine, Progress};
use super::search::{NextProofs, Search};
use lisp::builtin::Builtin;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::calls::Calls;
use lisp::vm::computation::{self, Computation, compute};
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// The first proof of a goal, under bindings that are known already: a list that holds its list of
/// bindings; NIL if there is none.
///
/// `(prolog:prove-one '(prolog:member ?x (1 2)))` => `(((?X . 1)))`
#[builtin(_, "query &optional bindings")]
fn prove_one(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let engine = begun(machine, &args)?;
    compute(machine, "PROVE-ONE", Solve::new(engine, 1))
}

/// A search for proofs.
#[builtin("%BEGIN-SEARCH", "query bindings")]
fn begin_search(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step> {
    let search = Search::new(begun(machine, &args)?);
    Ok(Step::Return(Value::foreign(search)))
}

/// Its next proofs, after whether there may be more.
#[builtin("%NEXT-PROOFS")]
fn next_proofs(machine: &mut Machine<'_>, search: Value) -> Result<Step> {
    compute(machine, "PROLOG", NextProofs::of(search))
}

fn begun(machine: &mut Machine<'_>, args: &[Value]) -> Result<Engine> {
    let known = args.get(1).cloned().unwrap_or(Value::NIL);
    Engine::with_bindings(machine.image, &args[0], &known)
}

/// The list of the bindings of up to `most` solutions.
pub async fn solve(calls: &Calls, engine: Engine, most: usize) -> Result<Value> {
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

/// Functions of package `CRAM-PROLOG`.
pub(crate) static TABLE: &[Builtin] = builtins![prove_one,];

/// What the library makes lazy lists of proofs of.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![begin_search, next_proofs,];
