//! Evaluates forms at the prompt.

use super::Scheduler;
use super::advance::Passed;
use super::beside::STANDS_STILL;
use super::live::{Answer, Ending, Live, Slot, Wait};
use super::run::Stopped;
use crate::host::Host;
use crate::state::Plan;
use crate::task::Status;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

/// How an evaluation ended, or why it stopped.
pub enum Evaluation {
    /// It has ended with these values.
    Values(Vec<Value>),
    /// A condition was not handled. The evaluation stays where it is until [`Scheduler::call`] or
    /// [`Scheduler::abort`].
    Unhandled(Value),
    /// It was interrupted; continue with [`Scheduler::go_on`] or [`Scheduler::abort`].
    Interrupted,
}

impl<C: 'static> Scheduler<C> {
    /// Evaluates a form at top level, to its end. An earlier evaluation that has stopped stays
    /// stopped, and this one runs on top of it.
    pub fn evaluate(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        form: &Value,
    ) -> Evaluation {
        self.apply(image, host, known::EVAL.into(), vec![form.clone()])
    }

    /// Calls a function at top level, like [`Scheduler::evaluate`].
    pub fn apply(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        function: Value,
        args: Vec<Value>,
    ) -> Evaluation {
        let id = self.next_id();
        let mut live = Live::new(id, Answer::Start(function, args));
        live.fiber = self.idle.take().unwrap_or_default();
        let slot = self.add(live);
        self.roots.push(slot);
        self.enqueue(slot);
        self.go_on(image, host)
    }

    /// Continues after an interrupt.
    pub fn go_on(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>) -> Evaluation {
        if let Some(slot) = self.interrupted.take()
            && let Some(live) = self.live_mut(slot)
        {
            live.is_queued = true;
            let id = live.id;
            self.ready.push_front((slot, id));
        }
        let Some(root) = self.roots.last().copied() else {
            return Evaluation::Values(Vec::new());
        };
        loop {
            if let Some(condition) = self.untold_stop.take() {
                return Evaluation::Unhandled(condition);
            }
            if let Some(evaluation) = self.ended(image, host, root) {
                return evaluation;
            }
            match self.turn(image, host) {
                Turn::Done => {}
                Turn::Interrupted => return Evaluation::Interrupted,
                Turn::Stuck => self.stuck(image, host, root),
            }
        }
    }

    /// Continues with a call on top of the evaluation that stopped last: its value replaces that of
    /// the failed call, unless it leaves that call (as a restart's function does).
    pub fn call(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        function: Value,
        args: Vec<Value>,
    ) -> Evaluation {
        if let Some(slot) = self.leave_stop() {
            self.make_ready(slot, Answer::Call(function, args));
        }
        self.go_on(image, host)
    }

    /// Abandons the evaluation that stopped last: its tasks end first, then its own cleanup code
    /// runs, which may take simulated time. An interrupt cuts that short.
    pub fn abort(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>) {
        let Some(root) = self.roots.last().copied() else {
            return;
        };
        if let Some(slot) = self.interrupted.take() {
            // An interrupted entry may unwind like a waiting one.
            if let Some(live) = self.live_mut(slot) {
                live.answer = None;
            }
        }
        self.evaporate_children(image, host, root);
        self.drain(image, host, root);
        if let Some(live) = self.live_mut(root) {
            let ending = live.ending.replace(Ending::Evaporated);
            let (status, result) = match ending {
                Some(Ending::Failed(condition)) => (Status::Failed, condition),
                _ => (Status::Evaporated, Value::NIL),
            };
            let (id, plan) = (live.id, Plan::of(image));
            plan.journal.end_top_level(id, status, result, plan.now());
        }
        self.give_up_wait(image, host, root);
        self.make_ready(root, Answer::Unwind);
        while self.is_unfinished(root) {
            match self.turn(image, host) {
                Turn::Done => {}
                Turn::Interrupted | Turn::Stuck => break,
            }
        }
        self.evaporate_children(image, host, root);
        self.drain(image, host, root);
        self.stand_still(image, host);
        self.discard(root);
        self.stops.clear();
        self.untold_stop = None;
    }

    /// The number of evaluations that have stopped and have not been abandoned.
    #[cfg(test)]
    pub fn depth(&self) -> usize {
        self.roots.len()
    }

    /// One step: an entry runs, or time passes.
    fn turn(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>) -> Turn {
        if image.take_interrupt() {
            return Turn::Interrupted;
        }
        self.stand_still(image, host);
        let plan = Plan::of(image);
        self.collect_woken(&plan);
        let passed = match self.next_ready() {
            Some(slot) => {
                return match self.run(image, host, slot) {
                    Stopped::Waiting => Turn::Done,
                    Stopped::Interrupted => Turn::Interrupted,
                };
            }
            None => self.pass_time(&plan, image, host),
        };
        match passed {
            Passed::Something => Turn::Done,
            Passed::Nothing if image.take_interrupt() => Turn::Interrupted,
            Passed::Nothing => Turn::Stuck,
        }
    }

    /// The result of the root's evaluation, if it has ended.
    fn ended(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        root: Slot,
    ) -> Option<Evaluation> {
        let live = self.live(root)?;
        if matches!(live.wait, Wait::Debugger) {
            let condition = match &live.ending {
                Some(Ending::Failed(condition)) => condition.clone(),
                _ => Value::NIL,
            };
            self.evaporate_children(image, host, root);
            self.drain(image, host, root);
            self.stand_still(image, host);
            return Some(Evaluation::Unhandled(condition));
        }
        if self.is_unfinished(root) {
            return None;
        }
        self.stand_still(image, host);
        let live = self.discard(root)?;
        self.idle = live.fiber.idle();
        let value = match live.ending {
            Some(Ending::Succeeded(value)) => value,
            _ => Value::values(Vec::new()),
        };
        let plan = Plan::of(image);
        let first = value.clone().into_values().into_iter().next();
        let (result, now) = (first.unwrap_or_default(), plan.now());
        plan.journal
            .end_top_level(live.id, Status::Succeeded, result, now);
        Some(Evaluation::Values(value.into_values()))
    }

    fn is_unfinished(&self, root: Slot) -> bool {
        self.live(root).is_some_and(|live| {
            live.ending.is_none()
                || !live.children.is_empty()
                || live.answer.is_some()
                || !matches!(live.wait, Wait::Nothing)
        })
    }

    fn discard(&mut self, root: Slot) -> Option<Box<Live>> {
        self.roots.retain(|r| *r != root);
        self.remove(root)
    }

    /// Runs until the children of a root, which have all been told to end, have ended.
    pub(super) fn drain(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>, root: Slot) {
        while self.live(root).is_some_and(|l| !l.children.is_empty()) {
            match self.turn(image, host) {
                Turn::Done => {}
                // Cleanup code that was interrupted, or that would wait for ever, is cut short.
                Turn::Interrupted | Turn::Stuck => {
                    self.interrupted = None;
                    if !self.bury(image, host) {
                        return;
                    }
                }
            }
        }
    }

    /// Nothing can continue: buries dying tasks, or else reports the last stop again, or else the
    /// deadlock to the root.
    fn stuck(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>, root: Slot) {
        if self.bury(image, host) || self.tell_stop_again() {
            return;
        }
        let text = if self.time_stands_still {
            STANDS_STILL.to_owned()
        } else {
            self.describe_deadlock(image)
        };
        self.evaporate_children(image, host, root);
        self.give_up_wait(image, host, root);
        self.make_ready(root, Answer::Raise(Raise::simple(text)));
    }
}

enum Turn {
    Done,
    Interrupted,
    Stuck,
}
