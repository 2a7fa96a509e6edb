//! The furniture placed in the map frame, for collision queries.

use std::ops::Range;
use std::sync::Arc;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Pose as ParryPose;

use super::link_geometry::TreeGeometry;
use super::part_key::{PartKey, index};
use super::placed_solid::PlacedSolid;
use super::solid::{Solid, to_parry};
use spatial::Pose;

/// A solid of the furniture, placed in the map frame.
pub struct Obstacle {
    pub key: PartKey,
    pub solid: Solid,
    pub placed: PlacedSolid,
}

/// All furniture, link by link. Where a link stays at its place, its solids are shared.
pub struct Obstacles {
    all: Vec<Arc<Obstacle>>,
    links: Vec<LinkObstacles>,
}

/// The solids of a link.
struct LinkObstacles {
    /// Pose of the link in the map frame.
    pose: ParryPose,
    /// Bounds (m) of all of them.
    bounds: Aabb,
    /// Their places in the list of all.
    places: Range<usize>,
}

impl Obstacles {
    /// The furniture with its links at the poses.
    pub fn new(geometry: &TreeGeometry, poses: &[Pose]) -> Self {
        let nothing = Self {
            all: Vec::new(),
            links: Vec::new(),
        };
        nothing.with_links_at(geometry, poses)
    }

    /// The same furniture with its links at other poses.
    pub(crate) fn with_links_at(&self, geometry: &TreeGeometry, poses: &[Pose]) -> Self {
        let mut all = Vec::with_capacity(self.all.len());
        let mut links = Vec::with_capacity(geometry.solid_links.len());
        for (number, link) in geometry.solid_links.iter().enumerate() {
            let pose = to_parry(&poses.get(link.link.index()).copied().unwrap_or_default());
            let before = self.links.get(number);
            let unmoved = before.filter(|before| has_same_bits(&before.pose, &pose));
            let first = all.len();
            let mut bounds = Aabb::new_invalid();
            match unmoved {
                Some(unmoved) => {
                    bounds = unmoved.bounds;
                    all.extend_from_slice(&self.all[unmoved.places.clone()]);
                }
                None => all.extend(link.solids.iter().map(|solid| {
                    let placed = PlacedSolid::new(solid, &pose);
                    bounds.merge(&placed.bounds);
                    Arc::new(Obstacle {
                        key: PartKey::Furniture(index(link.link)),
                        solid: solid.clone(),
                        placed,
                    })
                })),
            }
            links.push(LinkObstacles {
                pose,
                bounds,
                places: first..all.len(),
            });
        }
        Self { all, links }
    }

    /// Every solid.
    pub fn all(&self) -> &[Arc<Obstacle>] {
        &self.all
    }

    /// The places in the list of all of the solids whose bounds intersect the given ones (m).
    pub(crate) fn places_near<'a>(&'a self, bounds: &'a Aabb) -> impl Iterator<Item = usize> + 'a {
        self.links
            .iter()
            .filter(|link| link.bounds.intersects(bounds))
            .flat_map(|link| link.places.clone())
            // The ranges index this list.
            .filter(|place| self.all[*place].placed.bounds.intersects(bounds))
    }
}

fn has_same_bits(one: &ParryPose, other: &ParryPose) -> bool {
    let bits = |pose: &ParryPose| {
        let [x, y, z] = pose.translation.to_array();
        let [i, j, k, w] = pose.rotation.to_array();
        [x, y, z, i, j, k, w].map(f64::to_bits)
    };
    bits(one) == bits(other)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::Models;

    #[test]
    fn only_what_moves_is_placed_anew() {
        let models = Models::pr2_in_kitchen().unwrap();
        let (kitchen, geometry) = (&models.kitchen, &models.kitchen_geometry);
        let placed = |position: f64| {
            let mut positions = kitchen.zero_positions();
            let drawer = kitchen.joint_named("sink_area_left_upper_drawer_main_joint");
            positions.set(drawer.unwrap(), position);
            let mut poses = Vec::new();
            kitchen.forward_kinematics(&Pose::identity(), &positions, &mut poses);
            poses
        };
        let shut = Obstacles::new(geometry, &placed(0.0));
        let open = shut.with_links_at(geometry, &placed(0.3));
        let anew = Obstacles::new(geometry, &placed(0.3));
        assert_eq!(open.all.len(), anew.all.len());
        for (one, other) in open.all.iter().zip(&anew.all) {
            assert_eq!(one.key, other.key);
            assert!(has_same_bits(&one.placed.pose, &other.placed.pose));
            assert_eq!(one.placed.bounds, other.placed.bounds);
        }
        for (one, other) in open.links.iter().zip(&anew.links) {
            assert_eq!(one.bounds, other.bounds);
            assert_eq!(one.places, other.places);
        }
        let pairs = open.all.iter().zip(&shut.all);
        let moved = pairs.filter(|(one, other)| !Arc::ptr_eq(one, other));
        assert!((1..20).contains(&moved.count()));
    }
}
