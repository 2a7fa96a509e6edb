//! Starting a fiber, resuming it where it stopped, and stopping it again.

use crate::lisp::source::Place;
use crate::lisp::value::Value;
use crate::lisp::value::function::Body;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::calls::Suspended;
use crate::lisp::vm::fiber::{Frame, FrameKind};
use crate::lisp::vm::machine::{Event, Machine};
use crate::lisp::vm::step::Step;

/// What the machine does next.
pub(super) enum Next {
    /// Run the code of the topmost frame.
    Run,
    /// Give a value to the topmost frame.
    Deliver(Value),
    /// Stop.
    Stop(Event),
}

/// The number of operations between two polls of the interrupt flag.
pub(super) const INTERRUPT_INTERVAL: u32 = 4096;

impl Machine<'_> {
    /// Starts a call in an idle fiber and runs it.
    pub(crate) fn start(&mut self, function: Value, args: Vec<Value>) -> Event {
        self.fiber.enter(self.image);
        let next = self.call_value(function, args, true);
        self.go_on(next)
    }

    /// Resumes the fiber with the answer to its request, or with a value in place of a failed call.
    pub(crate) fn resume(&mut self, value: Value) -> Event {
        self.fiber.enter(self.image);
        let value = if self.fiber.wants_all {
            value
        } else {
            value.primary()
        };
        self.go_on(Next::Deliver(value))
    }

    /// Resumes the fiber by raising an error where it made its request.
    pub(crate) fn resume_with_error(&mut self, raise: Box<Raise>) -> Event {
        self.fiber.enter(self.image);
        if let Raise::Condition { condition, .. } = &*raise {
            let calls = self.calls();
            self.image.add_condition_calls(condition, calls);
        }
        let next = self.raise(raise);
        self.go_on(next)
    }

    /// Resumes the fiber with a call on top of its stack, whose value is the answer to the request
    /// or replaces the failed call.
    pub(crate) fn resume_with_call(&mut self, function: Value, args: Vec<Value>) -> Event {
        self.fiber.enter(self.image);
        let multi = self.fiber.wants_all;
        let next = self.call_value(function, args, multi);
        self.go_on(next)
    }

    /// Leaves a frame and all above it, running cleanup code, and continues with a call in its
    /// place.
    pub(crate) fn replace_frame(
        &mut self,
        index: usize,
        function: Value,
        args: Vec<Value>,
    ) -> Event {
        self.fiber.enter(self.image);
        let call = Value::cons(function, Value::list(args));
        let next = self.unwind(crate::lisp::vm::fiber::Target::Frame(index), call);
        self.go_on(next)
    }

    /// Continues after an interrupt.
    pub(crate) fn run(&mut self) -> Event {
        self.fiber.enter(self.image);
        let undelivered = self.fiber.undelivered.take();
        self.go_on(undelivered.map_or(Next::Run, Next::Deliver))
    }

    /// Unwinds the whole fiber, running its cleanup code.
    pub(crate) fn unwind_all(&mut self) -> Event {
        self.fiber.enter(self.image);
        self.fiber.undelivered = None;
        let next = self.unwind(crate::lisp::vm::fiber::Target::Everything, Value::NIL);
        self.go_on(next)
    }

    fn go_on(&mut self, mut next: Next) -> Event {
        let mut budget = INTERRUPT_INTERVAL;
        loop {
            // Code that calls builtins that call code passes here more often than it jumps back.
            budget -= 1;
            if budget == 0 {
                next = self.or_interrupt(next, budget);
                budget = INTERRUPT_INTERVAL;
            }
            next = match next {
                Next::Run => self.run_code(),
                Next::Deliver(value) => self.deliver(value),
                Next::Stop(event) => {
                    self.fiber.leave(self.image);
                    return event;
                }
            };
        }
    }

    fn deliver(&mut self, value: Value) -> Next {
        match self.fiber.frames.last() {
            None => Next::Stop(Event::Done(value)),
            Some(Frame {
                kind: FrameKind::Code { .. },
                ..
            }) => {
                self.fiber.stack.push(value);
                Next::Run
            }
            Some(_) => self.deliver_to_native(value),
        }
    }

    fn deliver_to_native(&mut self, value: Value) -> Next {
        let Some(Frame {
            kind: FrameKind::Native { then, all },
            multi,
            ..
        }) = self.fiber.frames.pop()
        else {
            return Next::Run;
        };
        let value = if all { value } else { value.primary() };
        match then.resume(self, value) {
            Ok(step) => self.take_step(step, multi),
            Err(raise) => self.raise(raise),
        }
    }

    /// Carries out the step that a control builtin returned.
    pub(super) fn take_step(&mut self, step: Step, multi: bool) -> Next {
        match step {
            Step::Return(value) => Next::Deliver(if multi { value } else { value.primary() }),
            Step::Call {
                function,
                args,
                all,
                then,
            } => {
                self.push_native(then, all, multi);
                self.call_value(function, args, all)
            }
            Step::TailCall { function, args } => self.call_value(function, args, multi),
            Step::Request(request) => {
                self.fiber.wants_all = multi;
                Next::Stop(Event::Request(request))
            }
            Step::RequestThen(request, then) => {
                self.fiber.wants_all = true;
                self.push_native(then, true, multi);
                Next::Stop(Event::Request(request))
            }
            Step::Unwind(target, value) => self.unwind(target, value),
            Step::Unhandled(condition) => {
                self.fiber.wants_all = multi;
                Next::Stop(Event::Unhandled(condition))
            }
        }
    }

    fn push_native(&mut self, then: Box<Suspended>, all: bool, multi: bool) {
        let height = self.fiber.stack.len();
        self.fiber.frames.push(Frame {
            kind: FrameKind::Native { then, all },
            base: height,
            cut: height,
            dynamic: self.fiber.dynamic.len(),
            multi,
        });
    }

    /// The next step, which is to stop if the budget is used up and an interrupt is pending.
    pub(super) fn or_interrupt(&mut self, next: Next, budget: u32) -> Next {
        if budget > 0 || matches!(next, Next::Stop(_)) || !self.is_interrupted() {
            return next;
        }
        if let Next::Deliver(value) = next {
            self.fiber.undelivered = Some(value);
        }
        Next::Stop(Event::Interrupted)
    }

    pub(super) fn is_interrupted(&self) -> bool {
        self.image.take_interrupt()
    }

    pub(super) fn save_pc(&mut self, new: usize) {
        if let Some(Frame {
            kind: FrameKind::Code { pc, .. },
            ..
        }) = self.fiber.frames.last_mut()
        {
            *pc = new;
        }
    }

    /// The source place of the call being executed: that of the innermost frame that has one.
    pub(crate) fn place(&self) -> Place {
        self.fiber
            .frames
            .iter()
            .rev()
            .find_map(|frame| match &frame.kind {
                FrameKind::Code { function, pc } => match &function.body {
                    Body::Closure { code, .. } => {
                        let place = code.place_at(pc.saturating_sub(1));
                        self.image.sources.is_of_program(place).then_some(place)
                    }
                    _ => None,
                },
                FrameKind::Native { .. } => None,
            })
            .unwrap_or(Place::NONE)
    }
}
