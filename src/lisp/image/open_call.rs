//! The calls in which a condition was signalled, as shown to the user.

use crate::lisp::source::Place;
use crate::lisp::value::Value;

/// A call that has not returned.
#[derive(Clone)]
pub(crate) struct OpenCall {
    /// The source place that it was executing; none for a builtin.
    pub(crate) place: Place,
    /// What the call is about, if the layer that made it says so.
    pub(crate) subject: Option<Value>,
}
