//! How fast the robot moves.
//!
//! Arm and head speeds stay below those of the PR2 URDF; the torso is faster than the
//! URDF's 13 mm/s, with which raising it would take 23 s.

use super::trajectory::AxisGroup;
use crate::robot::{JointId, JointKind, KinematicTree};

/// Greatest speed and acceleration of an axis, in rad or m and s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speed {
    /// Greatest speed (rad/s or m/s).
    pub velocity: f64,
    /// Greatest acceleration (rad/s² or m/s²).
    pub acceleration: f64,
}

/// The base over the floor (m).
pub const BASE_DRIVE: Speed = Speed { velocity: 0.5, acceleration: 1.0 };
/// The base about its axis (rad).
pub const BASE_TURN: Speed = Speed { velocity: 0.8, acceleration: 1.6 };
/// The torso lift (m).
pub const TORSO: Speed = Speed { velocity: 0.12, acceleration: 0.4 };
/// Any joint that turns (rad).
pub const TURNING: Speed = Speed { velocity: 1.5, acceleration: 4.0 };
/// The fingers (rad), when nothing is to be gripped.
pub const FINGERS: Speed = Speed { velocity: 0.5, acceleration: 4.0 };
/// The fingers while they close on an object (rad/s).
pub const GRIP_VELOCITY: f64 = 0.5;
/// A hand that puts an object down (m/s): half a millimetre per step.
pub const PUT_VELOCITY: f64 = 0.12;
/// A hand along a straight line (m).
pub const HAND: Speed = Speed { velocity: 0.4, acceleration: 1.5 };

/// The limits of the joints, in their order.
pub(super) fn limits_of(tree: &KinematicTree, joints: &[JointId]) -> Vec<AxisGroup> {
    let limit = |(axis, &id): (usize, &JointId)| {
        let joint = tree.joint(id);
        if joint.kind == JointKind::Prismatic {
            return AxisGroup::single(axis, TORSO.velocity, TORSO.acceleration);
        }
        let velocity = joint.max_velocity.map_or(TURNING.velocity, |v| v.min(TURNING.velocity));
        AxisGroup::single(axis, velocity, TURNING.acceleration)
    };
    joints.iter().enumerate().map(limit).collect()
}
