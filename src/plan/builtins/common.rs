//! Common Lisp functions that take simulated time.

use super::arithmetic::sleep;
use crate::lisp::builtin::{Builtin, control};

/// The builtins.
pub(crate) static TABLE: &[Builtin] = &[control(
    "SLEEP",
    "seconds",
    "Waits for so many simulated seconds.",
    &["(sleep 1) => NIL"],
    |_, args| sleep(&args),
)];
