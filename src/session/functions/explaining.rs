//! `explain`: the long form of the last failure.

use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::plan::Reply;
use crate::session::host::call::{done, host};
use crate::session::simulation::Simulation;

/// Builtins of package `PLANWRIGHT`.
pub(crate) static TABLE: &[Builtin] = &[control(
    "EXPLAIN",
    "",
    "Tells what is known about the last failure of a motion, and what would work instead: from where, with which arm and grasp, looking where.",
    &["(progn (pw:explain) :told) => :TOLD"],
    host!(explain),
)];

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
