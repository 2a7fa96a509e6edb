//! The extent of the world: the map of the floor on which the robot drives, and how far from it
//! things can be at all.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Vector;
use serde::Serialize;

use super::error::WorldError;
use super::link_geometry::TreeGeometry;
use super::scene::World;
use super::solid::to_parry;
use crate::robot::KinematicTree;
use spatial::Pose;

/// Width (m) of the floor on the map around walls and furniture.
const BORDER: f64 = 1.0;

/// How far (m) from the map, and above or below the floor, an object may be put. So large is the
/// map of a world without furniture, too.
const WORLD_BORDER: f64 = 10.0;

/// The floor that the robot knows, in the map frame. Nothing is known of what is beyond.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MapArea {
    /// Smallest x and y (m).
    pub min: [f64; 2],
    /// Largest x and y (m).
    pub max: [f64; 2],
}

impl MapArea {
    /// The floor with the furniture, walls included, and what is close around it.
    pub(super) fn new(kitchen: &KinematicTree, geometry: &TreeGeometry) -> Self {
        let mut poses = Vec::new();
        kitchen.forward_kinematics(&Pose::identity(), &kitchen.zero_positions(), &mut poses);
        let placed = geometry.solid_links.iter().map(|link| {
            let pose = poses.get(link.link.index()).copied().unwrap_or_default();
            link.bounds.transform_by(&to_parry(&pose))
        });
        let all = placed.reduce(|all, one| all.merged(&one));
        let nothing = || Aabb::from_points([Vector::ZERO]).loosened(WORLD_BORDER);
        let bounds = all.map_or_else(nothing, |all| all.loosened(BORDER));
        Self {
            min: [bounds.mins.x, bounds.mins.y],
            max: [bounds.maxs.x, bounds.maxs.y],
        }
    }

    /// Whether the point (m) of the floor is on the map.
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        self.is_within([x, y], 0.0)
    }

    fn is_within(&self, point: [f64; 2], border: f64) -> bool {
        let mut sides = self.min.iter().zip(&self.max).zip(point);
        sides.all(|((min, max), p)| (min - border..=max + border).contains(&p))
    }
}

impl std::fmt::Display for MapArea {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { min, max } = self;
        write!(
            f,
            "x {:.2} to {:.2}, y {:.2} to {:.2}",
            min[0], max[0], min[1], max[1]
        )
    }
}

impl World {
    /// An error if the pose is not finite, or beyond the world.
    pub fn check_place(&self, name: &str, pose: &Pose) -> Result<(), WorldError> {
        let t = &pose.translation.vector;
        let q = pose.rotation.quaternion();
        let mut numbers = t.iter().chain(q.coords.iter()).copied();
        if let Some(value) = numbers.find(|v| !v.is_finite()) {
            return Err(WorldError::ImpossibleNumber {
                quantity: "a coordinate",
                name: name.to_owned(),
                value,
            });
        }
        let map = self.models.map;
        if map.is_within([t.x, t.y], WORLD_BORDER) && t.z.abs() <= WORLD_BORDER {
            return Ok(());
        }
        Err(WorldError::BeyondTheWorld {
            name: name.to_owned(),
            place: [t.x, t.y, t.z],
            map,
            border: WORLD_BORDER,
        })
    }
}
