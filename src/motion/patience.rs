//! How long a job waits for others before it gives up.

use super::failure::MotionFailure;
use crate::world::physics::STEP_SECONDS;
use crate::world::{RobotConfiguration, World};

/// Watches whether the robot still moves while a job is blocked: as long as another job
/// moves it, the way may become free.
#[derive(Clone, Debug, Default)]
pub(super) struct Patience {
    last: Option<RobotConfiguration>,
    still: u32,
}

impl Patience {
    /// To be called in every tick in which the job is blocked. Returns for how long (s) the
    /// robot has not moved at all.
    pub(super) fn wait(&mut self, world: &World) -> f64 {
        let now = world.robot_configuration();
        if self.last.as_ref() == Some(now) {
            self.still += 1;
        } else {
            self.last = Some(now.clone());
            self.still = 0;
        }
        f64::from(self.still) * STEP_SECONDS
    }

    /// To be called when the job goes on.
    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}

/// The robot is steady when it has not moved for this long (s).
const STEADY: f64 = 0.05;
/// While it moves, a plan that failed is tried again after this time (s).
const AGAIN: f64 = 0.5;

/// What to do about a plan in this tick.
#[derive(Debug)]
pub(super) enum Attempt {
    /// Plan.
    Now,
    /// Wait.
    Later,
    /// Nothing has changed for too long.
    GiveUp(MotionFailure),
}

/// When to plan again after a plan has failed: when other jobs have moved the robot into
/// another configuration, since the way may be free then.
#[derive(Clone, Debug, Default)]
pub(super) struct Retry {
    patience: Patience,
    failed: Option<(RobotConfiguration, MotionFailure)>,
    since: f64,
}

impl Retry {
    /// To be called in every tick without a plan; `give_up_after` is how long (s) the robot
    /// may stay in a configuration for which there is no plan.
    pub(super) fn next(&mut self, world: &World, give_up_after: f64) -> Attempt {
        let still = self.patience.wait(world);
        self.since += STEP_SECONDS;
        match self.failed.take() {
            None => Attempt::Now,
            Some((robot, failure)) if robot == *world.robot_configuration() => {
                if still >= give_up_after {
                    return Attempt::GiveUp(failure);
                }
                self.failed = Some((robot, failure));
                Attempt::Later
            }
            Some(_) if still >= STEADY || self.since >= AGAIN => Attempt::Now,
            Some(failed) => {
                self.failed = Some(failed);
                Attempt::Later
            }
        }
    }

    /// To be called when the plan has failed.
    pub(super) fn failed(&mut self, world: &World, failure: MotionFailure) {
        self.failed = Some((world.robot_configuration().clone(), failure));
        self.since = 0.0;
    }

    /// To be called when there is a plan.
    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}
