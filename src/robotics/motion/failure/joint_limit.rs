//! Reporting a joint goal outside the joint's limits.

use crate::robot::{Joint, LimitViolation, Limits};

/// The violation of a joint's limits by the goal `wanted` (rad or m).
pub(crate) fn violation(joint: &Joint, limits: Limits, wanted: f64) -> LimitViolation {
    LimitViolation {
        joint: joint.name.clone(),
        position: wanted,
        limits,
        excess: limits.excess(wanted),
    }
}
