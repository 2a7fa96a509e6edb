//! When to plan again after a plan has failed.

use super::standstill::StandstillTimer;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::world::physics::STEP_SECONDS;
use crate::world::{RobotConfiguration, World};

/// After this time (s) without motion the robot counts as steady.
const STEADY: f64 = 0.05;
/// While it moves, planning is retried after this time (s).
const AGAIN: f64 = 0.5;

/// What to do about planning in this tick.
#[derive(Debug)]
pub(super) enum Attempt {
    /// Plan.
    Now,
    /// Wait.
    Later,
    /// Give up: nothing has changed for too long.
    GiveUp(MotionFailure),
}

/// Decides when to plan again after planning has failed: once other jobs have moved the
/// robot into another configuration, in which the path may be free.
#[derive(Clone, Debug, Default)]
pub(super) struct Replanning {
    standstill: StandstillTimer,
    failed: Option<(RobotConfiguration, MotionFailure)>,
    since: f64,
}

impl Replanning {
    /// Call in every tick without a plan; `give_up_after` is how long (s) the robot may stay
    /// in a configuration for which there is no plan.
    pub(super) fn next(&mut self, world: &World, give_up_after: f64) -> Attempt {
        let still = self.standstill.wait(world);
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

    /// Call when planning has failed.
    pub(super) fn failed(&mut self, world: &World, failure: MotionFailure) {
        self.failed = Some((world.robot_configuration().clone(), failure));
        self.since = 0.0;
    }

    /// Call when planning has succeeded.
    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}
