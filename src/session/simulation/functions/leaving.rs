//! Leaving the shell.

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::session::simulation::call::host;
use crate::session::simulation::{Simulation, call};

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

fn quit(simulation: &mut Simulation, _: &mut Image, args: &[Value]) -> Result<Reply, Box<Raise>> {
    let status = args.first().and_then(number::to_f64).unwrap_or(0.0);
    simulation.quit = Some(status.clamp(0.0, 255.0) as u8);
    call::done(Value::NIL)
}
