//! Why one way to grasp an object does not work.

use std::fmt;

use serde::Serialize;

use crate::world::CollisionHit;

/// The parts of a grasp for which the hand has to be somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum GraspPart {
    /// Beside the object, touching nothing.
    Approach,
    /// Around the object.
    Grasp,
    /// Above, with the object.
    Lift,
}

/// Why a hand cannot grasp an object in some way.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum GraspObstacle {
    /// The hand holds something else.
    HandFull {
        /// Name of what it holds.
        held: String,
    },
    /// No posture of the arm brings the hand there.
    OutOfReach {
        /// What for.
        part: GraspPart,
    },
    /// The robot would touch something.
    Collision {
        /// What for.
        part: GraspPart,
        /// What would touch in one of the postures.
        hit: Box<CollisionHit>,
    },
    /// It has been tried in earnest, and has failed.
    HasFailed,
    /// The object's weight is too far from where it would be held.
    TooHeavy {
        /// The torque (Nm) that the weight exerts.
        torque: f64,
        /// The torque (Nm) that the pads of the fingers transmit.
        limit: f64,
    },
    /// Too many others were in collision for this one to be tried.
    NotTried,
    /// The open hand does not fit around the object.
    NoFit {
        /// What overlaps.
        hit: Box<CollisionHit>,
    },
    /// The object could not be put down at its target with this grasp.
    NotAtTarget {
        /// Why not.
        obstacle: Box<GraspObstacle>,
    },
    /// No path leads there.
    NoPath {
        /// What the search for one reports.
        report: String,
    },
}

impl fmt::Display for GraspPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Approach => "beside the object",
            Self::Grasp => "at the object",
            Self::Lift => "lifting it",
        })
    }
}

impl fmt::Display for GraspObstacle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HandFull { held } => write!(f, "the hand holds {held}"),
            Self::OutOfReach { part } => write!(f, "out of reach {part}"),
            Self::Collision { part, hit } => {
                write!(f, "{} would touch {} {part}", hit.moving, hit.other)
            }
            Self::HasFailed => f.write_str("has failed already"),
            Self::TooHeavy { torque, limit } => write!(
                f,
                "its weight takes {torque:.1} Nm there, and the pads of the fingers transmit {limit:.1} Nm"
            ),
            Self::NotTried => f.write_str("not tried after too many others"),
            Self::NoFit { hit } => write!(
                f,
                "the open hand does not fit around the object, {} would be {:.1} mm in it",
                hit.moving,
                hit.depth * 1e3
            ),
            Self::NotAtTarget { obstacle } => {
                write!(f, "not possible where it is to be put down: {obstacle}")
            }
            Self::NoPath { report } => write!(f, "no path: {report}"),
        }
    }
}
