//! Starting a fiber, resuming it where it stopped, and stopping it again.

use crate::condition;
use crate::guard::{Stopped, stoppable_on};
use crate::source::Place;
use crate::value::Value;
use crate::value::cycles;
use crate::value::function::Body;
use crate::value::known;
use crate::value::raise::{Raise, is_interrupt};
use crate::value::release;
use crate::vm::calls::Suspended;
use crate::vm::fiber::Target;
use crate::vm::frames::{Frame, FrameKind};
use crate::vm::machine::{Event, Machine};
use crate::vm::step::Step;

/// What the machine does next.
pub(super) enum Next {
    /// Run the code of the topmost frame.
    Run,
    /// Give a value to the topmost frame.
    Deliver(Value),
    /// Stop.
    Stop(Event),
}

/// The number of calls and jumps backwards between two polls of the interrupt flag: few, since
/// builtins that take long may be among them.
pub(super) const INTERRUPT_INTERVAL: u32 = 256;

impl Machine<'_> {
    /// Starts a call in an idle fiber and runs it.
    pub fn start(&mut self, function: Value, args: Vec<Value>) -> Event {
        self.fiber.enter(self.image);
        self.go_on(|machine| machine.call_value(function, args, true))
    }

    /// Resumes the fiber with the answer to its request, or with a value in place of a failed call.
    pub fn resume(&mut self, value: Value) -> Event {
        self.fiber.enter(self.image);
        let value = if self.fiber.wants_all {
            value
        } else {
            value.primary()
        };
        self.go_on(|_| Next::Deliver(value))
    }

    /// Resumes the fiber by raising an error where it made its request.
    pub fn resume_with_error(&mut self, raise: Box<Raise>) -> Event {
        self.fiber.enter(self.image);
        if let Raise::Condition { condition, .. } = &*raise {
            let calls = self.calls();
            self.image.add_condition_calls(condition, calls);
        }
        self.go_on(|machine| machine.raise(raise))
    }

    /// Resumes the fiber with a call on top of its stack, whose value is the answer to the request
    /// or replaces the failed call.
    pub fn resume_with_call(&mut self, function: Value, args: Vec<Value>) -> Event {
        self.fiber.enter(self.image);
        let multi = self.fiber.wants_all;
        self.go_on(|machine| machine.call_value(function, args, multi))
    }

    /// Leaves a frame and all above it because of a condition, running cleanup code, and
    /// continues with a call in its place.
    pub fn replace_frame(
        &mut self,
        index: usize,
        (function, args): (Value, Vec<Value>),
        condition: Option<Value>,
    ) -> Event {
        self.fiber.enter(self.image);
        let call = Value::cons(function, Value::list(args));
        self.go_on(|machine| machine.unwind_for(Target::Frame(index), call, condition))
    }

    /// Continues after an interrupt.
    pub fn run(&mut self) -> Event {
        self.fiber.enter(self.image);
        let undelivered = self.fiber.undelivered.take();
        self.go_on(|_| undelivered.map_or(Next::Run, Next::Deliver))
    }

    /// Unwinds the whole fiber, running its cleanup code.
    pub fn unwind_all(&mut self) -> Event {
        self.fiber.enter(self.image);
        self.fiber.undelivered = None;
        self.go_on(|machine| machine.unwind(Target::Everything, Value::NIL))
    }

    /// Runs until the machine stops. Rust functions that work long may be left on the way.
    fn go_on(&mut self, begin: impl FnOnce(&mut Self) -> Next) -> Event {
        let _watch = self.image.limits.watch();
        self.image.wants_all = true;
        let leave = |machine: &mut Self| machine.fiber.leave(machine.image);
        let first = |machine: &mut Self| {
            let next = begin(machine);
            machine.run_on(next)
        };
        let mut outcome = stoppable_on(self, first, leave);
        loop {
            match outcome {
                Ok(event) => {
                    if !matches!(event, Event::Output) {
                        self.fiber.leave(self.image);
                    }
                    // A program may make requests so often that it never comes to a pause.
                    self.tidy();
                    return event;
                }
                Err(reason) => {
                    let next = |machine: &mut Self| {
                        let next = machine.left(reason);
                        machine.run_on(next)
                    };
                    outcome = stoppable_on(self, next, leave);
                }
            }
        }
    }

    fn run_on(&mut self, mut next: Next) -> Event {
        let mut budget = INTERRUPT_INTERVAL;
        loop {
            // Code that calls builtins that call code passes here more often than it jumps back.
            budget -= 1;
            if budget == 0 {
                next = self.or_interrupt(next, &mut budget);
            }
            next = match next {
                Next::Run => self.run_code(&mut budget),
                Next::Deliver(value) => self.deliver(value),
                Next::Stop(event) => return event,
            };
        }
    }

    /// What to do when a builtin was left. The call cannot go on, and no handler is asked about
    /// an interrupt.
    fn left(&mut self, reason: Stopped) -> Next {
        self.fiber.stack.clear_above();
        self.image.wants_all = true;
        let raise = Box::<Raise>::from(reason);
        if reason != Stopped::Interrupted {
            return self.raise(raise);
        }
        match condition::make(self.image, &raise) {
            Ok(condition) => self.stop_interrupted(condition),
            Err(_) => Next::Stop(Event::Interrupted),
        }
    }

    /// Stops at an interrupt that came in the middle of a call.
    pub(super) fn stop_interrupted(&mut self, condition: Value) -> Next {
        let place = self.place();
        self.note_place(&condition, place);
        self.fiber.wants_all = false;
        Next::Stop(Event::Unhandled(condition))
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
            Step::Unhandled(condition) if self.has_debugger_hook(&condition) => {
                let call = Step::tail_call(known::SYS_CALL_DEBUGGER_HOOK, vec![condition]);
                self.take_step(call, multi)
            }
            Step::Unhandled(condition) => {
                self.fiber.wants_all = multi;
                Next::Stop(Event::Unhandled(condition))
            }
        }
    }

    /// Is there a function to call instead of stopping? An interruption stops in any case.
    fn has_debugger_hook(&self, condition: &Value) -> bool {
        self.image.special(known::V_DEBUGGER_HOOK).is_true() && !is_interrupt(condition)
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

    /// The next step; if the budget is used up, that may be to stop, and there is a new budget.
    pub(super) fn or_interrupt(&mut self, next: Next, budget: &mut u32) -> Next {
        if *budget > 0 {
            return next;
        }
        *budget = INTERRUPT_INTERVAL;
        if matches!(next, Next::Stop(_)) {
            return next;
        }
        let Some(stop) = self.pause() else {
            return next;
        };
        if let (Next::Deliver(value), Next::Stop(Event::Interrupted | Event::Output)) =
            (next, &stop)
        {
            self.fiber.undelivered = Some(value);
        }
        stop
    }

    /// Looks whether there is a reason not to go on, once in a while.
    pub(super) fn pause(&mut self) -> Option<Next> {
        self.tidy();
        match self.image.limits.reason() {
            Some(Stopped::Interrupted) => Some(Next::Stop(Event::Interrupted)),
            Some(Stopped::HeapExhausted) if !self.frees_enough() => {
                Some(self.raise(Stopped::HeapExhausted.into()))
            }
            Some(Stopped::HeapExhausted | Stopped::TooLong) | None => {
                // What stands on a line that is not whole is shown as well.
                self.image.output.finish();
                let is_due = self.image.output.is_due();
                is_due.then_some(Next::Stop(Event::Output))
            }
        }
    }

    /// Frees some of what has been put off, and circles if that is due.
    fn tidy(&mut self) {
        release::some();
        let in_use = self.image.limits.heap.in_use();
        cycles::collect_if_due(&mut self.image.symbols, in_use);
    }

    /// Frees what has been put off, and circles of symbols, too, which only the machine can free; is
    /// there room enough for some time then?
    fn frees_enough(&mut self) -> bool {
        cycles::collect_all(Some(&mut self.image.symbols));
        release::all();
        self.image.limits.heap.has_room()
    }

    pub(super) fn save_pc(&mut self, new: usize) {
        if let Some(Frame {
            kind: FrameKind::Code { pc, .. },
            ..
        }) = self.fiber.frames.last()
        {
            pc.set(new);
        }
    }

    /// The source place of the call being executed: that of the innermost frame that has one.
    pub fn place(&self) -> Place {
        self.fiber
            .frames
            .iter()
            .rev()
            .find_map(|frame| match &frame.kind {
                FrameKind::Code { function, pc } => match &function.body {
                    Body::Closure { code, .. } => {
                        let place = code.place_at(pc.get().saturating_sub(1));
                        self.image.sources.is_of_program(place).then_some(place)
                    }
                    _ => None,
                },
                FrameKind::Native { .. } | FrameKind::Over => None,
            })
            .unwrap_or(Place::NONE)
    }
}
