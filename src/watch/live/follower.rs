//! Writes into a chronicle what happens in a session.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::chronicle::Chronicle;
use crate::watch::{Cause, Follower, Happening, Seen, Witness};
use crate::world::CollisionHit;

/// Real time between two moments that viewers get: more come than a screen shows.
const BETWEEN_MOMENTS: Duration = Duration::from_millis(14);

/// Simulated time (s) between two moments of the past.
const BETWEEN_KEPT: f64 = 1.0 / 30.0;

/// Writes into a chronicle what happens in a session. Looks at the world no more often than
/// somebody can see.
pub(crate) struct LiveFollower {
    chronicle: Chronicle,
    witness: Witness,
    left: Option<Instant>,
    kept: f64,
}

impl LiveFollower {
    /// A follower that writes into the chronicle.
    pub(crate) fn new(chronicle: Chronicle, witness: Witness) -> Self {
        Self {
            chronicle,
            witness,
            left: None,
            kept: f64::NEG_INFINITY,
        }
    }
}

impl Follower for LiveFollower {
    fn see(&mut self, seen: &Seen<'_>, cause: Cause) {
        let keep = seen.time >= self.kept + BETWEEN_KEPT || cause == Cause::Rest;
        let is_due = self
            .left
            .is_none_or(|left| left.elapsed() >= BETWEEN_MOMENTS);
        if !keep && !is_due {
            return;
        }
        let moment = Arc::new(self.witness.look(seen));
        if keep {
            self.kept = seen.time;
        }
        // Edits that take no time are part of the past, too: the last one counts.
        let keep = keep || cause == Cause::Edit;
        self.chronicle.leave(self.witness.nodes(), moment, keep);
        self.left = Some(Instant::now());
    }

    fn hear(&mut self, time: f64, happening: &Happening) {
        self.chronicle.tell(time, happening);
    }

    fn collide(&mut self, time: f64, hit: &CollisionHit) {
        self.witness.collide(time, hit);
    }
}

impl Drop for LiveFollower {
    fn drop(&mut self) {
        self.chronicle.close();
    }
}
