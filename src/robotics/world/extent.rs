//! How far furniture and objects extend: boxes in a frame that only turns about the vertical.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::error::WorldError;
use super::scene::World;
use super::solid::to_parry;
use crate::robot::{JointKind, LinkId};
use spatial::{Pose, pose};

/// A box around a body, upright in the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The frame of the box in the map: the body's origin, and its heading.
    pub frame: Pose,
    /// Smallest coordinates (m) in that frame.
    pub min: [f64; 3],
    /// Largest coordinates (m) in that frame.
    pub max: [f64; 3],
}

impl Extent {
    /// The box around bounds (m) in the frame of a body at the pose.
    fn new(body: &Pose, bounds: &Aabb) -> Self {
        let t = body.translation;
        let mut frame = pose::from_xy_yaw(t.x, t.y, pose::yaw(body));
        frame.translation.z = t.z;
        let bounds = bounds.transform_by(&to_parry(&(frame.inverse() * body)));
        Self {
            frame,
            min: bounds.mins.to_array(),
            max: bounds.maxs.to_array(),
        }
    }

    /// Edge lengths (m).
    pub fn size(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.max[i] - self.min[i])
    }

    /// Height (m) of the upper face in the map frame.
    pub fn top(&self) -> f64 {
        self.frame.translation.z + self.max[2]
    }

    /// Height (m) of the lower face in the map frame.
    pub(crate) fn bottom(&self) -> f64 {
        self.frame.translation.z + self.min[2]
    }

    /// The point (m) of the map in the frame of the box.
    pub fn local(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let z = self.frame.translation.z;
        let p = self
            .frame
            .inverse_transform_point(&nalgebra::Point3::new(x, y, z));
        [p.x, p.y]
    }
}

impl World {
    /// The box around a link of the kitchen, without what is mounted on it; `None` if it has no
    /// shape.
    pub fn furniture_extent(&self, link: LinkId) -> Option<Extent> {
        let geometry = &self.models.kitchen_geometry;
        let solid = geometry.solid_links.iter().find(|l| l.link == link)?;
        Some(Extent::new(&self.furniture_pose(link), &solid.bounds))
    }

    /// The links that a piece of furniture is made of: its own, or, if that has no shape, those that are fixed to
    /// it, as the boards of a drawer that is a mere frame.
    pub fn assembly(&self, link: LinkId) -> Vec<LinkId> {
        let (kitchen, geometry) = (&self.models.kitchen, &self.models.kitchen_geometry);
        let solid = geometry.solid_links.iter().map(|solid| solid.link);
        let is_fixed = |part: &LinkId| {
            let mut joints = kitchen.ancestors(*part);
            let mut child = *part;
            while child != link {
                match joints.next().map(|joint| kitchen.joint(joint)) {
                    Some(joint) if joint.kind == JointKind::Fixed => child = joint.parent,
                    _ => return false,
                }
            }
            true
        };
        let parts: Vec<LinkId> = solid.filter(is_fixed).collect();
        match parts.contains(&link) {
            true => vec![link],
            false => parts,
        }
    }

    /// The box around all that a piece of furniture is made of; `None` if that has no shape.
    pub fn assembly_extent(&self, link: LinkId) -> Option<Extent> {
        let geometry = &self.models.kitchen_geometry;
        let parts = self.assembly(link);
        let at = self.furniture_pose(link);
        let solid = geometry.solid_links.iter();
        let solid = solid.filter(|solid| parts.contains(&solid.link));
        let bounds = solid.map(|solid| {
            let part = at.inverse() * self.furniture_pose(solid.link);
            match solid.link == link {
                true => solid.bounds,
                false => solid.bounds.transform_by(&to_parry(&part)),
            }
        });
        let bounds = bounds.reduce(|all, one| all.merged(&one))?;
        Some(Extent::new(&at, &bounds))
    }

    /// The box around an object.
    pub fn object_extent(&self, name: &str) -> Result<Extent, WorldError> {
        let bounds = self.object(name)?.bounds;
        Ok(Extent::new(&self.object_pose(name)?, &bounds))
    }
}
