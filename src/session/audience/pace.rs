//! Letting simulated time pass no faster than a multiple of the real one. It changes when
//! things happen for the person who watches, never what happens.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use crate::watch::live::{PaceControl, Speed};

/// Longest lag (s) behind the real time that is made up for; after a pause, as at the
/// prompt, time goes on from then.
const MOST_LAG: f64 = 0.1;

/// Longest wait before it is looked whether somebody interrupts.
const SLICE: Duration = Duration::from_millis(50);

/// Keeps pace with the real time.
pub(crate) struct Pace {
    control: PaceControl,
    next: Instant,
}

impl Pace {
    /// At the speed that the control says.
    pub(crate) fn new(control: PaceControl) -> Pace {
        Pace {
            control,
            next: Instant::now(),
        }
    }

    /// Who says how fast.
    pub(crate) fn control(&self) -> &PaceControl {
        &self.control
    }

    /// How much simulated time (s) may pass at once when nothing happens; none if as much as
    /// there is.
    pub(crate) fn slice(&self) -> Option<f64> {
        match self.control.get() {
            (Speed::Times(factor), _) => Some(SLICE.as_secs_f64() * factor),
            // It waits for the end of the pause, then goes on.
            (Speed::Unlimited, true) => Some(f64::EPSILON),
            (Speed::Unlimited, false) => None,
        }
    }

    /// Waits until so much simulated time (s) may have passed since it was waited last, or
    /// until somebody interrupts.
    pub(crate) fn wait(&mut self, mut seconds: f64, interrupt: &AtomicBool) {
        while !interrupt.load(Ordering::Relaxed) {
            let Some(speed) = self.control.wait(SLICE) else {
                continue;
            };
            let now = Instant::now();
            let factor = match speed {
                Speed::Times(factor) => factor,
                Speed::Unlimited => {
                    self.next = now;
                    return;
                }
            };
            if now.saturating_duration_since(self.next).as_secs_f64() > MOST_LAG {
                self.next = now;
            }
            // A long sleep is taken in slices, between which the speed may change.
            let slice = seconds.min(SLICE.as_secs_f64() * factor);
            self.next += Duration::from_secs_f64(slice / factor);
            seconds -= slice;
            thread::sleep(self.next.saturating_duration_since(now));
            if seconds <= 0.0 {
                return;
            }
        }
    }
}
