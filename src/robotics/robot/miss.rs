//! Why a numeric search has found no posture, and what can be said for certain.

use std::fmt;

use serde::Serialize;

/// Why no posture is known that brings the tip of a chain to a goal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Miss {
    /// Proved: the goal is farther away than the chain is long.
    TooFar {
        /// How much farther (m).
        beyond: f64,
    },
    /// Not proved: none was found.
    NotFound {
        /// Number of starts.
        tries: usize,
        /// Distance (m) of the nearest tip from the goal.
        distance: f64,
        /// Angle (rad) between the nearest tip and the goal.
        angle: f64,
    },
    /// The goal has a number that is not finite.
    NotFinite,
}

impl Miss {
    /// A measure of how bad it is: what is too far is worse than what was not found.
    pub fn badness(&self) -> f64 {
        match self {
            Self::NotFinite => f64::INFINITY,
            Self::TooFar { beyond } => 10.0 + beyond,
            Self::NotFound {
                distance, angle, ..
            } => distance + angle,
        }
    }
}

impl fmt::Display for Miss {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooFar { beyond } => {
                write!(f, "too far: ")?;
                write_length(f, *beyond)?;
                write!(f, " beyond the arm's length")
            }
            Self::NotFound {
                tries,
                distance,
                angle,
            } => {
                write!(f, "no posture found in {tries} tries (nearest: ")?;
                write_length(f, *distance)?;
                let angle = angle.to_degrees();
                let digits = usize::from(angle < 0.95);
                write!(f, ", {angle:.digits$}°)")
            }
            Self::NotFinite => f.write_str("the goal has a number that is not finite"),
        }
    }
}

impl std::error::Error for Miss {}

/// A length (m) in the unit that suits it.
fn write_length(f: &mut fmt::Formatter<'_>, length: f64) -> fmt::Result {
    let millimetres = length * 1000.0;
    match millimetres {
        100.0.. => write!(f, "{length:.2} m"),
        0.95.. => write!(f, "{millimetres:.0} mm"),
        _ => write!(f, "{millimetres:.1} mm"),
    }
}
