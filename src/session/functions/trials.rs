//! Trials: what questions change in the world for themselves, and take back.

use super::asking::time_to_pass;
use crate::host::SimulationHost;
use crate::person::Person;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![begin_trial, end_trial, is_trial, let_pass];

/// From now on the world is one that is only tried out. Returns the number of the trial.
#[builtin("%BEGIN-TRIAL")]
fn begin_trial(host: &mut SimulationHost) -> usize {
    host.person.snapshots.begin_trial(&host.simulation)
}

/// The world is again as it was before the trial with that number began.
#[builtin("%END-TRIAL")]
fn end_trial(host: &mut SimulationHost, number: &Value) -> Result<()> {
    let number = match number {
        Value::Int(n) => usize::try_from(*n).unwrap_or(usize::MAX),
        _ => return Err(Raise::type_error(number, known::INTEGER)),
    };
    host.person
        .snapshots
        .end_trial(&mut host.simulation, number);
    Ok(())
}

/// Is the world only tried out?
///
/// `(btr::%trial-p)` => `NIL`
#[builtin("%TRIAL-P")]
fn is_trial(person: &mut Person) -> bool {
    person.snapshots.is_trial()
}

/// Lets time pass in a world that is only tried out.
#[builtin("%LET-PASS")]
fn let_pass(host: &mut SimulationHost, image: &mut Image, seconds: &Value) -> Result<()> {
    if !host.person.snapshots.is_trial() {
        return Err(Raise::simple(
            "Time passes in the world itself only for plans: (sleep SECONDS).",
        ));
    }
    let steps = (time_to_pass(seconds)? * 240.0).round();
    // The time is limited.
    for _ in 0..steps as u32 {
        if image.take_interrupt() {
            return Err(Raise::new(known::INTERACTIVE_INTERRUPT, "Interrupted."));
        }
        host.simulation.world.step();
    }
    Ok(())
}
