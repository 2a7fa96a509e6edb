//! How long the robot has stood still while a job is blocked.

use crate::world::physics::STEP_SECONDS;
use crate::world::{RobotConfiguration, World};

/// Tracks whether the robot still moves while a job is blocked: as long as another job
/// moves it, the path may become free.
#[derive(Clone, Debug, Default)]
pub(super) struct StandstillTimer {
    last: Option<RobotConfiguration>,
    still: u32,
}

impl StandstillTimer {
    /// Call in every tick in which the job is blocked. Returns how long (s) the robot has not
    /// moved at all.
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

    /// Call when the job continues.
    pub(super) fn reset(&mut self) {
        *self = Self::default();
    }
}
