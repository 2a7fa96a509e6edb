//! A drawer or door that something stops.

use serde::Serialize;

use crate::world::CollisionHit;

/// A drawer or door that was stopped, or would be.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StoppedPart {
    /// Name of the joint.
    pub joint: String,
    /// Where the joint is (rad or m).
    pub position: f64,
    /// Where it would meet the obstacle, if it has not set out.
    pub ahead: Option<f64>,
    /// What is in the way of what.
    pub hit: CollisionHit,
}
