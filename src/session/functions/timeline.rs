//! The moments at which the world is remembered, for questions to the past.

use crate::host::SimulationHost;
use crate::person::Person;
use lisp::builtin::Builtin;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// Builtins of package `CRAM-BULLET-REASONING`.
pub(super) static TABLE: &[Builtin] = builtins![moments, serials, go_to_moment, keep_moments];

/// The simulated times (s) at which the world is remembered, in order.
///
/// `(listp (btr::%moments))` => `T`
#[builtin("%MOMENTS")]
fn moments(person: &mut Person) -> Value {
    Value::list(person.timeline.times().map(Value::Double))
}

/// Numbers by which the moments of %MOMENTS can be told apart for ever.
///
/// `(= (length (btr::%moment-serials)) (length (btr::%moments)))` => `T`
#[builtin("%MOMENT-SERIALS")]
fn serials(person: &mut Person) -> Value {
    let serials = person.timeline.serials();
    let serials = serials.map(|serial| Value::Int(i64::try_from(serial).unwrap_or(i64::MAX)));
    Value::list(serials)
}

/// From now on the world is remembered, or not; what was remembered is forgotten.
///
/// `(btr::%keep-moments t)` => `NIL`
#[builtin("%KEEP-MOMENTS")]
fn keep_moments(person: &mut Person, keep: bool) {
    person.timeline.set_off(!keep);
}

/// In a trial: the world is as it was at a moment, counted from 0.
#[builtin("%GO-TO-MOMENT")]
fn go_to_moment(host: &mut SimulationHost, number: &Value) -> Result<()> {
    if !host.person.snapshots.is_trial() {
        return Err(Raise::simple(
            "The world itself does not go back to a moment; (rewind) takes back forms.",
        ));
    }
    let number = match number {
        Value::Int(n) => usize::try_from(*n).unwrap_or(usize::MAX),
        _ => return Err(Raise::type_error(number, known::INTEGER)),
    };
    let Some(snapshot) = host.person.timeline.moment(number) else {
        return Err(Raise::simple(format!("There is no moment {number}.")));
    };
    snapshot.clone().put_back(&mut host.simulation);
    Ok(())
}
