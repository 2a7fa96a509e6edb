//! What a motion requests from the host.

use crate::lisp::source::Place;
use crate::lisp::value::Value;

/// A motion to carry out. The fiber that made the request is resumed with the motion's value, or
/// with a failure.
pub(crate) struct MotionRequest {
    /// The motion designator.
    pub(crate) designator: Value,
    /// The motion's type in upper case, aliases resolved: `"GOING"`, `"MOVING-TCP"`, ….
    pub(crate) motion_type: String,
    /// Where the motion is performed.
    pub(crate) place: Place,
    /// The properties by key name in upper case, aliases resolved; locations remain designators.
    pub(crate) properties: Vec<(String, Value)>,
}

impl MotionRequest {
    /// The value of a property.
    pub(crate) fn property(&self, key: &str) -> Option<&Value> {
        self.properties
            .iter()
            .find(|(k, _)| k == key)
            .map(|(_, value)| value)
    }
}
