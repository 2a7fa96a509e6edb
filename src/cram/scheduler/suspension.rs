//! Suspends tasks and wakes them up.

use super::Scheduler;
use super::live::{Answer, SetAside, Slot, Told, Wait};
use super::task_start;
use crate::host::Host;
use crate::state::Plan;
use crate::task::Status;
use lisp::image::Image;
use lisp::value::Value;

impl<C: 'static> Scheduler<C> {
    /// An entry and all below it, outermost first.
    fn subtree(&self, slot: Slot) -> Vec<Slot> {
        let mut found = Vec::new();
        let mut pending = vec![slot];
        while let Some(slot) = pending.pop() {
            if let Some(live) = self.live(slot) {
                found.push(slot);
                pending.extend(live.children.iter().rev());
            }
        }
        found
    }

    /// Suspends a task and all below it. If it has not begun, it begins, and is suspended where it may
    /// first wait; what is below it and has not begun does not begin before it is woken up.
    pub(super) fn suspend(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        outermost: Slot,
    ) {
        for slot in self.subtree(outermost) {
            let Some(live) = self.live_mut(slot) else {
                continue;
            };
            if live.is_suspended || live.ending.is_some() {
                continue;
            }
            let begins = slot == outermost && matches!(live.answer, Some(Answer::Start(..)));
            if live.scheduling < 0 || begins {
                live.told = Told::Suspend;
                continue;
            }
            live.is_suspended = true;
            if let Wait::Ticket(ticket) = live.wait {
                host.pause(image, ticket);
                self.must_stand_still = true;
            }
            if let Some(live) = self.live_mut(slot)
                && !live.hooks.is_empty()
            {
                let hooks = live.hooks.clone();
                self.set_aside(image, slot, hooks);
            }
            if let Some(task) = self.live(slot).and_then(|l| l.task.clone()) {
                self.set_status(image, &task, Status::Suspended);
            }
        }
    }

    /// Suspends an entry that now waits, if it was told to earlier.
    pub(super) fn suspend_if_told(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
    ) {
        let Some(live) = self.live_mut(slot) else {
            return;
        };
        if live.told == Told::Suspend && live.scheduling >= 0 {
            live.told = Told::Nothing;
            self.suspend(image, host, slot);
        }
    }

    /// Must an entry that could go on be suspended, since it was told to earlier?
    pub(super) fn is_told_to_suspend(&self, slot: Slot) -> bool {
        self.live(slot)
            .is_some_and(|live| live.told == Told::Suspend && live.scheduling >= 0)
    }

    /// Interrupts an entry's wait to run its hooks.
    fn set_aside(&mut self, image: &Image, slot: Slot, hooks: Vec<Value>) {
        let (answer, until) = match self.live_mut(slot) {
            Some(live) => (live.answer.take(), live.until),
            None => return,
        };
        let wait = self.leave_wait(slot);
        let runner = task_start::hook_runner(&Plan::of(image), hooks);
        if let Some(live) = self.live_mut(slot) {
            live.set_aside = Some(Box::new(SetAside {
                wait,
                until,
                answer,
            }));
        }
        self.make_ready(slot, Answer::Call(runner, Vec::new()));
    }

    /// Resumes an entry's wait after its hooks have run.
    pub(super) fn resume_aside(&mut self, slot: Slot) {
        let Some(aside) = self.live_mut(slot).and_then(|l| l.set_aside.take()) else {
            return;
        };
        let aside = *aside;
        if let Some(answer) = aside.answer {
            self.make_ready(slot, answer);
            return;
        }
        match aside.wait {
            // The fluent may have changed meanwhile.
            Wait::Fluent(_) => self.make_ready(slot, Answer::Value(Value::T)),
            wait => self.block(slot, wait, aside.until),
        }
    }

    /// Wakes up a suspended task and all below it.
    pub(super) fn wake_up(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>, slot: Slot) {
        for slot in self.subtree(slot) {
            let Some(live) = self.live_mut(slot) else {
                continue;
            };
            if live.told == Told::Suspend {
                live.told = Told::Nothing;
            }
            if !live.is_suspended {
                continue;
            }
            live.is_suspended = false;
            match live.wait {
                Wait::Ticket(ticket) => host.wake(image, ticket),
                Wait::WakeUp => self.make_ready(slot, Answer::Value(Value::NIL)),
                _ => {}
            }
            if let Some(task) = self.live(slot).and_then(|l| l.task.clone()) {
                self.set_status(image, &task, Status::Running);
            }
            self.enqueue(slot);
        }
    }
}
