//! The configuration of the robot with some of it elsewhere.

use crate::robot::JointId;
use crate::world::RobotConfiguration;
use spatial::pose;

/// The configuration with the base at another pose; its height stays.
pub(crate) fn at_place(robot: &RobotConfiguration, place: &[f64]) -> RobotConfiguration {
    let mut there = robot.clone();
    if let [x, y, yaw] = *place {
        there.base = pose::from_xy_yaw(x, y, yaw);
        there.base.translation.z = robot.base.translation.z;
    }
    there
}

/// The configuration with some joints at other positions.
pub(crate) fn with_joints(
    robot: &RobotConfiguration,
    joints: &[JointId],
    positions: &[f64],
) -> RobotConfiguration {
    let mut there = robot.clone();
    for (joint, position) in joints.iter().zip(positions) {
        there.joints.set(*joint, *position);
    }
    there
}
