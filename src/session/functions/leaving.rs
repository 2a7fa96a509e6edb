//! Exiting the shell.

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::session::host::call::{done, host};
use crate::session::person::Person;

/// Builtins of package `COMMON-LISP`.
pub(crate) static TABLE: &[Builtin] = &[
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
