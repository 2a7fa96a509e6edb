//! What a motion requests from the host.

use lisp::source::Place;
use lisp::value::Value;

/// A motion to carry out. The fiber that made the request is resumed with the motion's value, or
/// with a failure.
pub struct MotionRequest {
    /// The motion designator.
    pub designator: Value,
    /// The motion's type in upper case, aliases resolved: `"GOING"`, `"MOVING-TCP"`, ….
    pub motion_type: String,
    /// Where the motion is performed.
    pub place: Place,
    /// The properties by key name in upper case, aliases resolved; locations remain designators.
    pub properties: Vec<(String, Value)>,
}

impl MotionRequest {
    /// The value of a property.
    pub fn property(&self, key: &str) -> Option<&Value> {
        self.properties
            .iter()
            .find(|(k, _)| k == key)
            .map(|(_, value)| value)
    }
}
