//! An object that the robot has pushed along.

use serde::Serialize;

use crate::world::BodyName;

/// An object that the robot has pushed along.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PushedObject {
    /// Name of the object.
    pub object: String,
    /// The part of the robot that touches it.
    pub by: BodyName,
    /// How far (m) it has been pushed.
    pub distance: f64,
}
