//! A planned motion of joints.

use super::configuration::with_joints;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::JointId;
use crate::world::{AllowedPairs, RobotConfiguration};

/// A trajectory for joints, and what the robot may touch on it. Axes of the trajectory beyond the
/// joints only limit its speed.
#[derive(Clone, Debug)]
pub struct JointPlan {
    pub(crate) joints: Vec<JointId>,
    pub(crate) trajectory: Trajectory,
    pub(crate) allowed: AllowedPairs,
}

impl JointPlan {
    pub(crate) fn new(joints: Vec<JointId>, trajectory: Trajectory, allowed: AllowedPairs) -> Self {
        Self {
            joints,
            trajectory,
            allowed,
        }
    }

    /// The robot at the end of the trajectory.
    pub(crate) fn end(&self, robot: &RobotConfiguration) -> RobotConfiguration {
        with_joints(robot, &self.joints, self.trajectory.last())
    }
}
