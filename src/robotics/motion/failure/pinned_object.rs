//! An object that the robot presses onto something.

use serde::Serialize;

use crate::world::BodyName;

/// An object that the robot presses onto what carries it, harder than a limit and than
/// its own weight does.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PinnedObject {
    /// Name of the object.
    pub object: String,
    /// What it is pressed onto.
    pub(crate) against: BodyName,
    /// The force (N), without the object's weight.
    pub force: f64,
}
