//! Whether an object stands for good, or would stand somewhere: tried out in a copy of the world.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::body_name::BodyName;
use super::error::WorldError;
use super::object::Object;
use super::part_key::PartKey;
use super::physics::{Robot, STEP_SECONDS};
use super::scene::World;
use crate::spatial::pose::{angle_between, distance_between};
use crate::spatial::{Pose, trig};

/// How long (s) an object is watched.
const WATCHED: f64 = 2.0;

/// What an object would do if it were let go somewhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct StandTrial {
    /// How far (m) it would move.
    pub(crate) moved: f64,
    /// How far (rad) it would tip.
    pub(crate) tilt: f64,
    /// What would carry it then; `None` if it would still be falling.
    pub(crate) support: Option<BodyName>,
}

/// How long (s) an object that seems to be at rest is watched, and how far (m, rad) it may creep
/// meanwhile.
const PROBED: f64 = 1.0;
const CREEP: f64 = 0.0002;
const CREEP_TURN: f64 = 0.003;

impl World {
    /// Lets time pass until everything is at rest, the object for good, but about `seconds` (s) at
    /// most. Returns whether it has come to that. What moved before is not waited for: it may be
    /// something that never comes to rest.
    ///
    /// An object that balances on an edge moves too slowly at first to count as moving, and the
    /// engine puts it to sleep; it would fall over when the robot comes near. So it is watched in a
    /// copy of the world, in which it may not sleep; if it does not stay there, the world becomes that
    /// copy.
    pub(crate) fn come_to_rest(&mut self, name: &str, seconds: f64) -> Result<bool, WorldError> {
        let moving = self.moving_objects().filter(|object| object.name() != name);
        let restless: Vec<_> = moving.map(Object::key).collect();
        let mut left = seconds;
        while left > 0.0 {
            let before = self.steps();
            if !self.settle_without(&restless, left) {
                return Ok(false);
            }
            let mut ahead = self.clone();
            if ahead.stays(name)? {
                self.let_all_sleep(&restless);
                return Ok(true);
            }
            *self = ahead;
            // Exact for any number of steps that can be simulated.
            left -= (self.steps() - before) as f64 * STEP_SECONDS;
        }
        Ok(false)
    }

    /// Lets time pass in which the object does not sleep, until it has moved or been watched for
    /// long enough. Returns whether it stays where it is.
    fn stays(&mut self, name: &str) -> Result<bool, WorldError> {
        let body = self.object(name)?.body;
        let before = self.object_pose(name)?;
        self.physics.keep_awake(body);
        let mut has_stayed = true;
        let mut left = PROBED;
        while has_stayed && left > 0.0 {
            self.step();
            left -= STEP_SECONDS;
            let now = self.physics.pose(body);
            has_stayed = distance_between(&before, &now) < CREEP
                && angle_between(&before, &now) < CREEP_TURN;
        }
        self.physics.let_sleep(body);
        Ok(has_stayed)
    }

    /// Lets all objects sleep but those with the given keys. They are at rest; if they stayed awake
    /// until the engine believes that, an object that is spawned next would pay for them.
    fn let_all_sleep(&mut self, restless: &[PartKey]) {
        for object in self.state.objects.values() {
            if !restless.contains(&object.key()) {
                self.physics.need_not_wait(object.body);
            }
        }
    }

    /// What the object would do if it were let go at the pose, with the robot out of its way.
    /// The world itself is not changed.
    pub(crate) fn stand_trial(&self, name: &str, pose: &Pose) -> Result<StandTrial, WorldError> {
        let mut world = self.clone();
        world.detach(name)?;
        let body = world.object(name)?.body;
        world.physics.collide(body, Robot::Absent);
        world.physics.place(body, pose);
        world.settle(WATCHED);
        let end = world.object_pose(name)?;
        let [was_up, is_up] = [pose, &end].map(|pose| pose.rotation * Vector3::z());
        let supports = world.supports(name)?.into_iter();
        let most = supports.max_by(|a, b| a.force.total_cmp(&b.force));
        Ok(StandTrial {
            moved: (end.translation.vector - pose.translation.vector).norm(),
            tilt: trig::atan2(was_up.cross(&is_up).norm(), was_up.dot(&is_up)),
            support: most.map(|most| most.body),
        })
    }
}
