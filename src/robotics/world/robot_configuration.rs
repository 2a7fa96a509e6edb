//! The configuration of a robot: base pose and joint positions.

use crate::robot::JointPositions;
use spatial::Pose;

/// Everything that decides where the robot's links are.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotConfiguration {
    /// Pose of the robot's root link in the map frame.
    pub base: Pose,
    /// Position of every joint (rad or m).
    pub joints: JointPositions,
}
