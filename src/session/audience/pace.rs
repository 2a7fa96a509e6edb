//! Limiting simulated time to a multiple of real time. This affects when things happen for
//! the user who watches, never what happens.

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use view::watch::live::{PaceControl, Speed};

/// Longest lag (s) behind real time that is made up for; after longer pauses, such as at the
/// prompt, time continues from the present.
const MOST_LAG: f64 = 0.1;

/// Longest wait between checks for an interrupt.
const SLICE: Duration = Duration::from_millis(50);

/// Keeps pace with real time.
pub(crate) struct Pace {
    control: PaceControl,
    next: Instant,
}

impl Pace {
    /// Keeps the pace that the control sets.
    pub(crate) fn new(control: PaceControl) -> Pace {
        Pace {
            control,
            next: Instant::now(),
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
            // A long wait is divided into slices, between which the speed may change.
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
