//! What an SRDF says of the links and the arms of a robot.

use std::collections::BTreeSet;

use super::DerivedArm;
use super::text::symbol;
use crate::robot::arm_positions::ArmPositions;
use crate::robot::{JointId, JointKind, KinematicTree, LinkId, Srdf, TouchingPairs};

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
/// Joints between two links that random postures of a robot try in all positions against each other.
const MOST_BETWEEN: usize = 2;
/// Names that a remark tells.
const MOST_NAMES: usize = 4;

/// The pairs of links that, as the SRDF says, touch as the robot is built, and that do so in some posture: the others are
/// checked at no cost, and pairs that are exempt for another reason, or for none, may hide collisions of the real robot. Of
/// those that never touch, as it says, the near ones are among them, too: what two joints can do is known from random
/// postures, so that only the pieces that stand for meshes here can bulge into each other. The one that comes first in the
/// URDF is the first.
pub(super) fn pairs(
    tree: &KinematicTree,
    srdf: &Srdf,
    sampled: &TouchingPairs,
    remarks: &mut Vec<String>,
) -> BTreeSet<(LinkId, LinkId)> {
    let named = srdf.pairs.iter().flat_map(|(one, other)| [one, other]);
    let unknown: BTreeSet<&str> = named
        .map(String::as_str)
        .filter(|name| tree.link_named(name).is_none())
        .collect();
    if !unknown.is_empty() {
        remarks.push(format!(
            "The SRDF names links that the URDF lacks, which is no fault if they are parts that this robot is \
             without: {}.",
            some(unknown.into_iter())
        ));
    }
    if !srdf.links.is_empty() {
        remarks.push(format!(
            "The SRDF leaves some links unchecked altogether; they are checked here: {}.",
            some(srdf.links.iter().map(String::as_str))
        ));
    }
    let is_solid = |link: &LinkId| !tree.link(*link).collisions.is_empty();
    let solid = |name: &String| tree.link_named(name).filter(is_solid);
    let never: BTreeSet<_> = sampled.never.iter().copied().collect();
    let links = |pairs: &[(String, String)]| -> BTreeSet<(LinkId, LinkId)> {
        (pairs.iter())
            .filter_map(|(one, other)| Some((solid(one)?, solid(other)?)))
            .map(|(one, other)| (one.min(other), one.max(other)))
            .collect()
    };
    let touching = |pairs: &[(String, String)]| -> BTreeSet<(LinkId, LinkId)> {
        let all = links(pairs).into_iter();
        all.filter(|pair| !never.contains(pair)).collect()
    };
    let mut exempt = touching(&srdf.built);
    let is_near = |pair: &(LinkId, LinkId)| joints_between(tree, pair.0, pair.1) <= MOST_BETWEEN;
    exempt.extend(links(&srdf.never).into_iter().filter(is_near));
    let built: BTreeSet<_> = sampled.by_construction().collect();
    let sometimes: Vec<String> = (touching(&srdf.pairs).iter())
        .filter(|pair| !exempt.contains(pair) && !built.contains(pair))
        .map(|(one, other)| format!("{} and {}", tree.link(*one).name, tree.link(*other).name))
        .collect();
    if !sometimes.is_empty() {
        remarks.push(format!(
            "The SRDF leaves some pairs of links unchecked that touch in some postures; they are checked here: {}. If \
             they overlap by construction, add (touching ...) records.",
            some(sometimes.iter().map(String::as_str))
        ));
    }
    exempt
}

/// How many joints move two links against each other.
fn joints_between(tree: &KinematicTree, one: LinkId, other: LinkId) -> usize {
    let path = |link| -> BTreeSet<JointId> { tree.ancestors(link).collect() };
    let (a, b) = (path(one), path(other));
    let moving = a.symmetric_difference(&b);
    moving
        .filter(|joint| tree.joint(**joint).kind != JointKind::Fixed)
        .count()
}

/// The first of some names, and how many more there are.
fn some<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let more = names.len().saturating_sub(MOST_NAMES);
    let first: Vec<&str> = names.take(MOST_NAMES).collect();
    match more {
        0 => first.join(", "),
        more => format!("{}, and {more} more", first.join(", ")),
    }
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
