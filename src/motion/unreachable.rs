//! What is known about a hand pose that no posture of the arm reaches.

use std::fmt;

use crate::robot::{self, Side};
use crate::spatial::Pose;
use crate::world::CollisionHit;

/// A pose that the arm cannot bring its hand to, at any height of the torso.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnreachablePose {
    /// The arm.
    pub(crate) side: Side,
    /// Frame of the pose.
    pub(crate) frame: String,
    /// Pose of the wrist in that frame.
    pub(crate) wrist: Pose,
    /// Pose of the tool in the frame of the base.
    pub(crate) tool: Pose,
    /// Torso heights that were tried (m): least and greatest.
    pub(crate) torso: [f64; 2],
    /// Why.
    pub(crate) reason: UnreachableReason,
}

/// Why no posture was good enough.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum UnreachableReason {
    /// The arm is too short, or joints would have to leave their ranges.
    Arm {
        /// What is missing at the height of the torso where least is missing.
        nearest: robot::Unreachable,
        /// That height (m).
        torso: f64,
    },
    /// There are postures, but all touch something.
    Collisions {
        /// What one of them touches.
        hit: CollisionHit,
        /// How many postures were looked at.
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
                "all {configurations} postures that were tried touch something, one of them {} and {}",
                hit.moving, hit.other
            ),
        }
    }
}
