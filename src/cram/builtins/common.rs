//! Common Lisp functions that take simulated time.

use super::arithmetic::{self, Seconds};
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
#[builtin]
fn sleep(seconds: Seconds) -> Result<Step, Box<Raise>> {
    arithmetic::sleep(seconds)
}

/// Simulated seconds since the session began.
///
/// `(floatp (system:clock))` => `T`
#[builtin(_, "")]
fn clock(image: &mut Image) -> Result<Value, Box<Raise>> {
    Ok(Value::Double(Plan::of(image).now()))
}

/// The builtins.
pub(crate) static TABLE: &[Builtin] = builtins![sleep,];

/// The clock of the simulation, in package `SYSTEM`.
pub(crate) static CLOCK: &[Builtin] = builtins![clock,];
