//! Compiled code.

/// Compiled code of one function.
pub struct Code {}
