//! What is known about a hand pose that no configuration of the arm reaches.

use std::fmt;

use serde::Serialize;

use crate::robot::{self, Side};
use crate::world::CollisionHit;
use spatial::Pose;

/// A pose to which the arm cannot bring its hand at any height of the torso.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct UnreachablePose {
    /// The arm.
    pub side: Side,
    /// Frame of the pose.
    pub frame: String,
    /// Pose of the wrist in that frame.
    pub wrist: Pose,
    /// Pose of the tool in the frame of the base.
    pub tool: Pose,
    /// Range of torso heights (m) that were tried: lowest and highest.
    pub torso: [f64; 2],
    /// The reason.
    pub reason: UnreachableReason,
}

/// Why no configuration will do.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum UnreachableReason {
    /// The arm is too short, or joints would have to exceed their ranges.
    Arm {
        /// What is missing at the torso height where the least is missing.
        nearest: robot::Unreachable,
        /// That height (m).
        torso: f64,
    },
    /// There are configurations, but all are in collision.
    Collisions {
        /// What one of them touches.
        hit: CollisionHit,
        /// Number of configurations checked.
        configurations: usize,
    },
}

impl fmt::Display for UnreachablePose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            side,
            frame,
            wrist,
            tool: _,
            torso: [low, high],
            reason,
        } = self;
        let t = wrist.translation;
        let q = wrist.rotation.quaternion();
        write!(
            f,
            "#<\"{frame}\" (({:.5} {:.5} {:.5}) ({:.5} {:.5} {:.5} {:.5}))> is unreachable for EE.",
            t.x, t.y, t.z, q.i, q.j, q.k, q.w
        )?;
        write!(f, "\nthe {side} arm, torso from {low:.2} to {high:.2} m: ")?;
        match reason {
            UnreachableReason::Arm { nearest, torso } => {
                write!(f, "{nearest} (with the torso at {torso:.2} m)")
            }
            UnreachableReason::Collisions {
                hit,
                configurations,
            } => write!(
                f,
                "all {configurations} postures that were tried are in collision, one of them {} with {}",
                hit.moving, hit.other
            ),
        }
    }
}
