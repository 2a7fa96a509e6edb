//! One line of execution: its value stack, frames and dynamic entries.

/// A line of execution.
#[derive(Default)]
pub struct Fiber {}
