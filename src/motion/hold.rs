//! Taking hold of an object between the fingers, and letting go of it.

use super::failure::MotionFailure;
use super::job::{Activity, Job, MotionOutcome, MotionStatus, ProcessModule, Progress};
use crate::robot::Side;
use crate::world::World;
use crate::world::physics::STEP_SECONDS;

/// Number of steps without motion that count as rest.
const QUIET: u32 = 24;
/// Longest time (s) that an object has to come to rest.
const SETTLE: f64 = 2.0;

/// Welds the object softly to the palm of the hand at its current pose.
pub(crate) fn take_hold(world: &mut World, side: Side, object: &str) -> Result<(), MotionFailure> {
    let palm = world.models().description.arm(side).gripper.palm;
    world
        .attach(object, palm)
        .map_err(|e| MotionFailure::UnknownName(e.to_string()))
}

/// Names of the objects that the hand holds.
pub(crate) fn held_objects(world: &World, side: Side) -> Vec<String> {
    let palm = world.models().description.arm(side).gripper.palm;
    let held = world
        .objects()
        .filter(|o| o.attachment().is_some_and(|a| a.link == palm));
    held.map(|o| o.name().to_owned()).collect()
}

/// Lets go of an object and waits until everything is at rest.
pub(crate) type LetGo = Job<Release>;

/// Releasing an object.
#[derive(Clone, Debug)]
pub(crate) struct Release {
    side: Side,
    object: Option<String>,
    released: Option<String>,
    quiet: u32,
    waited: f64,
}

impl LetGo {
    /// Releases the named object, or whatever the hand holds.
    pub(crate) fn new(side: Side, object: Option<String>) -> Self {
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
        match world.detach(&name) {
            Ok(Some(_)) => Ok(name),
            Ok(None) => Err(MotionFailure::HoldsNothing { side }),
            Err(error) => Err(MotionFailure::UnknownName(error.to_string())),
        }
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
