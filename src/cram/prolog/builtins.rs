//! `prove-one`, and what `prolog` is made of.

use super::engine::{Engine, Progress};
use super::search::{NextProofs, Search};
use lisp::builtin::Builtin;
use lisp::image::Image;
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
#[builtin]
fn prove_one(machine: &mut Machine<'_>, query: &Value, bindings: Option<Value>) -> Result<Step> {
    let bindings = bindings.unwrap_or(Value::NIL);
    let engine = Engine::with_bindings(machine.image, query, &bindings)?;
    compute(machine, "PROVE-ONE", Solve::new(engine, 1))
}

/// A search for proofs.
#[builtin("%BEGIN-SEARCH")]
fn begin_search(image: &mut Image, query: &Value, bindings: &Value) -> Result<Value> {
    let engine = Engine::with_bindings(image, query, bindings)?;
    Ok(Value::foreign(Search::new(engine)))
}

/// Its next proofs, after whether there may be more.
#[builtin("%NEXT-PROOFS")]
fn next_proofs(machine: &mut Machine<'_>, search: Value) -> Result<Step> {
    compute(machine, "PROLOG", NextProofs::of(search))
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
