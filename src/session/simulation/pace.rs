//! Letting simulated time pass no faster than a multiple of the real one. It changes when
//! things happen for the person who watches, never what happens.

use std::thread;
use std::time::{Duration, Instant};

use crate::world::physics::STEP_SECONDS;

/// Longest lag (s) behind the real time that is made up for; after a pause, as at the
/// prompt, time goes on from then.
const MOST_LAG: f64 = 0.1;

/// Keeps pace with the real time.
pub(super) struct Pace {
    factor: f64,
    next: Instant,
}

impl Pace {
    /// So many simulated seconds in a real one.
    pub fn new(factor: f64) -> Pace {
        Pace {
            factor,
            next: Instant::now(),
        }
    }

    /// Waits until the next step of the world is due.
    pub fn wait_for_step(&mut self) {
        let now = Instant::now();
        if now.saturating_duration_since(self.next).as_secs_f64() > MOST_LAG {
            self.next = now;
        }
        self.next += Duration::from_secs_f64(STEP_SECONDS / self.factor);
        thread::sleep(self.next.saturating_duration_since(now));
    }
}
