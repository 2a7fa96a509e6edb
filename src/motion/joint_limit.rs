//! Saying that a joint was wanted outside of its limits.

use crate::robot::{Joint, LimitViolation, Limits};

/// The violation of a joint that was wanted at `wanted` (rad or m).
pub(super) fn violation(joint: &Joint, limits: Limits, wanted: f64) -> LimitViolation {
    LimitViolation {
        joint: joint.name.clone(),
        position: wanted,
        limits,
        excess: limits.excess(wanted),
    }
}
