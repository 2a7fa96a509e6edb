//! The check of the actual world: no link may penetrate anything.

use parry3d_f64::bounding_volume::BoundingVolume;

use super::allowed_pairs::AllowedPairs;
use super::collision::{CollisionChecker, CollisionHit};
use super::error::WorldError;
use super::part_key::PartKey;
use super::scene::World;
use super::separation::{lowest_point, separation};
use super::solid::to_parry;
use super::surroundings::{HeldObject, Surroundings};

impl World {
    /// The deepest overlap, deeper than `tolerance` (m), of the robot or of an object in its
    /// hand with anything, at their current poses. Allowed pairs, and a hand with the object that it
    /// holds, do not count.
    pub fn deepest_penetration(
        &self,
        allowed: &AllowedPairs,
        tolerance: f64,
    ) -> Option<CollisionHit> {
        let mut objects = Vec::new();
        let mut held = Vec::new();
        for object in self.objects() {
            let lying = self.object_at(object);
            match object.attachment() {
                // Where the object is, not where its weld pulls it.
                Some(hold) => held.push(HeldObject {
                    key: lying.key,
                    name: lying.name,
                    solids: lying.solids,
                    bounds: object.bounds,
                    link: hold.link,
                    at: self.link_pose(hold.link).inverse() * self.physics.pose(object.body),
                    hands: [Some(hold.link), object.second.map(|one| one.link)],
                    load: lying.key,
                }),
                None => objects.push(lying),
            }
        }
        let mut checker = CollisionChecker::new(Surroundings {
            models: &self.models,
            furniture: &self.state.furniture,
            objects,
            held,
        });
        let hits = checker.all_hits(&self.state.robot, allowed, -tolerance);
        hits.into_iter().next()
    }

    /// How deep (m) the object is in furniture, another object or the floor, and in what; 0 and the
    /// floor if in nothing.
    pub fn depth_of(&self, name: &str) -> Result<(f64, PartKey), WorldError> {
        let object = self.object(name)?;
        let at = to_parry(&self.physics.pose(object.body));
        let around = self.neighbours(Some(object.key()), &object.bounds.transform_by(&at));
        let mut deepest = (0.0, PartKey::Floor);
        for solid in object.solids.iter() {
            let pose = at * solid.pose;
            let bounds = solid.shape.compute_aabb(&pose);
            let below = -lowest_point(&pose, solid).z;
            if below > deepest.0 {
                deepest = (below, PartKey::Floor);
            }
            for other in &around {
                let is_near = bounds.intersects(&other.bounds);
                if is_near
                    && !matches!(other.key, PartKey::Robot(_))
                    && let Some(hit) = separation(&pose, solid, &other.pose, &other.solid, 0.0)
                    && -hit.distance > deepest.0
                {
                    deepest = (-hit.distance, other.key);
                }
            }
        }
        Ok(deepest)
    }
}
