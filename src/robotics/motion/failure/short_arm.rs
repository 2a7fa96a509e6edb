//! An arm that is too short for a drawer or door.

use serde::Serialize;

use crate::robot::Side;

/// An arm that cannot move a drawer or door as far as wanted.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShortArm {
    /// The arm.
    pub side: Side,
    /// Name of the joint.
    pub joint: String,
    /// Where the joint is (rad or m).
    pub position: f64,
    /// Where it was to be.
    pub wanted: f64,
    /// How far the arm could bring it.
    pub reach: f64,
}
