//! Evaluates beside a plan that an interrupt has stopped.

use super::Scheduler;
use super::live::Slot;
use super::root::Evaluation;
use crate::host::Host;
use lisp::image::Image;
use lisp::value::Value;
use lisp::vm::fiber::Fiber;

/// The report of what would have to wait.
pub(super) const STANDS_STILL: &str =
    "Time stands still after an interrupt: continue the plan, or abort it, for this.";

impl<C: 'static> Scheduler<C> {
    /// Calls a function to its end while no time passes, with the bindings of special variables that
    /// the `link`th of the [stopped fibers](Scheduler::stopped_fibers) has. What would have to wait
    /// is an error.
    pub fn call_beside(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        link: usize,
        (function, args): (Value, Vec<Value>),
    ) -> Evaluation {
        let mut beside = Scheduler {
            time_stands_still: true,
            last_id: self.last_id,
            last_token: self.last_token,
            ..Scheduler::default()
        };
        if let Some(fiber) = self.stopped_fiber_at(link) {
            fiber.enter(image);
        }
        let evaluation = beside.apply(image, host, function, args);
        if !matches!(evaluation, Evaluation::Values(_)) {
            beside.abort(image, host);
        }
        if let Some(fiber) = self.stopped_fiber_at(link) {
            fiber.leave(image);
        }
        (self.last_id, self.last_token) = (beside.last_id, beside.last_token);
        evaluation
    }

    /// The `link`th of the stopped fibers.
    pub fn stopped_fiber_at(&mut self, link: usize) -> Option<&mut Fiber> {
        let slot = self.stopped_chain().get(link).copied()?;
        self.live_mut(slot).map(|live| &mut live.fiber)
    }

    /// The entry for which the others wait, if none is running: one that waits for a motion, or else
    /// for the end of a sleep.
    pub(super) fn waited_for(&self) -> Option<Slot> {
        let moving = self.tickets.first().map(|(_, slot)| *slot);
        let slot = moving.or_else(|| self.alarms.peek().map(|alarm| alarm.0.slot));
        slot.filter(|slot| self.live(*slot).is_some())
            .or_else(|| self.roots.last().copied())
    }
}
