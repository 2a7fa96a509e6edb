//! Limiting simulated time to a multiple of real time. This affects when things happen for
//! the user who watches, never what happens.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use crate::outside::Clock;
use view::watch::live::{PaceControl, Speed};

/// Longest lag (s) behind real time that is made up for; after longer pauses, such as at the
/// prompt, time continues from the present.
const MAX_LAG: f64 = 0.1;

/// Longest wait between checks for an interrupt.
const SLICE: Duration = Duration::from_millis(50);

/// Keeps pace with real time.
pub(crate) struct Pace {
    control: PaceControl,
    clock: Arc<dyn Clock>,
    /// When, by the clock, the next wait begins.
    next: Duration,
}

impl Pace {
    /// Keeps the pace that the control sets, by a clock.
    pub(crate) fn new(control: PaceControl, clock: Arc<dyn Clock>) -> Pace {
        let next = clock.now();
        Pace {
            control,
            clock,
            next,
        }
    }

    /// The control that sets the speed.
    pub(crate) fn control(&self) -> &PaceControl {
        &self.control
    }

    /// How much simulated time (s) may pass at once when nothing happens; `None` if unlimited. It
    /// is the same whether somebody waits for it or not, unless the viewer has paused the session.
    pub(crate) fn slice(&self, waits: bool) -> Option<f64> {
        match self.control.get() {
            (Speed::Times(factor), _) => Some(SLICE.as_secs_f64() * factor),
            // Waits for the end of the pause, then continues.
            (Speed::Unlimited, true) if waits => Some(f64::EPSILON),
            (Speed::Unlimited, _) => None,
        }
    }

    /// Waits until `seconds` of simulated time may have passed since the last wait, or until
    /// the interrupt flag is set.
    pub(crate) fn wait(&mut self, mut seconds: f64, interrupt: &AtomicBool) {
        while !interrupt.load(Ordering::Relaxed) {
            let (speed, is_paused) = self.control.get();
            if is_paused {
                self.clock.wait(SLICE);
                continue;
            }
            let now = self.clock.now();
            let factor = match speed {
                Speed::Times(factor) => factor,
                Speed::Unlimited => {
                    self.next = now;
                    return;
                }
            };
            if now.saturating_sub(self.next).as_secs_f64() > MAX_LAG {
                self.next = now;
            }
            // A long wait is divided into slices, between which the speed may change.
            let slice = seconds.min(SLICE.as_secs_f64() * factor);
            self.next += Duration::from_secs_f64(slice / factor);
            seconds -= slice;
            self.clock.wait(self.next.saturating_sub(now));
            if seconds <= 0.0 {
                return;
            }
        }
    }
}
