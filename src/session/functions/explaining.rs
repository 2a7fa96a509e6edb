//! `explain`: the long form of the last failure.

use crate::simulation::Simulation;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;

/// Builtins of package `PLANWRIGHT`.
pub(super) static TABLE: &[Builtin] = builtins![explain, remember_account];

/// Tells what is known about the last failure of a motion, and what would work instead: from where, with
/// which arm and grasp, looking where. Of an action that has tried several things, tells what it has tried
/// and why each failed.
///
/// `(progn (pw:explain) :told)` => `:TOLD`
#[builtin]
fn explain(simulation: &mut Simulation, image: &mut Image) -> Value {
    let text = simulation
        .explain_last(image)
        .unwrap_or_else(|| "No motion has failed yet.\n".to_owned());
    image.output.fresh_line();
    image.output.write(&text);
    Value::values(Vec::new())
}

/// Keeps what an action that has failed tells of its attempts, for EXPLAIN, until a motion fails or another
/// action.
///
/// `(pw:remember-account "Two places were occupied.")` => `NIL`
#[builtin]
fn remember_account(simulation: &mut Simulation, text: &Value) {
    simulation.last_account = text.as_text();
}
