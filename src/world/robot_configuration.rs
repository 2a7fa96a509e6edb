//! The configuration of a robot: base pose and joint positions.

use crate::robot::JointPositions;
use crate::spatial::Pose;

/// Everything that decides where the robot's links are.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RobotConfiguration {
    /// Pose of the robot's root link in the map frame.
    pub(crate) base: Pose,
    /// Position of every joint (rad or m).
    pub(crate) joints: JointPositions,
}
