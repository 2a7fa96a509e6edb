//! A held object that does not follow the hand.

use serde::Serialize;

use crate::world::BodyName;

/// A held object that does not follow the hand as it should.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StuckObject {
    /// Name of the object.
    pub object: String,
    /// How far (m) it lags behind the hand.
    pub(crate) lag: f64,
    /// Force (N) with which it is pressed against something other than the robot.
    pub force: f64,
    /// What it is pressed against most, if known.
    pub(crate) against: Option<BodyName>,
}
