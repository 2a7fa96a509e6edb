//! The calls in which a condition was signalled, as people are told of them.

use crate::lisp::source::Place;
use crate::lisp::value::Value;

/// A call that has not returned.
#[derive(Clone)]
pub(crate) struct OpenCall {
    /// The place in the source of what it was doing; none for a builtin.
    pub(crate) place: Place,
    /// What the call is about, if the layer that made it says so.
    pub(crate) subject: Option<Value>,
}
