//! What of a robot rolls, and how that lets it drive.

use super::{rest_axis, rest_poses};
use crate::robot::shape_extent::extent_of_all;
use crate::robot::{JointId, JointKind, KinematicTree, LinkId};
use nalgebra::Vector3;

/// How far (m) above the lowest point of a robot a wheel may end.
const ON_FLOOR: f64 = 0.03;
/// How far (m) two wheels may be off one axis.
const COAXIAL: f64 = 5e-3;

/// How the base moves over the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DerivedDrive {
    /// In every direction.
    Omnidirectional,
    /// Along its own x axis, and by turning.
    Differential,
    /// Not at all.
    Fixed,
}

/// The drive, and the links that roll.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedWheels {
    /// How the base moves.
    pub drive: DerivedDrive,
    /// Wheels, and what steers them.
    pub links: Vec<LinkId>,
    /// x coordinate (m) of the axis of a differential drive in the frame of the root.
    pub axle: f64,
}

/// Finds the wheels of a robot.
pub(super) fn find(tree: &KinematicTree, remarks: &mut Vec<String>) -> DerivedWheels {
    let poses = rest_poses(tree);
    let lowest = |link: LinkId| {
        let pose = poses.get(link.index()).copied().unwrap_or_default();
        extent_of_all(&tree.link(link).collisions, &pose, &Vector3::z())[0]
    };
    let floor = tree
        .links()
        .map(|(id, _)| lowest(id))
        .fold(f64::INFINITY, f64::min);
    let turns = |joint: JointId| tree.joint(joint).kind == JointKind::Continuous;
    let is_upright = |joint: JointId| rest_axis(tree, &poses, joint).z.abs() > 0.9;
    let is_wheel = |joint: JointId| {
        let child = tree.joint(joint).child;
        let is_level = rest_axis(tree, &poses, joint).z.abs() < 0.1;
        let is_last = tree.link(child).children.iter().all(|below| !turns(*below));
        turns(joint) && is_level && is_last && lowest(child) < floor + ON_FLOOR
    };
    let mut links = Vec::new();
    let mut driven: Vec<(Vector3<f64>, Vector3<f64>)> = Vec::new();
    let mut steered = 0;
    for (id, joint) in tree.joints().filter(|(id, _)| is_wheel(*id)) {
        links.push(joint.child);
        let steering = tree
            .ancestors(joint.parent)
            .find(|above| turns(*above) && is_upright(*above));
        match steering {
            Some(steering) => {
                steered += 1;
                let link = tree.joint(steering).child;
                // What steers a wheel rolls with it, unless it is the body itself.
                let is_small = tree.link(link).children.len() <= 2;
                if is_small && !links.contains(&link) {
                    links.push(link);
                }
            }
            None => {
                let at = poses.get(joint.child.index()).copied().unwrap_or_default();
                driven.push((at.translation.vector, rest_axis(tree, &poses, id)));
            }
        }
    }
    links.sort();
    let is_coaxial = match driven.as_slice() {
        [(a, axis), (b, other)] => {
            let way = b - a;
            way.cross(axis).norm() < COAXIAL
                && axis.cross(other).norm() < 1e-3
                && way.norm() > COAXIAL
        }
        _ => false,
    };
    let drive = match (is_coaxial, driven.len(), steered) {
        (true, ..) => DerivedDrive::Differential,
        (_, 0, 0) => DerivedDrive::Fixed,
        _ => DerivedDrive::Omnidirectional,
    };
    if drive == DerivedDrive::Omnidirectional && !driven.is_empty() {
        remarks.push(format!(
            "{} wheels are not steered and not on one axis: the drive is taken as omnidirectional.",
            driven.len()
        ));
    }
    let has_wheels = tree
        .links()
        .any(|(_, link)| link.name.to_lowercase().contains("wheel"));
    if drive == DerivedDrive::Fixed && has_wheels {
        remarks.push(
            "No wheel turns: the base is taken as fixed. If it drives, :drive is omnidirectional or \
             differential, and (wheels …) names the links that roll."
                .to_owned(),
        );
    }
    let axle = if is_coaxial {
        driven.first().map_or(0.0, |(at, _)| at.x)
    } else {
        0.0
    };
    if axle.abs() > 0.02 {
        remarks.push(format!(
            "The robot turns about its axle, which is {axle:.3} m ahead of its frame."
        ));
    }
    DerivedWheels { drive, links, axle }
}
