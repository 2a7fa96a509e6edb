//! Real time.

use std::fmt::Debug;
use std::sync::LazyLock;
use std::thread;
use std::time::{Duration, Instant};

/// Measures real time.
pub trait Clock: Debug + Send + Sync {
    /// The time since some moment that stays the same. It never goes back.
    fn now(&self) -> Duration;

    /// Returns when so much time has passed, or earlier.
    fn wait(&self, duration: Duration);
}

/// The clock of the machine.
#[derive(Clone, Copy, Debug)]
pub struct MachineClock;

/// When somebody first asked for the time.
static BEGIN: LazyLock<Instant> = LazyLock::new(Instant::now);

impl Clock for MachineClock {
    fn now(&self) -> Duration {
        BEGIN.elapsed()
    }

    fn wait(&self, duration: Duration) {
        thread::sleep(duration);
    }
}
