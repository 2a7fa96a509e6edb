//! What the person at the prompt did, and can go back to.

mod snapshots;

use crate::lisp::value::Value;
pub(crate) use snapshots::Snapshots;

/// The person at the prompt.
#[derive(Default)]
pub(crate) struct Person {
    /// The past that can be gone back to.
    pub(crate) snapshots: Snapshots,
    /// The step of the tour that comes next, from zero.
    pub(crate) tour_step: usize,
    /// A value that is to be taken apart.
    pub(crate) inspected: Option<Value>,
    /// The exit status, once leaving was asked for.
    pub(crate) quit: Option<u8>,
}
