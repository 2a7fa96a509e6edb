//! A posture in which an arm is out of the way.

use super::DerivedArm;
use crate::robot::arm_positions::ArmPositions;
use crate::robot::shape_extent::extent;
use crate::robot::{JointPositions, KinematicTree, LinkId, NumericKinematics};
use nalgebra::Vector3;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use spatial::Pose;
use std::f64::consts::PI;

/// Postures that are looked at, and how many of the best ones are tried.
const POSTURES: usize = 4000;
const TRIED: usize = 400;
/// Metres of reach for which a metre of height counts.
const HEIGHT: f64 = 0.4;

/// The posture that keeps the arm nearest to the body, and low, of those in which nothing touches, or else
/// the least; with what does. `others` are the positions of all other joints, the torso at its lowest; nothing of the arm is
/// below `floor` (m, in the frame of the root).
pub(super) fn find(
    tree: &KinematicTree,
    arm: &DerivedArm,
    others: &JointPositions,
    floor: f64,
    hits: impl Fn(&JointPositions) -> Vec<(LinkId, LinkId)>,
) -> Option<(ArmPositions, Vec<(LinkId, LinkId)>)> {
    let kinematics = NumericKinematics::new(tree, arm.base, arm.wrist).ok()?;
    let moved = moved(tree, arm);
    let free = free(tree, arm);
    let mut random = Pcg64::seed_from_u64(1);
    let mut share = || f64::from(random.next_u32()) / f64::from(u32::MAX);
    let mut postures: Vec<(f64, ArmPositions)> = Vec::new();
    let mut q = others.clone();
    let mut poses = Vec::new();
    for _ in 0..POSTURES {
        let positions = kinematics.limits().iter().map(|limits| match limits {
            Some(limits) => limits.lower + share() * (limits.upper - limits.lower),
            None => PI * (2.0 * share() - 1.0),
        });
        // Positions of two digits are easy to read.
        let rounded = positions.map(|position| (position * 100.0).round() / 100.0);
        let mut posture: ArmPositions = rounded.collect();
        for (position, limits) in posture.iter_mut().zip(kinematics.limits()) {
            *position = limits.map_or(*position, |limits| limits.clamp(*position));
        }
        set(arm, &mut q, &posture);
        tree.forward_kinematics(&Pose::identity(), &q, &mut poses);
        if lowest(tree, &free, &poses) < floor {
            continue;
        }
        postures.push((extended(tree, &moved, &poses), posture));
    }
    postures.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut best: Option<(ArmPositions, Vec<(LinkId, LinkId)>)> = None;
    for (_, posture) in postures.into_iter().take(TRIED) {
        set(arm, &mut q, &posture);
        let touching = hits(&q);
        let is_better = best
            .as_ref()
            .is_none_or(|(_, least)| touching.len() < least.len());
        if is_better {
            let is_free = touching.is_empty();
            best = Some((posture, touching));
            if is_free {
                break;
            }
        }
    }
    best
}

/// Whether nothing of the arm is below `floor` (m, in the frame of the root) in a posture.
pub(super) fn is_above(
    tree: &KinematicTree,
    arm: &DerivedArm,
    others: &JointPositions,
    posture: &ArmPositions,
    floor: f64,
) -> bool {
    let mut q = others.clone();
    set(arm, &mut q, posture);
    let mut poses = Vec::new();
    tree.forward_kinematics(&Pose::identity(), &q, &mut poses);
    lowest(tree, &free(tree, arm), &poses) >= floor
}

/// The links with shapes that the arm moves, without the one on which it is mounted: that turns where it is.
fn free(tree: &KinematicTree, arm: &DerivedArm) -> Vec<LinkId> {
    let foot = arm.joints.first().map(|joint| tree.joint(*joint).child);
    let mut links = moved(tree, arm);
    links.retain(|link| Some(*link) != foot);
    links
}

/// The links with shapes that the arm moves.
fn moved(tree: &KinematicTree, arm: &DerivedArm) -> Vec<LinkId> {
    let Some(first) = arm.joints.first().map(|joint| tree.joint(*joint).child) else {
        return Vec::new();
    };
    let solid = tree.links().filter(|(_, link)| !link.collisions.is_empty());
    let solid = solid.map(|(id, _)| id);
    solid.filter(|id| tree.carries(first, *id)).collect()
}

/// Takes up a posture.
pub(super) fn set(arm: &DerivedArm, q: &mut JointPositions, posture: &ArmPositions) {
    for (joint, position) in arm.joints.iter().zip(posture) {
        q.set(*joint, *position);
    }
}

/// How low (m) the links reach.
fn lowest(tree: &KinematicTree, links: &[LinkId], poses: &[Pose]) -> f64 {
    let mut least = f64::INFINITY;
    for link in links {
        let Some(pose) = poses.get(link.index()) else {
            continue;
        };
        for shape in &tree.link(*link).collisions {
            least = least.min(extent(shape, pose, &Vector3::z())[0]);
        }
    }
    least
}

/// How far the links are away from the middle of the robot, and a little of how high they are.
fn extended(tree: &KinematicTree, links: &[LinkId], poses: &[Pose]) -> f64 {
    let mut worst = 0.0_f64;
    for link in links {
        let Some(pose) = poses.get(link.index()) else {
            continue;
        };
        for shape in &tree.link(*link).collisions {
            let of = |direction| extent(shape, pose, &direction);
            let [x, y, z] = [of(Vector3::x()), of(Vector3::y()), of(Vector3::z())];
            let far = |ends: [f64; 2]| ends[0].abs().max(ends[1].abs());
            worst = worst.max(libm::hypot(far(x), far(y)) + HEIGHT * z[1]);
        }
    }
    worst
}
