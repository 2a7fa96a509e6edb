//! Common Lisp functions that take simulated time.

use super::arithmetic::sleep;
use crate::state::Plan;
use lisp::builtin::{Builtin, control, pure};
use lisp::value::Value;

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[control(
    "SLEEP",
    "seconds",
    "Waits for so many simulated seconds.",
    &["(sleep 1) => NIL"],
    |_, args| sleep(&args),
)];

/// The clock of the simulation, in package `SYSTEM`.
pub(crate) static CLOCK: &[Builtin] = &[pure(
    "CLOCK",
    "",
    "Simulated seconds since the session began.",
    &["(floatp (system:clock)) => T"],
    |image, _| Ok(Value::Double(Plan::of(image).now())),
)];
