//! Speeds that the robot's description does not give.

use super::axis_group::AxisGroup;
use crate::robot::description::Speed;
use crate::robot::{JointId, RobotDescription};

/// A finger while it closes on an object (rad/s).
pub(crate) const GRIP_VELOCITY: f64 = 0.5;
/// A hand that puts an object down (m): half a millimetre per step.
pub(crate) const PUT: Speed = Speed {
    velocity: 0.12,
    acceleration: 0.6,
};
/// A hand that is to touch something (m/s): a third of a millimetre per step.
pub(crate) const TOUCH_VELOCITY: f64 = 0.08;
/// A hand along a straight line (m).
pub(crate) const HAND: Speed = Speed {
    velocity: 0.25,
    acceleration: 1.0,
};

/// The limits of the joints, in order.
pub(crate) fn limits_of(body: &RobotDescription, joints: &[JointId]) -> Vec<AxisGroup> {
    let limit = |(axis, &joint): (usize, &JointId)| {
        let Speed {
            velocity,
            acceleration,
        } = body.speed(joint);
        AxisGroup::single(axis, velocity, acceleration)
    };
    joints.iter().enumerate().map(limit).collect()
}
