//! `explain`: the long form of the last failure.

use crate::host::call::{done, host};
use crate::simulation::Simulation;
use cram::Reply;
use lisp::builtin::{Builtin, control};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = &[
    control(
        "EXPLAIN",
        "",
        "Tells what is known about the last failure of a motion, and what would work instead: from where, with which arm and grasp, looking where. Of an action that has tried several things, tells what it has tried and why each failed.",
        &["(progn (pw:explain) :told) => :TOLD"],
        host!(explain),
    ),
    control(
        "REMEMBER-ACCOUNT",
        "text",
        "Keeps what an action that has failed tells of its attempts, for EXPLAIN, until a motion fails or another action.",
        &["(pw:remember-account \"Two places were occupied.\") => NIL"],
        host!(remember_account),
    ),
];

fn explain(
    simulation: &mut Simulation,
    image: &mut Image,
    _: &[Value],
) -> Result<Reply, Box<Raise>> {
    let text = simulation
        .explain_last(image)
        .unwrap_or_else(|| "No motion has failed yet.\n".to_owned());
    image.output.fresh_line();
    image.output.write(&text);
    done(Value::values(Vec::new()))
}

fn remember_account(
    simulation: &mut Simulation,
    _: &mut Image,
    args: &[Value],
) -> Result<Reply, Box<Raise>> {
    simulation.last_account = args[0].as_text();
    done(Value::NIL)
}
