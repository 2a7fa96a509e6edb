//! Following a trajectory step by step, with stops and resumption.
//!
//! Time along the trajectory normally runs as fast as the world's. Braking makes it run slower
//! and slower, and afterwards it returns to full speed, both as fast as the limits of
//! acceleration allow. A step that is refused at the last moment stops it at once.

use super::trajectory::Trajectory;
use crate::world::physics::STEP_SECONDS;

/// How fast (1/s) the rate of time changes at most.
const RATE_CHANGE: f64 = 10.0;
/// The rate of time after a stop.
const FIRST_RATE: f64 = 0.02;
/// A velocity whose square is less than this allows any change of the rate.
const AT_REST: f64 = 1e-12;

/// A point on a trajectory that advances with time.
#[derive(Clone, Debug)]
pub(crate) struct TrajectoryFollower {
    trajectory: Trajectory,
    time: f64,
    rate: f64,
}

impl TrajectoryFollower {
    pub(crate) fn new(trajectory: Trajectory) -> Self {
        Self {
            trajectory,
            time: 0.0,
            rate: 1.0,
        }
    }

    /// The trajectory that is followed.
    pub(crate) fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Whether the last step has been taken.
    pub(crate) fn is_at_end(&self) -> bool {
        self.time >= self.trajectory.duration()
    }

    /// Positions of the axes after the next step.
    pub(crate) fn next(&self) -> Vec<f64> {
        self.trajectory.position(self.next_time())
    }

    /// Positions of the axes that much later (s) at full speed.
    pub(crate) fn ahead(&self, seconds: f64) -> Vec<f64> {
        self.trajectory.position(self.time + seconds)
    }

    fn next_time(&self) -> f64 {
        self.time + self.rate * STEP_SECONDS
    }

    /// Takes the step that [`Self::next`] has returned.
    pub(crate) fn advance(&mut self) {
        self.time = self.next_time();
        if self.rate < 1.0 {
            let [_, most] = self.rate_changes();
            self.rate = (self.rate + most * STEP_SECONDS).min(1.0);
        }
    }

    /// Takes the step and makes the following ones shorter.
    pub(crate) fn brake(&mut self) {
        self.time = self.next_time();
        let [least, _] = self.rate_changes();
        self.rate = (self.rate + least * STEP_SECONDS).max(0.0);
    }

    /// The greatest decrease and increase (1/s) of the rate within the limits of acceleration:
    /// with the trajectory's velocity v and acceleration a, and rate r, the axes move with
    /// acceleration a r² + v dr/dt.
    fn rate_changes(&self) -> [f64; 2] {
        let velocity = self.trajectory.velocity(self.time);
        let acceleration = self.trajectory.acceleration(self.time);
        let square = self.rate * self.rate;
        let mut range = [-RATE_CHANGE, RATE_CHANGE];
        for group in self.trajectory.limits() {
            let a = group.dot(&velocity, &velocity);
            if a < AT_REST {
                continue;
            }
            let b = group.dot(&velocity, &acceleration) * square;
            let present = group.dot(&acceleration, &acceleration) * square * square;
            let c = present - group.acceleration * group.acceleration;
            // The trajectory keeps its limits, so the root is real but for rounding.
            let root = (b * b - a * c).max(0.0).sqrt();
            range[0] = range[0].max((-b - root) / a);
            range[1] = range[1].min((-b + root) / a);
        }
        [range[0].min(0.0), range[1].max(0.0)]
    }

    /// Whether the next step is one from a place where the axes do not rest.
    pub(crate) fn is_moving(&self) -> bool {
        let is_on_the_way = self.time > 0.0 && !self.is_at_end();
        is_on_the_way && !self.is_stopped()
    }

    /// Whether braking has come to a stop.
    pub(crate) fn is_stopped(&self) -> bool {
        self.rate <= 0.0
    }

    /// Stays at the current point from now on, however fast the axes have moved.
    pub(crate) fn stop(&mut self) {
        self.rate = 0.0;
    }

    /// Holds the current point; the rate of time starts again from almost zero.
    pub(crate) fn hold(&mut self) {
        self.rate = FIRST_RATE;
    }

    /// Fraction of the time that has passed, 0..1.
    pub(crate) fn fraction(&self) -> f64 {
        let duration = self.trajectory.duration();
        if duration > 0.0 {
            (self.time / duration).min(1.0)
        } else {
            1.0
        }
    }
}
