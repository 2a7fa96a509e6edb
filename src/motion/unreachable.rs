//! What is known about a hand pose that no posture of the arm reaches.

use std::fmt;

use crate::robot::{self, Side};
use crate::spatial::Pose;
use crate::world::CollisionHit;

/// A pose that the arm cannot bring its hand to, at any height of the torso.
#[derive(Clone, Debug, PartialEq)]
pub struct UnreachablePose {
    /// The arm.
    pub side: Side,
    /// Frame of the pose.
    pub frame: String,
    /// Pose of the wrist in that frame.
    pub wrist: Pose,
    /// Torso heights that were tried (m): least and greatest.
    pub torso: [f64; 2],
    /// Why.
    pub reason: UnreachableReason,
}

/// Why no posture was good enough.
#[derive(Clone, Debug, PartialEq)]
pub enum UnreachableReason {
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
        postures: usize,
    },
}

impl fmt::Display for UnreachablePose {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            side,
            frame,
            wrist,
            torso: [low, high],
            reason,
        } = self;
        let t = wrist.translation;
        let q = wrist.rotation.quaternion();
        let [x, y, z] = [t.x, t.y, t.z].map(double);
        let [i, j, k, w] = [q.i, q.j, q.k, q.w].map(double);
        write!(
            f,
            "#<\"{frame}\" (({x} {y} {z}) ({i} {j} {k} {w}))> is unreachable for EE."
        )?;
        write!(f, "\nthe {side} arm, torso from {low:.2} to {high:.2} m: ")?;
        match reason {
            UnreachableReason::Arm { nearest, torso } => {
                write!(f, "{nearest} (with the torso at {torso:.2} m)")
            }
            UnreachableReason::Collisions { hit, postures } => write!(
                f,
                "all {postures} postures that were tried touch something, one of them {} and {}",
                hit.moving, hit.other
            ),
        }
    }
}

/// A double float as Common Lisp prints it when single floats are the default.
fn double(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (1e-3..1e7).contains(&size) {
        return format!("{value:?}d0");
    }
    let text = format!("{value:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let point = if digits.contains('.') { "" } else { ".0" };
    format!("{digits}{point}d{exponent}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_are_printed_as_in_common_lisp() {
        assert_eq!(
            [0.0, -0.25, 1.0, 1e-17, 2.5e9].map(double).join(" "),
            "0.0d0 -0.25d0 1.0d0 1.0d-17 2.5d9"
        );
    }
}
