//! Trials: what questions change in the world for themselves, and take back.

use super::asking::seconds;
use crate::host::SimulationHost;
use crate::host::call::{done, host};
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "%BEGIN-TRIAL",
        "",
        "From now on the world is one that is only tried out. Returns the number of the trial.",
        &[],
        host!(begin_trial),
    ),
    control(
        "%END-TRIAL",
        "number",
        "The world is again as it was before the trial with that number began.",
        &[],
        host!(end_trial),
    ),
    control(
        "%TRIAL-P",
        "",
        "Is the world only tried out?",
        &["(btr::%trial-p) => NIL"],
        host!(is_trial),
    ),
    control(
        "%LET-PASS",
        "seconds",
        "Lets time pass in a world that is only tried out.",
        &[],
        host!(let_pass),
    ),
];

fn begin_trial(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(Value::from(
        host.person.snapshots.begin_trial(&host.simulation),
    ))
}

fn end_trial(host: &mut SimulationHost, _: &mut Image, args: &[Value]) -> Result<Reply> {
    let number = match args[0] {
        Value::Int(n) => usize::try_from(n).unwrap_or(usize::MAX),
        _ => return Err(Raise::type_error(&args[0], known::INTEGER)),
    };
    host.person
        .snapshots
        .end_trial(&mut host.simulation, number);
    done(Value::NIL)
}

fn is_trial(host: &mut SimulationHost, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(Value::bool(host.person.snapshots.is_trial()))
}

fn let_pass(host: &mut SimulationHost, image: &mut Image, args: &[Value]) -> Result<Reply> {
    if !host.person.snapshots.is_trial() {
        return Err(Raise::simple(
            "Time passes in the world itself only for plans: (sleep SECONDS).",
        ));
    }
    let steps = (seconds(&args[0])? * 240.0).round();
    // The time is limited.
    for _ in 0..steps as u32 {
        if image.take_interrupt() {
            return Err(Raise::new(known::INTERACTIVE_INTERRUPT, "Interrupted."));
        }
        host.simulation.world.step();
    }
    done(Value::NIL)
}
