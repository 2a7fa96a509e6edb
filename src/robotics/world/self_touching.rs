//! Which links of a robot touch by construction, and which never can, by the solids that stand for them
//! in the world.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose as ParryPose;
use parry3d_f64::query;

use super::link_geometry::{LinkSolids, TreeGeometry};
use super::solid::{Solid, from_parry_vector, to_parry};
use crate::robot::{
    JointId, JointPositions, KinematicTree, LinkId, PostureSample, TouchTest, TouchingPairs,
};
use spatial::Pose;

/// An overlap (m) that is none: pieces of meshes bulge a little.
const BULGE: f64 = 0.001;

/// The solids of a robot, prepared for questions of what of it touches what.
pub struct SelfTouching<'a> {
    tree: &'a KinematicTree,
    geometry: TreeGeometry,
    sample: PostureSample,
}

impl<'a> SelfTouching<'a> {
    /// Prepares the robot; `sample` says which postures are tried to find out what touches always.
    pub fn new(tree: &'a KinematicTree, sample: PostureSample) -> Self {
        Self {
            tree,
            geometry: TreeGeometry::new(tree, |_| false),
            sample,
        }
    }
}

impl TouchTest for SelfTouching<'_> {
    fn pairs(&self, stands: &dyn Fn(JointId) -> bool) -> TouchingPairs {
        let solid = &self.geometry.solid_links;
        let links: Vec<LinkId> = solid.iter().map(|solids| solids.link).collect();
        // The places are those of the list from which the links are.
        let touch = |[i, j]: [usize; 2], poses: &[Pose]| do_touch(&solid[i], &solid[j], poses);
        TouchingPairs::sampled(self.tree, self.sample, stands, &links, touch)
    }

    fn touching(&self, q: &JointPositions) -> Vec<(LinkId, LinkId)> {
        let solid = &self.geometry.solid_links;
        let mut poses = Vec::new();
        self.tree
            .forward_kinematics(&Pose::identity(), q, &mut poses);
        let mut touching = Vec::new();
        for (i, one) in solid.iter().enumerate() {
            let hit = solid
                .iter()
                .skip(i + 1)
                .filter(|other| do_touch(one, other, &poses));
            touching.extend(hit.map(|other| (one.link, other.link)));
        }
        touching
    }
}

/// Tries random postures; `stands` selects joints that could move but never do.
pub fn touching_pairs(
    tree: &KinematicTree,
    sample: PostureSample,
    stands: impl Fn(JointId) -> bool,
) -> TouchingPairs {
    SelfTouching::new(tree, sample).pairs(&stands)
}

/// All pairs of links that touch in a posture, the one that comes first in the file first.
pub fn touching_links(tree: &KinematicTree, q: &JointPositions) -> Vec<(LinkId, LinkId)> {
    SelfTouching::new(tree, PostureSample::default()).touching(q)
}

/// Whether two links touch, given the poses of all.
fn do_touch(one: &LinkSolids, other: &LinkSolids, poses: &[Pose]) -> bool {
    let pose = |link: LinkId| poses.get(link.index()).copied();
    let (Some(a), Some(b)) = (pose(one.link), pose(other.link)) else {
        return false;
    };
    let middle = |pose: &Pose, bounds: &Aabb| {
        pose.translation.vector + pose.rotation * from_parry_vector(bounds.center())
    };
    let radius = |bounds: &Aabb| bounds.half_extents().length();
    let way = middle(&a, &one.bounds) - middle(&b, &other.bounds);
    if way.norm() > radius(&one.bounds) + radius(&other.bounds) {
        return false;
    }
    let (a, b) = (to_parry(&a), to_parry(&b));
    one.solids.iter().any(|s| {
        let at = a * s.pose;
        other
            .solids
            .iter()
            .any(|o| overlap(&at, s, &(b * o.pose), o))
    })
}

/// Whether two solids overlap by more than meshes bulge.
fn overlap(pose1: &ParryPose, solid1: &Solid, pose2: &ParryPose, solid2: &Solid) -> bool {
    let (shape1, shape2) = (&*solid1.shape, &*solid2.shape);
    let meets = |pose2: &ParryPose| {
        let hit = query::intersection_test(pose1, shape1, pose2, shape2);
        hit.is_ok_and(|hit| hit.intersecting)
    };
    if !meets(pose2) {
        return false;
    }
    let contact = query::contact(pose1, shape1, pose2, shape2, 0.0);
    let Some(contact) = contact.ok().flatten() else {
        return true;
    };
    // Where one solid is deep in the other, the depth is wrong at times: what is shallow ends if the two
    // are moved apart a little.
    let apart = ParryPose::from_translation(contact.normal1 * (2.0 * BULGE));
    contact.dist < -BULGE || meets(&(apart * *pose2))
}
