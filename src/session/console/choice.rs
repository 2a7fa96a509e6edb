//! A way to continue a stopped evaluation.

use lisp::value::Value;

/// A way to continue.
#[derive(Clone)]
pub(super) enum Choice {
    /// A restart of the program.
    Restart {
        restart: Value,
        /// Whether it needs a value.
        takes_value: bool,
    },
    /// Unwind a frame and call a function in its place.
    Call {
        /// Index of the frame's fiber, and of the frame in it.
        frame: (usize, usize),
        function: Value,
        args: Vec<Value>,
        /// The motion before which the world is restored first, by number.
        motion: Option<u64>,
    },
    /// Evaluate the form at top level again.
    RetryForm,
    /// Restore the world to before the form at top level, and evaluate that form again.
    RewindForm,
    /// Evaluate an edited form instead.
    EditForm,
    /// Return to the previous level.
    AbortLevel,
    /// Return to the top level.
    Abort,
}
