//! Taking hold of an object between the fingers, and waiting until it rests again.

use super::failure::MotionFailure;
use super::hand::{GRIP_FORCE, gripper_of, pressing_on};
use super::job::{Activity, Job, MotionOutcome, MotionStatus, ProcessModule, Progress};
use crate::robot::Side;
use crate::world::physics::STEP_SECONDS;
use crate::world::{World, WorldError};

/// Number of steps without motion that count as rest.
const QUIET: u32 = 24;
/// Longest time (s) that an object has to come to rest.
const SETTLE: f64 = 2.0;

/// Makes the fingers of a hand hold the object on which both press, each with the effort (N).
pub(super) fn press(
    world: &mut World,
    side: Side,
    object: &str,
    effort: f64,
) -> Result<(), MotionFailure> {
    world
        .hold(object, side, effort)
        .map_err(|e| MotionFailure::UnknownName(e.to_string()))
}

/// Makes sure that the hand holds the object: that its fingers do already, or that both press on
/// it.
pub fn take_hold(world: &mut World, side: Side, object: &str) -> Result<(), MotionFailure> {
    if held_objects(world, side).iter().any(|held| held == object) {
        return Ok(());
    }
    let forces = pressing_on(world, side, object);
    if forces.iter().any(|force| *force <= GRIP_FORCE) {
        return Err(MotionFailure::NotBetweenFingers {
            side,
            object: object.to_owned(),
            forces,
        });
    }
    let effort = gripper_of(world, side).effort;
    press(world, side, object, effort)
}

/// Names of the objects that the hand holds.
pub fn held_objects(world: &World, side: Side) -> Vec<String> {
    let palm = world.models().description.arm(side).gripper.palm;
    let held = world
        .objects()
        .filter(|o| o.attachment().is_some_and(|a| a.link == palm));
    held.map(|o| o.name().to_owned()).collect()
}

/// Lets go of an object, if the fingers have not done so already, and waits until everything is
/// at rest.
pub type LetGo = Job<Release>;

/// Releasing an object.
#[derive(Clone, Debug)]
pub struct Release {
    side: Side,
    object: Option<String>,
    released: Option<String>,
    quiet: u32,
    waited: f64,
}

impl LetGo {
    /// Releases the named object, or whatever the hand holds.
    pub fn new(side: Side, object: Option<String>) -> Self {
        Self::begin(Release {
            side,
            object,
            released: None,
            quiet: 0,
            waited: 0.0,
        })
    }
}

impl Release {
    fn release(&mut self, world: &mut World) -> Result<String, MotionFailure> {
        let side = self.side;
        let held = held_objects(world, side).into_iter().next();
        let name = self
            .object
            .clone()
            .or(held)
            .ok_or(MotionFailure::HoldsNothing { side })?;
        let unknown = |error: WorldError| MotionFailure::UnknownName(error.to_string());
        let is_held = world.object(&name).map_err(unknown)?.attachment().is_some();
        let is_held_here = held_objects(world, side).contains(&name);
        if is_held && !is_held_here {
            return Err(MotionFailure::HoldsNothing { side });
        }
        // Fingers that have opened let go of it already.
        world.detach(&name).map_err(unknown)?;
        Ok(name)
    }
}

impl Activity for Release {
    const MODULE: ProcessModule = ProcessModule::Grippers;

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        let Some(object) = &self.released else {
            match self.release(world) {
                Ok(name) => self.released = Some(name),
                Err(failure) => return Some(MotionStatus::failed(failure)),
            }
            return None;
        };
        self.waited += STEP_SECONDS;
        self.quiet = if world.is_at_rest() {
            self.quiet + 1
        } else {
            0
        };
        if self.quiet < QUIET && self.waited < SETTLE {
            return None;
        }
        Some(MotionStatus::Done(MotionOutcome::Released {
            object: object.clone(),
            at_rest: self.quiet >= QUIET,
        }))
    }

    fn progress(&self) -> Progress {
        Progress {
            what: "letting go",
            fraction: (self.waited / SETTLE).min(1.0),
        }
    }
}
