//! The furniture placed in the map frame, for collision queries.

use std::ops::Range;

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

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

/// All furniture, link by link.
pub struct Obstacles {
    all: Vec<Obstacle>,
    links: Vec<(Aabb, Range<usize>)>,
}

impl Obstacles {
    /// The furniture with its links at the poses.
    pub fn new(geometry: &TreeGeometry, poses: &[Pose]) -> Self {
        let mut all = Vec::new();
        let mut links = Vec::new();
        for link in &geometry.solid_links {
            let link_pose = to_parry(&poses.get(link.link.index()).copied().unwrap_or_default());
            let first = all.len();
            let mut bounds = Aabb::new_invalid();
            for solid in &link.solids {
                let obstacle = Obstacle {
                    key: PartKey::Furniture(index(link.link)),
                    solid: solid.clone(),
                    placed: PlacedSolid::new(solid, &link_pose),
                };
                bounds.merge(&obstacle.placed.bounds);
                all.push(obstacle);
            }
            links.push((bounds, first..all.len()));
        }
        Self { all, links }
    }

    /// Every solid.
    pub fn all(&self) -> &[Obstacle] {
        &self.all
    }

    /// The places in the list of all of the solids whose bounds intersect the given ones (m).
    pub(crate) fn places_near<'a>(&'a self, bounds: &'a Aabb) -> impl Iterator<Item = usize> + 'a {
        self.links
            .iter()
            .filter(|(link, _)| link.intersects(bounds))
            .flat_map(|(_, range)| range.clone())
            // The ranges index this list.
            .filter(|place| self.all[*place].placed.bounds.intersects(bounds))
    }
}
