//! The check of the actual world: no link may penetrate anything.

use super::allowed_pairs::AllowedPairs;
use super::collision::{CollisionChecker, CollisionHit};
use super::collision_search::{HeldObject, Surroundings};
use super::scene::World;

impl World {
    /// The deepest overlap, deeper than `tolerance` (m), of the robot or of an object in its
    /// hand with anything, at their current poses. Allowed pairs, and a hand with the object or the
    /// handle that it holds, do not count.
    pub(crate) fn deepest_penetration(
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
        let handles = self.hands_on_handles();
        let handles = handles.iter().cloned();
        let allowed = handles.fold(allowed.clone(), |all, (a, b)| all.and(a, b));
        let hits = checker.all_hits(&self.state.robot, &allowed, -tolerance);
        hits.into_iter().next()
    }
}
