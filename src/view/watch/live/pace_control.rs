//! How fast simulated time passes, as viewers choose.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How many simulated seconds pass per real second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// This many.
    Times(f64),
    /// As many as possible.
    Unlimited,
}

impl Speed {
    /// The speed named by the text: `max`, or a number from 0.01 to 100.
    pub fn named(text: &str) -> Option<Self> {
        if text == "max" {
            return Some(Self::Unlimited);
        }
        let factor: f64 = text.parse().ok()?;
        (0.01..=100.0)
            .contains(&factor)
            .then_some(Self::Times(factor))
    }

    /// The factor; infinite for [`Unlimited`](Self::Unlimited).
    pub fn factor(self) -> f64 {
        match self {
            Self::Times(factor) => factor,
            Self::Unlimited => f64::INFINITY,
        }
    }
}

/// How fast simulated time passes, and whether it is paused. Clones share the same control. It
/// changes when things happen, never what happens.
#[derive(Clone, Debug)]
pub struct PaceControl {
    shared: Arc<(Mutex<State>, Condvar)>,
}

#[derive(Clone, Copy, Debug)]
struct State {
    speed: Speed,
    is_paused: bool,
}

impl PaceControl {
    /// Time passes at this speed.
    pub fn new(speed: Speed) -> Self {
        let state = State {
            speed,
            is_paused: false,
        };
        Self {
            shared: Arc::new((Mutex::new(state), Condvar::new())),
        }
    }

    /// The speed, and whether time is paused.
    pub fn get(&self) -> (Speed, bool) {
        let state = self.state();
        (state.speed, state.is_paused)
    }

    /// Changes the speed.
    pub(crate) fn set_speed(&self, speed: Speed) {
        self.state().speed = speed;
    }

    /// Pauses time, or lets it pass again.
    pub fn set_paused(&self, is_paused: bool) {
        self.state().is_paused = is_paused;
        self.shared.1.notify_all();
    }

    /// Waits while time is paused, up to the timeout. Returns the speed, or `None` if time is
    /// still paused.
    pub fn wait(&self, timeout: Duration) -> Option<Speed> {
        let waiting = |state: &mut State| state.is_paused;
        let waited = self
            .shared
            .1
            .wait_timeout_while(self.state(), timeout, waiting);
        let (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        (!state.is_paused).then_some(state.speed)
    }

    fn state(&self) -> MutexGuard<'_, State> {
        let state = self.shared.0.lock();
        state.unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use crate::watch::live::pace_control::*;

    #[test]
    fn only_sensible_speeds_have_a_name() {
        assert_eq!(Speed::named("0.25"), Some(Speed::Times(0.25)));
        assert_eq!(Speed::named("max"), Some(Speed::Unlimited));
        for text in ["", "0", "-1", "nan", "inf", "1e9", "1;2", "MAX"] {
            assert_eq!(Speed::named(text), None, "{text}");
        }
    }

    #[test]
    fn time_stands_still_while_it_is_paused() {
        let pace = PaceControl::new(Speed::Times(2.0));
        pace.set_paused(true);
        assert_eq!(pace.wait(Duration::from_millis(1)), None);
        pace.set_paused(false);
        assert_eq!(pace.wait(Duration::from_secs(9)), Some(Speed::Times(2.0)));
    }
}
