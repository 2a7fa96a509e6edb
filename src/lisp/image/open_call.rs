//! The calls in which a condition was signalled, as shown to the user.

use crate::source::Place;
use crate::value::Value;

/// A call that has not returned.
#[derive(Clone)]
pub struct OpenCall {
    /// The source place that it was executing; none for a builtin.
    pub place: Place,
    /// What the call is about, if the layer that made it says so.
    pub subject: Option<Value>,
}
