//! Advances simulated time while every task waits.

use std::cmp::Ordering;

use super::Scheduler;
use super::live::{Answer, Slot, Wait};
use crate::companion;
use crate::host::{Advance, Host};
use crate::state::Plan;
use lisp::image::Image;
use lisp::value::Value;

/// The end of a sleep or of a timeout.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Alarm {
    /// In simulated seconds.
    pub time: f64,
    /// Creation order of the entry that waits.
    pub order: u64,
    pub slot: Slot,
    /// Identifies the wait that it belongs to.
    pub token: u64,
}

impl Eq for Alarm {}

impl Ord for Alarm {
    fn cmp(&self, other: &Alarm) -> Ordering {
        self.time
            .total_cmp(&other.time)
            .then(self.order.cmp(&other.order))
            .then(self.token.cmp(&other.token))
    }
}

impl PartialOrd for Alarm {
    fn partial_cmp(&self, other: &Alarm) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The result of letting time pass.
#[derive(PartialEq, Eq, Debug)]
pub(super) enum Passed {
    /// Something happened, or may have.
    Something,
    /// There is nothing left to wait for.
    Nothing,
}

impl<C: 'static> Scheduler<C> {
    /// Lets time pass until something happens that a task waits for.
    pub(super) fn pass_time(
        &mut self,
        plan: &Plan,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
    ) -> Passed {
        if self.time_stands_still {
            return Passed::Nothing;
        }
        let alarm = self.next_alarm();
        let until = alarm.into_iter().chain(companion::next_call(plan));
        let until = until.min_by(f64::total_cmp);
        let now = plan.now();
        let advance = if self.tickets.is_empty() {
            let Some(until) = until else {
                return Passed::Nothing;
            };
            Advance {
                now: host.idle(image, now, until.max(now)),
                done: Vec::new(),
            }
        } else {
            host.advance(image, now, until)
        };
        let passed = self.take_in(plan, advance);
        if self.call_companions(image, host) {
            return Passed::Something;
        }
        passed
    }

    /// Lets time pass until what has been cancelled or paused has come to a stop, so that nobody
    /// acts on the place of a robot that still moves.
    pub(super) fn stand_still(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>) {
        if std::mem::take(&mut self.must_stand_still) {
            let plan = Plan::of(image);
            let advance = host.stand_still(image, plan.now());
            self.take_in(&plan, advance);
        }
    }

    /// Wakes the entries that have waited for what happened.
    fn take_in(&mut self, plan: &Plan, advance: Advance) -> Passed {
        let now = plan.now();
        let reached = now.max(advance.now);
        let mut woken: Vec<(f64, u64, Slot, Answer)> = Vec::new();
        for (ticket, outcome) in advance.done {
            let Some(i) = self.tickets.iter().position(|(t, _)| *t == ticket) else {
                continue;
            };
            let (_, slot) = self.tickets.remove(i);
            let answer = match outcome {
                Ok(value) => Answer::Value(value),
                Err(raise) => Answer::Raise(raise),
            };
            let order = self.live(slot).map_or(0, |l| l.id.0);
            woken.push((reached, order, slot, answer));
        }
        let stands_still = reached <= now && woken.is_empty();
        plan.set_now(reached);
        while let Some(alarm) = self.alarms.peek().map(|a| a.0) {
            if alarm.time > reached {
                break;
            }
            self.alarms.pop();
            if self.is_current(&alarm) {
                let answer = Answer::Value(Value::NIL);
                woken.push((alarm.time, alarm.order, alarm.slot, answer));
            }
        }
        if woken.is_empty() && stands_still {
            return Passed::Nothing;
        }
        woken.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (_, _, slot, answer) in woken {
            self.finish_wait(slot, answer);
        }
        Passed::Something
    }

    /// Answers the wait of an entry, which hooks may have set aside.
    fn finish_wait(&mut self, slot: Slot, answer: Answer) {
        match self.live_mut(slot) {
            Some(live) if matches!(live.wait, Wait::Ticket(_)) || live.set_aside.is_none() => {
                self.make_ready(slot, answer);
            }
            Some(live) if live.until.is_some() => self.make_ready(slot, answer),
            Some(live) => {
                if let Some(aside) = &mut live.set_aside {
                    aside.wait = Wait::Nothing;
                    aside.answer = Some(answer);
                }
            }
            None => {}
        }
    }

    /// The time of the next alarm whose wait is not over.
    fn next_alarm(&mut self) -> Option<f64> {
        while let Some(alarm) = self.alarms.peek().map(|a| a.0) {
            if self.is_current(&alarm) {
                return Some(alarm.time);
            }
            self.alarms.pop();
        }
        None
    }

    fn is_current(&self, alarm: &Alarm) -> bool {
        self.live(alarm.slot)
            .is_some_and(|live| live.token == alarm.token)
    }
}
