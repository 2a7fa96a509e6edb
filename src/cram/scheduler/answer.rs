//! Which entries wait for what, and which are ready.

use super::Scheduler;
use super::advance::Alarm;
use super::live::{Answer, Slot, Wait};
use crate::fluent::Waiter;
use crate::host::Host;
use crate::state::Plan;
use lisp::image::Image;
use lisp::value::Value;
use std::cmp::Reverse;

impl<C: 'static> Scheduler<C> {
    /// Makes an entry wait, possibly with a time limit.
    pub(super) fn block(&mut self, slot: Slot, wait: Wait, until: Option<f64>) {
        self.last_token += 1;
        let token = self.last_token;
        let Some(live) = self.live_mut(slot) else {
            return;
        };
        let order = live.id.0;
        if let Wait::Fluent(fluent) = &wait {
            fluent.get().add_waiter(Waiter { order, slot, token });
        }
        live.wait = wait;
        live.token = token;
        live.until = until;
        if let Some(time) = until {
            self.alarms.push(Reverse(Alarm {
                time,
                order,
                slot,
                token,
            }));
        }
    }

    /// Ends an entry's wait: it runs again, with the answer, as soon as possible.
    pub(super) fn make_ready(&mut self, slot: Slot, answer: Answer) {
        self.leave_wait(slot);
        if let Some(live) = self.live_mut(slot) {
            live.answer = Some(answer);
        }
        self.enqueue(slot);
    }

    /// Ends an entry's wait and returns what it waited for.
    pub(super) fn leave_wait(&mut self, slot: Slot) -> Wait {
        let Some(live) = self.live_mut(slot) else {
            return Wait::Nothing;
        };
        let wait = std::mem::take(&mut live.wait);
        if let Wait::Fluent(fluent) = &wait {
            fluent.get().remove_waiter(live.token);
        }
        live.token = 0;
        live.until = None;
        wait
    }

    /// Abandons an entry's wait.
    pub(super) fn give_up_wait(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
    ) {
        let aside = self.live_mut(slot).and_then(|l| l.set_aside.take());
        let waits = [
            self.leave_wait(slot),
            aside.map_or(Wait::Nothing, |a| a.wait),
        ];
        for wait in waits {
            if let Wait::Ticket(ticket) = wait {
                self.tickets.retain(|(t, _)| *t != ticket);
                host.cancel(image, ticket);
                self.must_stand_still = true;
            }
        }
    }

    /// Queues an entry if it is ready and may run.
    pub(super) fn enqueue(&mut self, slot: Slot) {
        let Some(live) = self.live_mut(slot) else {
            return;
        };
        let may_run = !live.is_suspended || live.runs_hooks();
        if live.is_queued || live.answer.is_none() || !may_run {
            return;
        }
        live.is_queued = true;
        let id = live.id;
        self.ready.push_back((slot, id));
    }

    /// The next entry that is ready.
    pub(super) fn next_ready(&mut self) -> Option<Slot> {
        while let Some((slot, id)) = self.ready.pop_front() {
            let Some(live) = self.live_mut(slot) else {
                continue;
            };
            if live.id != id {
                continue;
            }
            live.is_queued = false;
            let may_run = !live.is_suspended || live.runs_hooks();
            if live.answer.is_some() && may_run {
                return Some(slot);
            }
        }
        None
    }

    /// Makes the entries ready whose fluents have changed.
    pub(super) fn collect_woken(&mut self, plan: &Plan) {
        if !plan.has_woken() {
            return;
        }
        for waiter in plan.take_woken() {
            let is_current = self
                .live(waiter.slot)
                .is_some_and(|live| live.token == waiter.token);
            if is_current {
                self.make_ready(waiter.slot, Answer::Value(Value::T));
            }
        }
    }
}
