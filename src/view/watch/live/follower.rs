//! Adds what happens in a session to a history.

use std::sync::Arc;
use std::time::Duration;

use super::history::History;
use crate::watch::{Cause, Follower, FrameBuilder, Observation, WatchEvent};
use robotics::world::CollisionHit;

/// Minimum real time between two frames for viewers; a screen could not show more.
const BETWEEN_FRAMES: Duration = Duration::from_millis(14);

/// Simulated time (s) between two frames of the past.
const BETWEEN_KEPT: f64 = 1.0 / 30.0;

/// Adds what happens in a session to a history. Builds frames no more often than a viewer can
/// see them.
pub struct LiveFollower {
    history: History,
    frame_builder: FrameBuilder,
    left: Option<Duration>,
    kept: f64,
    /// Measures real time for viewers, who want to see more than what is kept; `None` without viewers.
    now: Option<RealTime>,
}

/// The real time since some moment.
pub type RealTime = Box<dyn Fn() -> Duration>;

impl LiveFollower {
    /// A follower that adds to the history, for viewers who see frames as real time passes.
    pub fn new(history: History, frame_builder: FrameBuilder, now: RealTime) -> Self {
        let mut follower = Self::without_viewers(history, frame_builder);
        follower.now = Some(now);
        follower
    }

    /// A follower that adds only what is kept: the same session gives the same history.
    pub fn without_viewers(history: History, frame_builder: FrameBuilder) -> Self {
        Self {
            history,
            frame_builder,
            left: None,
            kept: f64::NEG_INFINITY,
            now: None,
        }
    }
}

impl Follower for LiveFollower {
    fn see(&mut self, observation: &Observation<'_>, cause: Cause) {
        let keep = observation.time >= self.kept + BETWEEN_KEPT || cause == Cause::Rest;
        let now = self.now.as_ref().map(|now| now());
        let is_due = match (now, self.left) {
            (Some(now), Some(left)) => now.saturating_sub(left) >= BETWEEN_FRAMES,
            (Some(_), None) => true,
            (None, _) => cause == Cause::Edit,
        };
        if !keep && !is_due {
            return;
        }
        let frame = Arc::new(self.frame_builder.build(observation));
        if keep {
            self.kept = observation.time;
        }
        // Edits that take no time are part of the past, too; of several, the last one is kept.
        let keep = keep || cause == Cause::Edit;
        self.history
            .publish(self.frame_builder.nodes(), frame, keep);
        self.left = now;
    }

    fn hear(&mut self, time: f64, event: &WatchEvent) {
        self.history.add_news(time, event);
    }

    fn collide(&mut self, time: f64, hit: &CollisionHit) {
        self.frame_builder.collide(time, hit);
    }
}

impl Drop for LiveFollower {
    fn drop(&mut self) {
        self.history.close();
    }
}
