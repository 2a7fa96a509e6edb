//! Doors in two stages: they come out of their furniture a little before they turn.
//!
//! In a URDF, such a door hangs on two joints in series: one slides by a few centimetres, moves nothing solid
//! but the door, and has no handle of its own; the other one turns the door. The door can turn once it has come
//! out, and goes in once it has turned back.

use super::scene::World;
use crate::robot::{JointId, JointKind, JointPositions, KinematicTree};

/// What slides farther than this (m) is a drawer, and frees nothing.
const LONGEST: f64 = 0.05;
/// A door that has turned by no more than this (rad) has turned back.
const BACK: f64 = 1e-4;
/// What slides is at its end if it is no farther (m) from it.
pub(super) const AT_END: f64 = 1e-6;

/// The joint that has to slide before the joint of a door can turn, if there is one.
pub fn freeing_joint(kitchen: &KinematicTree, joint: JointId) -> Option<JointId> {
    let door = kitchen.joint(joint);
    if door.kind != JointKind::Revolute {
        return None;
    }
    let between = kitchen.link(door.parent);
    let freeing = between.parent_joint?;
    let slide = kitchen.joint(freeing);
    let travel = slide.limits.map(|limits| limits.upper - limits.lower);
    let is_short = travel.is_some_and(|travel| travel > 0.0 && travel <= LONGEST);
    let carries_more = || {
        let mut others = kitchen.joints();
        others.any(|(id, other)| id != joint && other.parent == door.parent)
    };
    let frees = slide.kind == JointKind::Prismatic
        && slide.mimic.is_none()
        && is_short
        && between.collisions.is_empty()
        && !carries_more();
    frees.then_some(freeing)
}

/// Lets a door whose joint has been put at a position be out if it has turned.
pub(super) fn come_out(kitchen: &KinematicTree, positions: &mut JointPositions, joint: JointId) {
    let Some(freeing) = freeing_joint(kitchen, joint) else {
        return;
    };
    if let (Some(slide), true) = (
        kitchen.joint(freeing).limits,
        has_turned(kitchen, positions, joint),
    ) {
        positions.set(freeing, slide.upper);
    }
}

/// Whether a door is not at the lower end of its joint.
pub(super) fn has_turned(
    kitchen: &KinematicTree,
    positions: &JointPositions,
    joint: JointId,
) -> bool {
    let limits = kitchen.joint(joint).limits;
    limits.is_some_and(|limits| positions.get(joint) > limits.lower + BACK)
}

impl World {
    /// The joints that move one after another while the part of a joint goes from one position to another
    /// (m or rad), each with where it begins and ends: several for a door that comes out before it turns.
    pub(crate) fn stages(&self, joint: JointId, [from, to]: [f64; 2]) -> Vec<(JointId, [f64; 2])> {
        let turns = (joint, [from, to]);
        let kitchen = &self.models().kitchen;
        let Some(freeing) = freeing_joint(kitchen, joint) else {
            return vec![turns];
        };
        let (Some(slide), Some(turn)) =
            (kitchen.joint(freeing).limits, kitchen.joint(joint).limits)
        else {
            return vec![turns];
        };
        let out = self.kitchen_positions().get(freeing);
        if to > turn.lower + BACK {
            let comes_out = (freeing, [out, slide.upper]);
            match slide.upper - out > AT_END {
                true => vec![comes_out, turns],
                false => vec![turns],
            }
        } else {
            match out - slide.lower > AT_END {
                true => vec![turns, (freeing, [out, slide.lower])],
                false => vec![turns],
            }
        }
    }
}
