//! Interrupting an evaluation from another thread.

use std::fmt;
use std::sync::Arc;

use super::running::Running;

/// Interrupts what a session evaluates, from any thread. Outlives the session, and then does nothing.
#[derive(Clone)]
pub struct InterruptHandle(pub(super) Arc<Running>);

impl InterruptHandle {
    /// Ends the evaluation under way as [`Failure::Interrupted`](crate::Failure::Interrupted): the plan
    /// is unwound, with its cleanup forms. These have the [`grace`](super::Limits::grace) of the
    /// evaluation, or until the next interrupt; then they are ended, too.
    ///
    /// Returns whether there was an evaluation. If there was none, nothing happens, and the next one
    /// is not interrupted.
    pub fn interrupt(&self) -> bool {
        let is_under_way = self.0.is_under_way();
        self.0.interrupt(None);
        is_under_way
    }
}

impl fmt::Debug for InterruptHandle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("InterruptHandle")
            .field("is_under_way", &self.0.is_under_way())
            .finish()
    }
}
