//! Runs an entry until it waits or ends.

use super::Scheduler;
use super::group::{unwrapped, wrapped};
use super::live::{Answer, Ending, Slot, Wait};
use crate::host::Host;
use crate::journal::ActionEnd;
use crate::state::Plan;
use crate::task::Status;
use lisp::image::Image;
use lisp::value::Value;
use lisp::vm::fiber::Fiber;
use lisp::vm::machine::{Event, Machine};

/// How many times cleanup code may escape from unwinding.
const MAX_ESCAPES: u32 = 16;

/// Why an entry stopped running.
#[derive(PartialEq, Eq, Debug)]
pub(super) enum Stopped {
    /// It waits, or has ended.
    Waiting,
    /// The interrupt flag was set.
    Interrupted,
}

impl<C: 'static> Scheduler<C> {
    /// Runs an entry that is ready until it waits or ends.
    pub(super) fn run(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
    ) -> Stopped {
        let Some(live) = self.live_mut(slot) else {
            return Stopped::Waiting;
        };
        let Some(answer) = live.answer.take() else {
            return Stopped::Waiting;
        };
        let mut fiber = std::mem::take(&mut live.fiber);
        Plan::of(image).journal.set_running(live.id);
        if let Some(task) = live.task.clone()
            && task.get().status() == Status::Created
        {
            self.set_status(image, &task, Status::Running);
        }
        let mut next = Some(answer);
        while let Some(answer) = next {
            let event = match answer {
                Answer::Begin(group) => {
                    next = self.begin_some(image, slot, &fiber, group);
                    if next.is_some() && image.take_interrupt() {
                        return self.interrupt(slot, fiber, next);
                    }
                    continue;
                }
                Answer::Decide(group) => {
                    next = self.decide(image, host, slot, group);
                    continue;
                }
                Answer::Start(function, args) => {
                    Machine::new(image, &mut fiber).start(function, args)
                }
                Answer::Value(value) => Machine::new(image, &mut fiber).resume(value),
                Answer::Raise(raise) => Machine::new(image, &mut fiber).resume_with_error(raise),
                Answer::GoOn => Machine::new(image, &mut fiber).run(),
                Answer::Call(function, args) => {
                    Machine::new(image, &mut fiber).resume_with_call(function, args)
                }
                Answer::Replace {
                    frame,
                    call,
                    condition,
                } => Machine::new(image, &mut fiber).replace_frame(frame, call, condition),
                Answer::Unwind => {
                    if let Some(live) = self.live_mut(slot) {
                        live.is_unwinding = true;
                        let plan = Plan::of(image);
                        plan.journal.set_unwinding(match &live.ending {
                            Some(Ending::Failed(failure)) => {
                                ActionEnd::Failed(unwrapped(&plan, failure.clone()))
                            }
                            _ => ActionEnd::Evaporated,
                        });
                    }
                    Machine::new(image, &mut fiber).unwind_all()
                }
            };
            match event {
                Event::Output if !image.take_interrupt() => {
                    host.show_output(image);
                    next = Some(Answer::GoOn);
                }
                Event::Interrupted | Event::Output => {
                    return self.interrupt(slot, fiber, Some(Answer::GoOn));
                }
                Event::Done(value) => {
                    self.put_back(slot, fiber);
                    self.returned(image, host, slot, value);
                    return Stopped::Waiting;
                }
                Event::Unwound => {
                    self.put_back(slot, fiber);
                    self.end(image, slot);
                    return Stopped::Waiting;
                }
                Event::Unhandled(condition) => {
                    next = self.unhandled(image, slot, condition);
                }
                Event::Request(_) if self.has_escaped(slot, &fiber) => {
                    if self.may_escape(slot) {
                        next = Some(Answer::Unwind);
                        continue;
                    }
                    self.end(image, slot);
                    return Stopped::Waiting;
                }
                Event::Request(request) => {
                    self.stand_still(image, host);
                    next = self.handle(image, host, slot, &fiber, request);
                    if next.is_some() && image.take_interrupt() {
                        return self.interrupt(slot, fiber, next);
                    }
                    if next.is_some()
                        && self.is_told_to_suspend(slot)
                        && let Some(live) = self.live_mut(slot)
                    {
                        live.answer = next.take();
                    }
                }
            }
        }
        self.put_back(slot, fiber);
        self.suspend_if_told(image, host, slot);
        Stopped::Waiting
    }

    /// Stops the entry, which will go on with an answer.
    fn interrupt(&mut self, slot: Slot, fiber: Fiber, next: Option<Answer>) -> Stopped {
        self.put_back(slot, fiber);
        if let Some(live) = self.live_mut(slot) {
            live.answer = next;
        }
        self.interrupted = Some(slot);
        Stopped::Interrupted
    }

    fn put_back(&mut self, slot: Slot, fiber: Fiber) {
        if let Some(live) = self.live_mut(slot) {
            live.fiber = fiber;
        }
    }

    /// Whether the entry's cleanup code has escaped from the unwinding that called it.
    fn has_escaped(&self, slot: Slot, fiber: &Fiber) -> bool {
        self.live(slot)
            .is_some_and(|live| live.is_unwinding && fiber.pending.is_empty())
    }

    /// Counts an escape: after too many, the entry ends without the rest of its cleanup code, so
    /// that a loop around such code cannot keep it alive.
    fn may_escape(&mut self, slot: Slot) -> bool {
        self.live_mut(slot).is_some_and(|live| {
            live.escapes += 1;
            live.escapes <= MAX_ESCAPES
        })
    }

    /// Handles a condition for which the fiber has no handler.
    fn unhandled(&mut self, image: &mut Image, slot: Slot, condition: Value) -> Option<Answer> {
        let plan = Plan::of(image);
        let is_root = self.roots.contains(&slot);
        let live = self.live_mut(slot)?;
        if live.is_unwinding {
            // After an error in cleanup code, the rest of it still runs.
            return Some(Answer::Unwind);
        }
        if is_root {
            let condition = unwrapped(&plan, condition);
            self.block(slot, Wait::Debugger, None);
            if let Some(live) = self.live_mut(slot) {
                live.ending = Some(Ending::Failed(condition));
            }
            return None;
        }
        if self.may_stop(image, slot, &condition) {
            self.block(slot, Wait::Debugger, None);
            self.stops.push((slot, condition.clone()));
            self.untold_stop = Some(condition);
            return None;
        }
        let live = self.live_mut(slot)?;
        if live.ending.is_none() {
            live.ending = Some(Ending::Failed(wrapped(&plan, image, condition)));
        }
        Some(Answer::Unwind)
    }
}
