//! Letting go of an object, and waiting until it rests.

use super::job::{Activity, Job, MotionOutcome, MotionStatus, Progress};
use crate::motion::contact::holding::held_objects;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::robot::Side;
use crate::world::physics::STEP_SECONDS;
use crate::world::{World, WorldError};

/// Number of steps without motion that count as rest.
const QUIET: u32 = 24;
/// Longest time (s) that an object has to come to rest.
const SETTLE: f64 = 2.0;

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
