//! Exiting the shell.

use crate::host::call::{done, host};
use crate::person::Person;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::number;
use lisp::value::raise::Raise;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "QUIT",
        "&optional status",
        "Leaves the shell.",
        &[],
        host!(quit),
    ),
    control(
        "EXIT",
        "&optional status",
        "Leaves the shell.",
        &[],
        host!(quit),
    ),
];

fn quit(person: &mut Person, _: &mut Image, args: &[Value]) -> Result<Reply, Box<Raise>> {
    let status = args.first().and_then(number::to_f64).unwrap_or(0.0);
    person.quit = Some(status.clamp(0.0, 255.0) as u8);
    done(Value::NIL)
}
