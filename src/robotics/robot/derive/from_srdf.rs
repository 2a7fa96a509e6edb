//! What an SRDF says of the links and the arms of a robot.

use std::collections::BTreeSet;

use super::DerivedArm;
use super::text::symbol;
use crate::robot::arm_positions::ArmPositions;
use crate::robot::{JointId, KinematicTree, LinkId, Srdf};

/// How a word begins in the names of postures in which an arm is out of the way, the best one first.
const OUT_OF_THE_WAY: [&str; 8] = [
    "park",
    "tuck",
    "stow",
    "fold",
    "transport",
    "rest",
    "home",
    "ready",
];
/// Names of links that a remark tells.
const MOST_NAMES: usize = 4;

/// The pairs of links that the SRDF lets touch, the one that comes first in the URDF first.
pub(super) fn pairs(
    tree: &KinematicTree,
    srdf: &Srdf,
    remarks: &mut Vec<String>,
) -> BTreeSet<(LinkId, LinkId)> {
    let named = srdf.pairs.iter().flat_map(|(one, other)| [one, other]);
    let named = named.chain(&srdf.links);
    let unknown: BTreeSet<&str> = named
        .map(String::as_str)
        .filter(|name| tree.link_named(name).is_none())
        .collect();
    if !unknown.is_empty() {
        let names: Vec<&str> = unknown.iter().copied().take(MOST_NAMES).collect();
        let dots = if unknown.len() > MOST_NAMES {
            ", …"
        } else {
            ""
        };
        remarks.push(format!(
            "The SRDF names links that the URDF lacks, which is no fault if they are parts that this robot is \
             without: {}{dots}.",
            names.join(", ")
        ));
    }
    let is_solid = |link: &LinkId| !tree.link(*link).collisions.is_empty();
    let solid = |name: &String| tree.link_named(name).filter(is_solid);
    let ordered = |one: LinkId, other: LinkId| (one.min(other), one.max(other));
    let pairs = srdf.pairs.iter();
    let mut found: BTreeSet<(LinkId, LinkId)> = pairs
        .filter_map(|(one, other)| Some(ordered(solid(one)?, solid(other)?)))
        .collect();
    for link in srdf.links.iter().filter_map(solid) {
        let all = tree.links().map(|(other, _)| other).filter(is_solid);
        found.extend(
            all.filter(|other| *other != link)
                .map(|other| ordered(link, other)),
        );
    }
    found
}

/// The postures of an arm, each name once: those that say where all of its joints are, within their limits.
pub(super) fn postures(
    tree: &KinematicTree,
    arm: &DerivedArm,
    srdf: &Srdf,
) -> Vec<(String, ArmPositions)> {
    let mut found: Vec<(String, ArmPositions)> = Vec::new();
    for state in &srdf.states {
        let position = |joint: &JointId| {
            let joint = tree.joint(*joint);
            let mut positions = state.positions.iter();
            let (_, position) = positions.find(|(name, _)| *name == joint.name)?;
            // Files write limits with fewer digits than URDFs do.
            Some(
                joint
                    .limits
                    .map_or(*position, |limits| limits.clamp(*position)),
            )
        };
        let posture: Option<ArmPositions> = arm.joints.iter().map(position).collect();
        let name = symbol(&state.name).to_lowercase();
        if let Some(posture) = posture
            && found.iter().all(|(known, _)| *known != name)
        {
            found.push((name, posture));
        }
    }
    found
}

/// The postures whose names say that the arm is out of the way, the best one first.
pub(super) fn parks(arm: &DerivedArm) -> impl Iterator<Item = ArmPositions> {
    OUT_OF_THE_WAY.iter().flat_map(|word| {
        let begins = move |name: &str| name.split(['-', '_', '.']).any(|w| w.starts_with(word));
        let named = arm.postures.iter().filter(move |(name, _)| begins(name));
        named.map(|(_, posture)| *posture)
    })
}
