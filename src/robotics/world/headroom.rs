//! How far something could be raised from where it stands.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::math::Vector;

use super::error::WorldError;
use super::part_key::PartKey;
use super::scene::World;
use super::solid::to_parry;
use super::spawn::way_along;
use spatial::Pose;

/// How far (m) below the top of a thing may begin what is above it; all else is beside it.
const OVERLAP: f64 = 0.002;

impl World {
    /// How far (m) an object could rise from a pose in the map frame until it meets something that
    /// stands there; infinite if nothing is above. The robot and what its hands hold do not count.
    pub(crate) fn headroom(
        &self,
        name: &str,
        at: &Pose,
        absent: &[String],
    ) -> Result<f64, WorldError> {
        let object = self.object(name)?;
        let place = to_parry(at);
        let mut bounds = Aabb::new_invalid();
        for solid in object.solids.iter() {
            bounds.merge(&solid.shape.compute_aabb(&(place * solid.pose)));
        }
        let held = self
            .objects()
            .filter(|o| o.attachment().is_some() || absent.iter().any(|name| name == o.name()));
        let held: Vec<PartKey> = held.map(|o| o.key()).collect();
        let mut above = self.neighbours(Some(object.key()), &bounds);
        above.retain(|other| {
            other.bounds.mins.z > bounds.maxs.z - OVERLAP
                && !matches!(other.key, PartKey::Robot(_))
                && !held.contains(&other.key)
        });
        let way = way_along(&object.solids, &place, Vector::Z, &above);
        Ok(way.map_or(f64::INFINITY, |(way, _)| way))
    }
}
