//! Following a trajectory step by step, with stopping and going on in between.
//!
//! Time along the trajectory normally runs as fast as the world's. When something is in the
//! way it stops at once; afterwards it comes back to full speed gradually.

use super::trajectory::Trajectory;
use crate::world::physics::STEP_SECONDS;

/// How fast the rate of time comes back to 1 after a stop, and falls when braking (1/s).
const RATE_CHANGE: f64 = 4.0;

/// A place on a trajectory that moves on with time.
#[derive(Clone, Debug)]
pub(super) struct TrajectoryFollower {
    trajectory: Trajectory,
    time: f64,
    rate: f64,
}

impl TrajectoryFollower {
    pub(super) fn new(trajectory: Trajectory) -> Self {
        Self {
            trajectory,
            time: 0.0,
            rate: 1.0,
        }
    }

    /// The trajectory that is followed.
    pub(super) fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Whether the end has been taken.
    pub(super) fn is_at_end(&self) -> bool {
        self.time >= self.trajectory.duration()
    }

    /// Where the axes shall be after the next step.
    pub(super) fn next(&self) -> Vec<f64> {
        self.trajectory.position(self.next_time())
    }

    /// Where the axes will be that much later (s) at full speed.
    pub(super) fn ahead(&self, seconds: f64) -> Vec<f64> {
        self.trajectory.position(self.time + seconds)
    }

    fn next_time(&self) -> f64 {
        self.time + self.rate * STEP_SECONDS
    }

    /// Takes the step that [`Self::next`] has told.
    pub(super) fn advance(&mut self) {
        self.time = self.next_time();
        self.rate = (self.rate + RATE_CHANGE * STEP_SECONDS).min(1.0);
    }

    /// Takes the step, and makes the following ones shorter.
    pub(super) fn brake(&mut self) {
        self.time = self.next_time();
        self.rate = (self.rate - RATE_CHANGE * STEP_SECONDS).max(0.0);
    }

    /// Whether braking has come to an end.
    pub(super) fn is_stopped(&self) -> bool {
        self.rate <= 0.0
    }

    /// Stays here.
    pub(super) fn hold(&mut self) {
        self.rate = RATE_CHANGE * STEP_SECONDS;
    }

    /// How much of the time has passed, 0..1.
    pub(super) fn fraction(&self) -> f64 {
        let duration = self.trajectory.duration();
        if duration > 0.0 {
            (self.time / duration).min(1.0)
        } else {
            1.0
        }
    }
}
