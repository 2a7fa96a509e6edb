//! Following a trajectory step by step, with stops and resumption.
//!
//! Time along the trajectory normally runs as fast as the world's. If something is in the
//! way it stops at once; afterwards it gradually returns to full speed.

use super::trajectory::Trajectory;
use crate::world::physics::STEP_SECONDS;

/// How fast (1/s) the rate of time returns to 1 after a stop, and falls when braking.
const RATE_CHANGE: f64 = 4.0;

/// A point on a trajectory that advances with time.
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

    /// Whether the last step has been taken.
    pub(super) fn is_at_end(&self) -> bool {
        self.time >= self.trajectory.duration()
    }

    /// Positions of the axes after the next step.
    pub(super) fn next(&self) -> Vec<f64> {
        self.trajectory.position(self.next_time())
    }

    /// Positions of the axes that much later (s) at full speed.
    pub(super) fn ahead(&self, seconds: f64) -> Vec<f64> {
        self.trajectory.position(self.time + seconds)
    }

    fn next_time(&self) -> f64 {
        self.time + self.rate * STEP_SECONDS
    }

    /// Takes the step that [`Self::next`] has returned.
    pub(super) fn advance(&mut self) {
        self.time = self.next_time();
        self.rate = (self.rate + RATE_CHANGE * STEP_SECONDS).min(1.0);
    }

    /// Takes the step and makes the following ones shorter.
    pub(super) fn brake(&mut self) {
        self.time = self.next_time();
        self.rate = (self.rate - RATE_CHANGE * STEP_SECONDS).max(0.0);
    }

    /// Whether braking has come to a stop.
    pub(super) fn is_stopped(&self) -> bool {
        self.rate <= 0.0
    }

    /// Holds the current point; the rate of time starts again from almost zero.
    pub(super) fn hold(&mut self) {
        self.rate = RATE_CHANGE * STEP_SECONDS;
    }

    /// Fraction of the time that has passed, 0..1.
    pub(super) fn fraction(&self) -> f64 {
        let duration = self.trajectory.duration();
        if duration > 0.0 {
            (self.time / duration).min(1.0)
        } else {
            1.0
        }
    }
}
