//! The evaluation under way, as other threads see it: they interrupt it, and no other.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use super::limits::{Limit, Limits};

/// Time between two interrupts once the grace is over: each ends one cleanup form.
const AGAIN: Duration = Duration::from_millis(10);

/// The evaluation under way, if there is one.
#[derive(Default)]
pub(crate) struct Running {
    state: Mutex<State>,
    ended: Condvar,
}

#[derive(Default)]
struct State {
    /// The number of the last evaluation.
    number: u64,
    /// The interrupt flag of the evaluation under way.
    flag: Option<Arc<AtomicBool>>,
    grace: Duration,
    /// How often it has been interrupted.
    interrupts: u64,
    /// The limit that interrupted it first.
    reached: Option<Limit>,
}

impl State {
    fn is_running(&self, number: u64) -> bool {
        self.flag.is_some() && self.number == number
    }

    /// Interrupts the evaluation; has it not been interrupted before?
    fn interrupt(&mut self, limit: Option<Limit>) -> bool {
        let Some(flag) = &self.flag else {
            return false;
        };
        flag.store(true, Ordering::Relaxed);
        let is_first = self.interrupts == 0;
        if is_first {
            self.reached = limit;
        }
        self.interrupts += 1;
        is_first
    }
}

impl Running {
    fn state(&self) -> MutexGuard<'_, State> {
        // A state is never left half changed.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// An evaluation with an interrupt flag begins.
    pub(super) fn begin(self: &Arc<Self>, flag: &Arc<AtomicBool>, limits: &Limits) {
        let mut state = self.state();
        *state = State {
            number: state.number + 1,
            flag: Some(Arc::clone(flag)),
            grace: limits.grace,
            interrupts: 0,
            reached: None,
        };
        if let Some(wall_clock) = limits.wall_clock
            && self
                .interrupt_after(state.number, wall_clock, Some(Limit::WallClock))
                .is_err()
        {
            state.interrupt(Some(Limit::WallClock));
        }
    }

    /// The evaluation has ended; returns the limit that has interrupted it.
    pub(super) fn end(&self) -> Option<Limit> {
        let mut state = self.state();
        if let Some(flag) = state.flag.take()
            && state.interrupts > 0
        {
            // It is not meant for the next one.
            flag.store(false, Ordering::Relaxed);
        }
        self.ended.notify_all();
        state.reached
    }

    /// Interrupts the evaluation under way, again when the grace is over, and then until it has ended.
    /// Returns whether this is the first interrupt of an evaluation.
    pub(super) fn interrupt(self: &Arc<Self>, limit: Option<Limit>) -> bool {
        let mut state = self.state();
        let is_first = state.interrupt(limit);
        if is_first {
            // Without a thread the cleanup forms go on until the next interrupt.
            let _ = self.interrupt_after(state.number, state.grace, None);
        }
        is_first
    }

    /// The limit that has interrupted the evaluation first.
    pub(super) fn reached(&self) -> Option<Limit> {
        self.state().reached
    }

    /// Whether an evaluation is under way.
    pub(super) fn is_under_way(&self) -> bool {
        self.state().flag.is_some()
    }

    /// Starts a thread that interrupts an evaluation after some time, unless it has ended by then.
    fn interrupt_after(
        self: &Arc<Self>,
        number: u64,
        first: Duration,
        limit: Option<Limit>,
    ) -> io::Result<()> {
        let running = Arc::clone(self);
        let watch = move || {
            let mut wait = first;
            let mut state = running.state();
            while state.is_running(number) {
                let (woken, timeout) = running
                    .ended
                    .wait_timeout_while(state, wait, |state| state.is_running(number))
                    .unwrap_or_else(PoisonError::into_inner);
                state = woken;
                if timeout.timed_out() && state.is_running(number) {
                    let is_first = state.interrupt(limit);
                    wait = if is_first { state.grace } else { AGAIN };
                }
            }
        };
        let thread = thread::Builder::new().name("limits".to_owned());
        thread.spawn(watch).map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_evaluation_under_way_is_interrupted() {
        let running = Arc::new(Running::default());
        let flag = Arc::new(AtomicBool::new(false));
        assert!(!running.interrupt(None));
        running.begin(&flag, &Limits::NONE);
        assert!(running.interrupt(Some(Limit::Steps)));
        assert!(!running.interrupt(None));
        assert!(flag.load(Ordering::Relaxed));
        assert_eq!(running.end(), Some(Limit::Steps));
        assert!(!flag.load(Ordering::Relaxed));
        assert!(!running.interrupt(None));
        assert!(!flag.load(Ordering::Relaxed));
    }

    #[test]
    fn after_the_grace_interrupts_come_until_the_end() {
        let running = Arc::new(Running::default());
        let flag = Arc::new(AtomicBool::new(false));
        let limits = Limits {
            wall_clock: Some(Duration::ZERO),
            grace: Duration::ZERO,
            ..Limits::NONE
        };
        running.begin(&flag, &limits);
        for _ in 0..5 {
            while !flag.swap(false, Ordering::Relaxed) {
                thread::yield_now();
            }
        }
        assert_eq!(running.end(), Some(Limit::WallClock));
    }
}
