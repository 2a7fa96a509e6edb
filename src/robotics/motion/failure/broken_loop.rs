//! A motion that would part two hands from what they hold together.

use std::fmt;

use serde::Serialize;

/// How far a motion would take two hands from where they hold an object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BrokenLoop {
    /// Name of the object.
    pub object: String,
    /// How far (m) they would be moved relative to each other.
    pub distance: f64,
    /// How far (rad) they would be turned relative to each other.
    pub angle: f64,
}

impl fmt::Display for BrokenLoop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "both hands hold {}, and the motion would take them {:.1} mm apart and turn them by {:.1} degrees: \
             move both at once, straight, or let go with one of them",
            self.object,
            self.distance * 1e3,
            self.angle.to_degrees()
        )
    }
}
