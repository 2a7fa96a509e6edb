//! How fast simulated time passes, as viewers choose.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
    shared: Arc<Mutex<State>>,
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
            shared: Arc::new(Mutex::new(state)),
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
    }

    /// Carries out a viewer's request: `pause`, `go`, or `speed` and a speed. Returns whether the
    /// request is known.
    pub(super) fn change(&self, wanted: &str) -> bool {
        match wanted.split_once(' ') {
            None if wanted == "pause" => self.set_paused(true),
            None if wanted == "go" => self.set_paused(false),
            Some(("speed", speed)) => match Speed::named(speed) {
                Some(speed) => self.set_speed(speed),
                None => return false,
            },
            _ => return false,
        }
        true
    }

    fn state(&self) -> MutexGuard<'_, State> {
        let state = self.shared.lock();
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
    fn only_known_requests_change_the_pace() {
        let pace = PaceControl::new(Speed::Times(2.0));
        assert!(pace.change("pause"));
        assert_eq!(pace.get(), (Speed::Times(2.0), true));
        assert!(pace.change("go") && pace.change("speed max"));
        assert_eq!(pace.get(), (Speed::Unlimited, false));
        for text in ["", "speed", "speed -1", "speed 1e9", "pause 1", "fly"] {
            assert!(!pace.change(text), "{text}");
        }
    }
}
