//! Why an arm cannot bring its wrist to a pose.

use std::fmt;

use serde::Serialize;

use super::arm_chain::{ARM_JOINTS, ArmChain, LIFT};
use super::elbow_curve::ElbowCurve;
use super::{ArmPositions, Limits, Miss};

/// A joint that would have to exceed its limits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LimitViolation {
    /// Name of the joint.
    pub joint: String,
    /// The position it would need (rad).
    pub position: f64,
    /// Its limits (rad).
    pub limits: Limits,
    /// How far (rad) the position is outside the limits.
    pub(crate) excess: f64,
}

impl fmt::Display for LimitViolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Limits { lower, upper } = self.limits;
        write!(
            f,
            "{} would have to be at {:.3} rad, {:.3} rad outside of its limits {lower:.3}..{upper:.3}",
            self.joint, self.position, self.excess
        )
    }
}

/// Why a wrist pose is not reached: a proof, unless it was searched numerically; and what comes nearest.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Unreachable {
    /// The arm is too short, or cannot fold tightly enough.
    OutOfReach {
        /// Distance (m) of the wrist from the nearest point that the arm's lengths reach.
        missing: f64,
    },
    /// The arm is long enough, but joints would have to exceed their limits.
    Limits {
        /// The joint positions (rad) that exceed their limits least.
        positions: ArmPositions,
        /// The violations, worst first; never empty.
        violations: Vec<LimitViolation>,
    },
    /// What a numeric search says.
    Searched(Miss),
}

impl Unreachable {
    /// A measure of how bad it is: out of reach is worse than limits exceeded, and more
    /// metres or radians are worse than fewer.
    pub(crate) fn badness(&self) -> f64 {
        match self {
            Self::OutOfReach { missing } => 10.0 + missing,
            Self::Limits { violations, .. } => violations.first().map_or(0.0, |v| v.excess),
            Self::Searched(miss) => miss.badness(),
        }
    }

    /// Finds the point of the curve that violates the limits least.
    pub(super) fn explain(chain: &ArmChain, curve: &ElbowCurve<'_>) -> Self {
        const PLACES: i32 = 256;
        // Lift angles beyond the limits are considered too: they show that the lift joint is
        // the one that falls short.
        let lift = chain.limits(LIFT);
        let (from, to) = (lift.lower - 1.0, lift.upper + 1.0);
        let lift_at = |i: i32| from + (to - from) * f64::from(i) / f64::from(PLACES);
        let mut best: Option<(f64, ArmPositions)> = None;
        for i in 0..=PLACES {
            for bend in [1.0, -1.0] {
                if let Some(positions) = curve.positions(lift_at(i), bend) {
                    let worst = worst_excess(chain, &positions);
                    if best.is_none_or(|(least, _)| worst < least) {
                        best = Some((worst, positions));
                    }
                }
            }
        }
        if let Some((_, positions)) = best {
            let violations = violations(chain, &positions);
            if !violations.is_empty() {
                return Self::Limits {
                    positions,
                    violations,
                };
            }
        }
        let misses = (0..=PLACES).map(|i| curve.miss(lift_at(i)));
        Self::OutOfReach {
            missing: misses.fold(f64::INFINITY, f64::min),
        }
    }
}

impl fmt::Display for Unreachable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfReach { missing } => {
                write!(f, "the wrist is {missing:.3} m out of the arm's reach")
            }
            Self::Limits { violations, .. } => {
                for (i, violation) in violations.iter().enumerate() {
                    if i > 0 {
                        f.write_str(", and ")?;
                    }
                    write!(f, "{violation}")?;
                }
                Ok(())
            }
            Self::Searched(miss) => miss.fmt(f),
        }
    }
}

impl std::error::Error for Unreachable {}

fn worst_excess(chain: &ArmChain, positions: &ArmPositions) -> f64 {
    let excesses = positions.iter().enumerate();
    let excesses = excesses.map(|(i, p)| chain.limits(i).excess(*p));
    excesses.fold(0.0, f64::max)
}

fn violations(chain: &ArmChain, positions: &ArmPositions) -> Vec<LimitViolation> {
    let mut found: Vec<LimitViolation> = (0..ARM_JOINTS)
        .filter_map(|i| {
            let limits = chain.limits[i]?;
            let excess = limits.excess(positions[i]);
            (excess > 0.0).then(|| LimitViolation {
                joint: chain.names[i].clone(),
                position: positions[i],
                limits,
                excess,
            })
        })
        .collect();
    found.sort_by(|a, b| b.excess.total_cmp(&a.excess));
    found
}
