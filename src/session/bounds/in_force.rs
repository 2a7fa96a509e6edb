//! The limits in force while an evaluation runs.

use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use super::interrupt_handle::InterruptHandle;
use super::limits::{Limit, Limits};
use super::running::Running;

/// Simulated time (s) for cleanup forms after an interrupt.
const CLEANUP_TIME: f64 = 10.0;
/// Steps of the world for them.
const CLEANUP_STEPS: u64 = 2400;

/// The limits in force, for the host, which lets time pass.
#[derive(Default)]
pub(crate) struct Bounds {
    running: Arc<Running>,
    /// Simulated time (s) at which the evaluation is interrupted.
    end: Cell<Option<f64>>,
    /// Steps that the world may still take.
    steps_left: Cell<Option<u64>>,
    /// The number of the world's last step.
    step: Cell<u64>,
}

impl Bounds {
    /// An evaluation begins at a simulated time (s), after a number of steps of the world.
    pub(crate) fn begin(&self, limits: &Limits, flag: &Arc<AtomicBool>, now: f64, step: u64) {
        self.end.set(limits.simulated_time.map(|time| now + time));
        self.steps_left.set(limits.steps);
        self.step.set(step);
        self.running.begin(flag, limits);
    }

    /// The evaluation has ended; returns the limit that has interrupted it.
    pub(crate) fn end(&self) -> Option<Limit> {
        self.end.set(None);
        self.steps_left.set(None);
        self.running.end()
    }

    /// Interrupts the evaluation from any thread.
    pub(crate) fn handle(&self) -> InterruptHandle {
        InterruptHandle(Arc::clone(&self.running))
    }

    /// The limit that has interrupted the evaluation under way.
    pub(crate) fn reached(&self) -> Option<Limit> {
        self.running.reached()
    }

    /// The time (s) until which time may pass from `now`, given a time that is waited for.
    pub(crate) fn until(&self, now: f64, until: Option<f64>) -> Option<f64> {
        match (until, self.end.get().map(|end| end.max(now))) {
            (Some(until), Some(end)) => Some(until.min(end)),
            (until, end) => until.or(end),
        }
    }

    /// To be called when time may have passed: interrupts the evaluation if it has reached a limit.
    pub(crate) fn check(&self, now: f64, step: u64) {
        // A world that is taken back counts its steps from an earlier number.
        let taken = step.saturating_sub(self.step.replace(step));
        if self.end.get().is_some_and(|end| now >= end) {
            self.reach(Limit::SimulatedTime, now);
        }
        if let Some(left) = self.steps_left.get()
            && taken > 0
        {
            self.steps_left.set(Some(left.saturating_sub(taken)));
            if taken >= left {
                self.reach(Limit::Steps, now);
            }
        }
    }

    fn reach(&self, limit: Limit, now: f64) {
        if self.running.interrupt(Some(limit)) {
            let end = self.end.get();
            self.end.set(end.map(|end| end.max(now + CLEANUP_TIME)));
            let left = self.steps_left.get();
            self.steps_left
                .set(left.map(|left| left.max(CLEANUP_STEPS)));
        }
    }
}
