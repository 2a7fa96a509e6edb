//! Common Lisp functions that take simulated time.

use super::arithmetic::sleep;
use crate::state::Plan;
use lisp::builtin::Builtin;
use lisp::image::Image;
use lisp::typed::{self, builtin, builtins};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::step::Step;

/// Waits for so many simulated seconds.
///
/// `(sleep 1)` => `NIL`
#[builtin("SLEEP", "seconds")]
fn sleep_builtin(args: Vec<Value>) -> Result<Step, Box<Raise>> {
    sleep(&args)
}

/// Simulated seconds since the session began.
///
/// `(floatp (system:clock))` => `T`
#[builtin(_, "")]
fn clock(image: &mut Image) -> Result<Value, Box<Raise>> {
    Ok(Value::Double(Plan::of(image).now()))
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![sleep_builtin,];

/// The clock of the simulation, in package `SYSTEM`.
pub(crate) static CLOCK: &[Builtin] = builtins![clock,];
