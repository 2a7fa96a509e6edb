//! Everything that a robot may collide with.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose as ParryPose;

use super::models::Models;
use super::obstacles::Obstacles;
use super::oriented_box::OrientedBox;
use super::part_key::PartKey;
use super::solid::Solid;
use crate::robot::LinkId;
use spatial::Pose;

/// A free object at its pose.
pub struct ObjectAt<'w> {
    pub key: PartKey,
    pub name: &'w str,
    pub(crate) solids: &'w [Solid],
    pub pose: ParryPose,
    pub bounds: Aabb,
}

/// An object that moves with a link.
pub struct HeldObject<'w> {
    pub key: PartKey,
    pub name: &'w str,
    pub(crate) solids: &'w [Solid],
    /// Bounds in the object's frame (m).
    pub bounds: Aabb,
    /// The link that carries the object.
    pub link: LinkId,
    /// Pose of the object in the link's frame.
    pub at: Pose,
    /// The palms of the hands that hold it, which it touches; none if it stands on what hands hold.
    pub hands: [Option<LinkId>; 2],
    /// What it moves with: objects of the same load are not checked against each other.
    pub load: PartKey,
}

/// Everything that a robot may collide with.
pub struct Surroundings<'w> {
    pub models: &'w Models,
    pub furniture: &'w Obstacles,
    pub objects: Vec<ObjectAt<'w>>,
    pub held: Vec<HeldObject<'w>>,
}

impl Surroundings<'_> {
    /// The solids of the mover with that index: links come first, then held objects.
    pub(super) fn solids(&self, mover: usize) -> &[Solid] {
        let links = &self.models.robot_geometry.solid_links;
        match links.get(mover) {
            Some(link) => &link.solids,
            None => self.held.get(mover - links.len()).map_or(&[], |h| h.solids),
        }
    }

    /// The box about the mover with that index, in its frame.
    pub(super) fn containing_box(&self, mover: usize) -> OrientedBox {
        let links = &self.models.robot_geometry.solid_links;
        let bounds = match links.get(mover) {
            Some(link) => link.bounds,
            None => {
                let held = self.held.get(mover - links.len());
                held.map_or_else(Aabb::new_invalid, |held| held.bounds)
            }
        };
        OrientedBox::new(&bounds)
    }
}
