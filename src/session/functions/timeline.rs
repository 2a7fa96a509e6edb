//! The moments at which the world is remembered, for questions to the past.

use crate::host::SimulationHost;
use crate::host::call::{done, host};
use crate::person::Person;
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
        "%MOMENTS",
        "",
        "The simulated times (s) at which the world is remembered, in order.",
        &["(listp (btr::%moments)) => T"],
        host!(moments),
    ),
    control(
        "%MOMENT-SERIALS",
        "",
        "Numbers by which the moments of %MOMENTS can be told apart for ever.",
        &["(= (length (btr::%moment-serials)) (length (btr::%moments))) => T"],
        host!(serials),
    ),
    control(
        "%GO-TO-MOMENT",
        "number",
        "In a trial: the world is as it was at a moment, counted from 0.",
        &[],
        host!(go_to_moment),
    ),
    control(
        "%KEEP-MOMENTS",
        "keep",
        "From now on the world is remembered, or not; what was remembered is forgotten.",
        &["(btr::%keep-moments t) => NIL"],
        host!(keep_moments),
    ),
];

fn moments(person: &mut Person, _: &mut Image, _: &[Value]) -> Result<Reply> {
    done(Value::list(person.timeline.times().map(Value::Double)))
}

fn serials(person: &mut Person, _: &mut Image, _: &[Value]) -> Result<Reply> {
    let serials = person.timeline.serials();
    let serials = serials.map(|serial| Value::Int(i64::try_from(serial).unwrap_or(i64::MAX)));
    done(Value::list(serials))
}

fn keep_moments(person: &mut Person, _: &mut Image, args: &[Value]) -> Result<Reply> {
    person.timeline.set_off(args[0].is_nil());
    done(Value::NIL)
}

fn go_to_moment(host: &mut SimulationHost, _: &mut Image, args: &[Value]) -> Result<Reply> {
    if !host.person.snapshots.is_trial() {
        return Err(Raise::simple(
            "The world itself does not go back to a moment; (rewind) takes back forms.",
        ));
    }
    let number = match args[0] {
        Value::Int(n) => usize::try_from(n).unwrap_or(usize::MAX),
        _ => return Err(Raise::type_error(&args[0], known::INTEGER)),
    };
    let Some(snapshot) = host.person.timeline.moment(number) else {
        return Err(Raise::simple(format!("There is no moment {number}.")));
    };
    snapshot.clone().put_back(&mut host.simulation);
    done(Value::NIL)
}
