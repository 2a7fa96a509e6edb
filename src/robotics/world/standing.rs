//! Whether an object stands for good, or would stand somewhere: tried out in a copy of the world.

use nalgebra::Vector3;
use serde::Serialize;

use super::body_name::BodyName;
use super::error::WorldError;
use super::object::Object;
use super::part_key::PartKey;
use super::physics::{Robot, STEP_SECONDS};
use super::scene::{QUIET_STEPS, World, steps_in};
use super::settling::Trial;
use spatial::pose::{angle_between, distance_between};
use spatial::{Pose, trig};

/// How long (s) an object is watched.
const WATCHED: f64 = 2.0;

/// What an object would do if it were let go somewhere.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StandTrial {
    /// How far (m) it would move.
    pub moved: f64,
    /// How far (rad) it would tip; a ball does not.
    pub tilt: f64,
    /// What would carry it then; `None` if it would still be falling.
    pub support: Option<BodyName>,
}

/// How long (s) an object that seems to be at rest is watched, and how far (m, rad) it may creep
/// meanwhile.
const PROBED: f64 = 1.0;
const CREEP: f64 = 0.0002;
const CREEP_TURN: f64 = 0.003;

/// For how many steps objects are kept from moving that a trial has shown to be at rest, until the
/// engine knows what touches what.
const STILL_STEPS: u32 = 3;

impl Trial {
    /// Lets time pass until all that may move is at rest, the object itself for good, but about
    /// `seconds` (s) at most. Returns whether it has come to that.
    fn settles(&mut self, restless: &[PartKey], seconds: f64) -> bool {
        let mut left = steps_in(seconds);
        let mut quiet = 0;
        let mut mark = (left, self.poses(restless));
        while left > 0 {
            self.step();
            left -= 1;
            // What leans on something may rock for long without getting anywhere.
            if mark.0 - left >= steps_in(PROBED) {
                let now = self.poses(restless);
                let is_same = |(before, now)| is_same_place(before, now);
                if mark.1.len() == now.len() && mark.1.iter().zip(&now).all(is_same) {
                    return true;
                }
                mark = (left, now);
            }
            quiet = if self.is_at_rest(restless) {
                quiet + 1
            } else {
                0
            };
            if quiet >= QUIET_STEPS {
                if self.stays(&mut left) {
                    return true;
                }
                quiet = 0;
            }
        }
        false
    }

    /// Whether the object, which does not sleep meanwhile, stays where it is, as [`World::stays`].
    fn stays(&mut self, left: &mut u64) -> bool {
        let before = self.pose();
        self.keep_awake(true);
        let mut has_stayed = true;
        for _ in 0..steps_in(PROBED) {
            self.step();
            *left = left.saturating_sub(1);
            has_stayed = is_same_place(&before, &self.pose());
            if !has_stayed {
                break;
            }
        }
        self.keep_awake(false);
        has_stayed
    }
}

/// Whether an object that was at the first pose has stayed there.
fn is_same_place(before: &Pose, now: &Pose) -> bool {
    distance_between(before, now) < CREEP && angle_between(before, now) < CREEP_TURN
}

impl World {
    /// Lets time pass until everything is at rest, the object for good, but about `seconds` (s) at
    /// most. Returns whether it has come to that. What moved before is not waited for: it may be
    /// something that never comes to rest.
    ///
    /// An object that balances on an edge moves too slowly at first to count as moving, and the
    /// engine puts it to sleep; it would fall over when the robot comes near. So it is watched in a
    /// copy of the world, in which it may not sleep; if it does not stay there, the world becomes that
    /// copy.
    pub fn come_to_rest(&mut self, name: &str, seconds: f64) -> Result<bool, WorldError> {
        let moving = self.moving_objects().filter(|object| object.name() != name);
        let restless: Vec<_> = moving.map(Object::key).collect();
        let mut left = seconds;
        let key = self.object(name)?.key();
        if self.has_neighbours(key) {
            let mut trial = Trial::new(self, key);
            let has_settled = trial.settles(&restless, seconds);
            self.adopt(&trial);
            if has_settled {
                self.stand_still(&restless);
            }
            return Ok(has_settled);
        }
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
            has_stayed = is_same_place(&before, &now);
        }
        self.physics.let_sleep(body);
        Ok(has_stayed)
    }

    /// Lets all objects sleep where they are but those with the given keys. They are at rest there,
    /// as a trial has shown.
    fn stand_still(&mut self, restless: &[PartKey]) {
        for _ in 0..STILL_STEPS {
            let objects = self.objects();
            let still = objects.filter(|object| {
                object.attachment().is_none() && !restless.contains(&object.key())
            });
            let still: Vec<_> = still
                .filter(|object| self.physics.is_awake(object.body))
                .map(|object| (object.body, self.physics.pose(object.body)))
                .collect();
            self.step();
            for (body, pose) in still {
                self.physics.place(body, &pose);
            }
        }
        self.let_all_sleep(restless);
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
        let tilt = trig::atan2(was_up.cross(&is_up).norm(), was_up.dot(&is_up));
        let can_tip = world.object(name)?.can_tip();
        Ok(StandTrial {
            moved: (end.translation.vector - pose.translation.vector).norm(),
            tilt: if can_tip { tilt } else { 0.0 },
            support: world.carrier(name)?,
        })
    }
}
