//! Letting an object come to rest among others at the cost of those that it moves.
//!
//! The engine wakes all that touch each other, directly or through others, and a crowded table
//! is one such heap. So what happens is found out in a copy of the world in which all other
//! objects stand fast, except those that something that moves comes near. Where things have come
//! to rest there, they are put in the world itself.

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};

use super::object::Object;
use super::part_key::PartKey;
use super::physics::{BodyKind, STEP_SECONDS, Surface};
use super::scene::World;
use super::solid::to_parry;
use spatial::Pose;
use spatial::pose::{angle_between, distance_between};

/// How near (m) to something that moves an object does not stand fast.
const NEAR: f64 = 0.01;
/// How far (m, rad) something has to be moved to count as moving, however slow it is.
const MOVED: f64 = 0.0002;
const TURNED: f64 = 0.002;

/// The copy of the world.
pub(super) struct Trial {
    world: World,
    /// The object that is to come to rest.
    key: PartKey,
    /// The objects that stand fast, and their bounds (m).
    fast: Vec<(PartKey, Aabb)>,
    /// The objects that may move, and where they were at first.
    free: Vec<(PartKey, Pose)>,
}

impl World {
    /// Whether another object is near the one with that key.
    pub(super) fn has_neighbours(&self, key: PartKey) -> bool {
        let Some(object) = self.object_of(key) else {
            return false;
        };
        let bounds = self.bounds_of(object).loosened(NEAR);
        let mut others = self.objects().filter(|other| other.key() != key);
        others.any(|other| self.bounds_of(other).intersects(&bounds))
    }

    /// The bounds (m) of the object in the map frame.
    pub(super) fn bounds_of(&self, object: &Object) -> Aabb {
        let pose = self.physics.pose(object.body);
        object.bounds.transform_by(&to_parry(&pose))
    }

    fn object_of(&self, key: PartKey) -> Option<&Object> {
        self.objects().find(|object| object.key() == key)
    }

    /// Replaces the body of an object by one of that kind.
    fn embody(&mut self, key: PartKey, kind: impl Fn(&Object) -> BodyKind) {
        let mut objects = self.state.objects.values_mut();
        let Some(object) = objects.find(|object| object.key() == key) else {
            return;
        };
        let pose = self.physics.pose(object.body);
        let solids = object.solids.iter();
        let parts: Vec<_> = solids
            .map(|solid| (solid.clone(), key.code(), Surface::Plain))
            .collect();
        self.physics.remove_body(object.body);
        object.body = self.physics.add_body(kind(object), &pose, &parts);
    }

    /// Puts what has moved in the trial where it is there.
    pub(super) fn adopt(&mut self, trial: &Trial) {
        for (key, start) in &trial.free {
            let there = trial.world.object_of(*key);
            let (Some(here), Some(there)) = (self.object_of(*key), there) else {
                continue;
            };
            let pose = trial.world.physics.pose(there.body);
            if pose != *start {
                let body = here.body;
                self.physics.place(body, &pose);
            }
        }
    }
}

impl Trial {
    /// A trial in which the object with that key is let go where it is.
    pub(super) fn new(world: &World, key: PartKey) -> Self {
        let mut trial = Self {
            world: world.clone(),
            key,
            fast: Vec::new(),
            free: Vec::new(),
        };
        for object in world.objects() {
            let other = object.key();
            if other == key || object.attachment().is_some() {
                let pose = world.physics.pose(object.body);
                trial.free.push((other, pose));
            } else {
                let friction = object.friction;
                let stands_fast = |_: &Object| BodyKind::Fixed { friction };
                trial.world.embody(other, stands_fast);
                trial.fast.push((other, world.bounds_of(object)));
            }
        }
        trial
    }

    /// Where the object is (in the map frame).
    pub(super) fn pose(&self) -> Pose {
        let object = self.world.object_of(self.key);
        object.map_or_else(Pose::identity, |object| {
            self.world.physics.pose(object.body)
        })
    }

    /// Lets a step pass.
    pub(super) fn step(&mut self) {
        self.free_what_is_near();
        self.world.step();
    }

    /// Where the objects are that may move (in the map frame), but for those with the given keys.
    pub(super) fn poses(&self, restless: &[PartKey]) -> Vec<Pose> {
        let free = self.free.iter().map(|(key, _)| *key);
        let free = free.filter(|key| !restless.contains(key));
        let objects = free.filter_map(|key| self.world.object_of(key));
        objects
            .map(|object| self.world.physics.pose(object.body))
            .collect()
    }

    /// Keeps the object from falling asleep, or no longer.
    pub(super) fn keep_awake(&mut self, awake: bool) {
        if let Some(object) = self.world.object_of(self.key) {
            let body = object.body;
            if awake {
                self.world.physics.keep_awake(body);
            } else {
                self.world.physics.let_sleep(body);
            }
        }
    }

    /// Whether all that may move is at rest, but for the objects with the given keys.
    pub(super) fn is_at_rest(&self, restless: &[PartKey]) -> bool {
        let mut moving = self.world.moving_objects();
        moving.all(|object| restless.contains(&object.key()))
    }

    /// Lets go of what stands fast near something that moves.
    fn free_what_is_near(&mut self) {
        let world = &self.world;
        let zones: Vec<Aabb> = self
            .free
            .iter()
            .filter_map(|(key, start)| {
                let object = world.object_of(*key)?;
                let pose = world.physics.pose(object.body);
                let (linear, _) = world.physics.velocity(object.body);
                let moves = *key == self.key
                    || distance_between(start, &pose) > MOVED
                    || angle_between(start, &pose) > TURNED;
                let zone = world.bounds_of(object);
                let travel = linear.norm() * STEP_SECONDS;
                moves.then(|| zone.loosened(NEAR + travel))
            })
            .collect();
        let (near, fast) = std::mem::take(&mut self.fast)
            .into_iter()
            .partition(|(_, bounds)| zones.iter().any(|zone| zone.intersects(bounds)));
        self.fast = fast;
        let near: Vec<(PartKey, Aabb)> = near;
        for (key, _) in near {
            self.world.embody(key, |object| BodyKind::Object {
                mass: object.mass,
                friction: object.friction,
            });
            if let Some(object) = self.world.object_of(key) {
                self.free.push((key, self.world.physics.pose(object.body)));
            }
        }
    }
}
