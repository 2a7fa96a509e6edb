//! The machine: one fiber running on one image.
//!
//! Calls of Lisp functions never recurse on the Rust stack. The machine stops when the
//! fiber is done, when a builtin makes a request to whoever runs the fiber, when a
//! condition has found no handler (the stack is still there), or on an interrupt.

use std::any::Any;
use std::rc::Rc;
use std::sync::atomic::Ordering;

use super::calls::Suspended;
use super::code::{Capture, Code, Op};
use super::fiber::{Dynamic, Fiber, Frame, FrameKind, Handler};
use super::step::Step;
use crate::lisp::image::Image;
use crate::lisp::library;
use crate::lisp::object;
use crate::lisp::source::Place;
use crate::lisp::value::Value;
use crate::lisp::value::function::{Body, Function, NativeCall};
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::slot::Slot;
use crate::lisp::value::symbol::{FunctionCell, Sym};

/// A fiber that runs on an image.
pub(crate) struct Machine<'a> {
    /// The image.
    pub(crate) image: &'a mut Image,
    /// The fiber.
    pub(crate) fiber: &'a mut Fiber,
}

/// Why the machine stopped.
pub(crate) enum Event {
    /// The fiber's function returned (`Value::Multiple` unless exactly one value).
    Done(Value),
    /// A builtin made a request; `resume` with the answer.
    Request(Box<dyn Any>),
    /// A condition was signalled by `error` and no handler took it. The fiber can be
    /// resumed with a value in place of the failed call, or unwound.
    Unhandled(Value),
    /// The interrupt flag was set; `run` goes on.
    Interrupted,
    /// An unwinding of everything has ended.
    Unwound,
}

/// How the machine goes on.
pub(super) enum Next {
    /// Run the code of the topmost frame.
    Run,
    /// Give a value to the topmost frame.
    Deliver(Value),
    /// Stop.
    Stop(Event),
}

/// Calls that may be open at once.
const MOST_FRAMES: usize = 1_000_000;
/// Calls beyond that limit for the handlers of the error that it causes.
const SPARE_FRAMES: usize = 10_000;
/// Operations between two looks at the interrupt flag.
const INTERRUPT_INTERVAL: u32 = 4096;

impl<'a> Machine<'a> {
    /// A machine for a fiber.
    pub(crate) fn new(image: &'a mut Image, fiber: &'a mut Fiber) -> Machine<'a> {
        Machine { image, fiber }
    }

    /// Starts a call in a fiber that does nothing yet, and runs it.
    pub(crate) fn start(&mut self, function: Value, args: Vec<Value>) -> Event {
        self.fiber.enter(self.image);
        let next = self.call_value(function, args, true);
        self.go_on(next)
    }

    /// Gives the answer to a request, or a value in place of a failed call, and goes on.
    pub(crate) fn resume(&mut self, value: Value) -> Event {
        self.fiber.enter(self.image);
        let value = if self.fiber.wants_all {
            value
        } else {
            value.primary()
        };
        self.go_on(Next::Deliver(value))
    }

    /// Raises an error where a request was made, and goes on.
    pub(crate) fn resume_with_error(&mut self, raise: Box<Raise>) -> Event {
        self.fiber.enter(self.image);
        if let Raise::Condition(condition) = &*raise {
            let calls = self.calls();
            self.image.add_condition_calls(condition, calls);
        }
        let next = self.raise(raise);
        self.go_on(next)
    }

    /// Goes on with a call on top of whatever the fiber does; its value is the answer to
    /// the request, or stands in place of the failed call.
    pub(crate) fn resume_with_call(&mut self, function: Value, args: Vec<Value>) -> Event {
        self.fiber.enter(self.image);
        let multi = self.fiber.wants_all;
        let next = self.call_value(function, args, multi);
        self.go_on(next)
    }

    /// Leaves a frame and all above it, running cleanup code, and goes on with a call in its
    /// place.
    pub(crate) fn replace_frame(
        &mut self,
        index: usize,
        function: Value,
        args: Vec<Value>,
    ) -> Event {
        self.fiber.enter(self.image);
        let call = Value::cons(function, Value::list(args));
        let next = self.unwind(super::fiber::Target::Frame(index), call);
        self.go_on(next)
    }

    /// Goes on after an interrupt.
    pub(crate) fn run(&mut self) -> Event {
        self.fiber.enter(self.image);
        let undelivered = self.fiber.undelivered.take();
        self.go_on(undelivered.map_or(Next::Run, Next::Deliver))
    }

    /// Unwinds the whole fiber, running its cleanup code.
    pub(crate) fn unwind_all(&mut self) -> Event {
        self.fiber.enter(self.image);
        self.fiber.undelivered = None;
        let next = self.unwind(super::fiber::Target::Everything, Value::NIL);
        self.go_on(next)
    }

    fn go_on(&mut self, mut next: Next) -> Event {
        let mut budget = INTERRUPT_INTERVAL;
        loop {
            // Code that calls builtins that call code is here more often than it jumps back.
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

    /// Does what a control builtin said.
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

    /// Calls a function, or the function of a symbol, with arguments in a vector.
    pub(super) fn call_value(&mut self, function: Value, args: Vec<Value>, multi: bool) -> Next {
        let function = match self.image.coerce_to_function(&function) {
            Ok(f) => f,
            Err(raise) => return self.raise(raise),
        };
        let cut = self.fiber.stack.len();
        match &function.body {
            Body::Native(native) => {
                if args.len() < usize::from(native.min)
                    || native.max.is_some_and(|max| args.len() > usize::from(max))
                {
                    return self.raise(wrong_count(args.len()));
                }
                match native.call.clone() {
                    NativeCall::Pure(f) => match f(self.image, &args) {
                        Ok(value) => Next::Deliver(if multi { value } else { value.primary() }),
                        Err(raise) => self.raise(raise),
                    },
                    NativeCall::Made(f) => match f(self.image, &args) {
                        Ok(value) => Next::Deliver(if multi { value } else { value.primary() }),
                        Err(raise) => self.raise(raise),
                    },
                    NativeCall::Control(f) => match f(self, args) {
                        Ok(step) => self.take_step(step, multi),
                        Err(raise) => self.raise(raise),
                    },
                    NativeCall::MadeControl(f) => match f(self, args) {
                        Ok(step) => self.take_step(step, multi),
                        Err(raise) => self.raise(raise),
                    },
                }
            }
            Body::Generic(_) => match object::dispatch::call_generic(self, &function, args) {
                Ok(step) => self.take_step(step, multi),
                Err(raise) => self.raise(raise),
            },
            Body::Deferred(deferred) => match library::deferred::force(self.image, deferred) {
                Ok(function) => self.call_value(Value::Function(function), args, multi),
                Err(raise) => self.raise(raise),
            },
            Body::Closure { code, .. } => {
                let code = code.clone();
                let count = args.len();
                self.fiber.stack.extend(args);
                match self.enter_closure(function, &code, count, cut, multi) {
                    Ok(()) => Next::Run,
                    Err(raise) => {
                        self.fiber.stack.truncate(cut);
                        self.raise(raise)
                    }
                }
            }
        }
    }

    /// Enters a closure whose arguments are on the stack.
    fn enter_closure(
        &mut self,
        function: Rc<Function>,
        code: &Rc<Code>,
        count: usize,
        cut: usize,
        multi: bool,
    ) -> Result<(), Box<Raise>> {
        let frames = self.fiber.frames.len();
        if frames >= MOST_FRAMES {
            self.check_depth(frames)?;
        }
        let parameters = &code.parameters;
        if parameters.is_simple() {
            if count != usize::from(parameters.required) {
                return Err(wrong_count(count));
            }
        } else {
            self.arrange_arguments(code, count)?;
        }
        let slots = code.parameters.slots();
        self.fiber.frames.push(Frame {
            kind: FrameKind::Code { function, pc: 0 },
            base: self.fiber.stack.len() - slots,
            cut,
            dynamic: self.fiber.dynamic.len(),
            multi,
        });
        Ok(())
    }

    fn check_depth(&self, frames: usize) -> Result<(), Box<Raise>> {
        let handling = self
            .fiber
            .dynamic
            .iter()
            .any(|d| matches!(d, Dynamic::HandlerMask(_) | Dynamic::Unwind { .. }));
        let limit = MOST_FRAMES + if handling { SPARE_FRAMES } else { 0 };
        if frames < limit {
            return Ok(());
        }
        Err(Raise::new(
            known::CONTROL_STACK_EXHAUSTED,
            format!(
                "Control stack exhausted: {MOST_FRAMES} calls are open. Is there a recursion that never ends?"
            ),
        ))
    }

    /// Brings arguments on the stack into the order of the parameters' slots.
    fn arrange_arguments(&mut self, code: &Code, count: usize) -> Result<(), Box<Raise>> {
        let parameters = &code.parameters;
        let required = usize::from(parameters.required);
        let optional = usize::from(parameters.optional);
        let positional = required + optional;
        let takes_more = parameters.rest || parameters.has_keys;
        if count < required || (count > positional && !takes_more) {
            return Err(wrong_count(count));
        }
        let stack = &mut self.fiber.stack;
        let start = stack.len() - count;
        if count < positional {
            stack.resize(start + positional, Value::Unbound);
            if parameters.rest {
                stack.push(Value::NIL);
            }
            stack.resize(stack.len() + parameters.keys.len(), Value::Unbound);
            return Ok(());
        }
        let more: Vec<Value> = stack.drain(start + positional..).collect();
        if parameters.has_keys {
            check_keywords(self.image, code, &more)?;
        }
        let stack = &mut self.fiber.stack;
        if parameters.rest {
            stack.push(Value::list(more.iter().cloned()));
        }
        for key in &parameters.keys {
            let value = more
                .chunks_exact(2)
                .find(|pair| pair[0].as_symbol() == Some(*key))
                .map_or(Value::Unbound, |pair| pair[1].clone());
            stack.push(value);
        }
        Ok(())
    }

    fn run_code(&mut self) -> Next {
        let mut budget = INTERRUPT_INTERVAL;
        loop {
            // Registers of the topmost frame.
            let Some(frame) = self.fiber.frames.last() else {
                return Next::Run;
            };
            let FrameKind::Code { function, pc } = &frame.kind else {
                return Next::Run;
            };
            let Body::Closure { code, .. } = &function.body else {
                return Next::Run;
            };
            let function = function.clone();
            let code = code.clone();
            let captured: &[Value] = match &function.body {
                Body::Closure { captured, .. } => captured,
                _ => &[],
            };
            let mut pc = *pc;
            let base = frame.base;

            macro_rules! fail {
                ($raise:expr) => {{
                    self.save_pc(pc);
                    return self.raise($raise);
                }};
            }
            macro_rules! check {
                ($result:expr) => {
                    match $result {
                        Ok(value) => value,
                        Err(raise) => fail!(raise),
                    }
                };
            }
            macro_rules! pop {
                () => {
                    self.fiber.stack.pop().unwrap_or_default()
                };
            }
            macro_rules! binary {
                ($operation:expr) => {{
                    let b = pop!();
                    let a = pop!();
                    let value = check!($operation(&a, &b));
                    self.fiber.stack.push(value);
                }};
            }
            macro_rules! compare {
                ($fast:tt, $slow:expr) => {{
                    let b = pop!();
                    let a = pop!();
                    let holds = match (&a, &b) {
                        (Value::Int(x), Value::Int(y)) => x $fast y,
                        _ => check!($slow(&a, &b)),
                    };
                    self.fiber.stack.push(Value::bool(holds));
                }};
            }

            'code: loop {
                // The emitter ends every function with a return, so there is an operation.
                let op = code.ops[pc];
                pc += 1;
                match op {
                    Op::Const(i) => self.fiber.stack.push(code.constants[i as usize].clone()),
                    Op::Nil => self.fiber.stack.push(Value::NIL),
                    Op::Int(n) => self.fiber.stack.push(Value::Int(i64::from(n))),
                    Op::Local(i) => {
                        let value = self.fiber.stack[base + i as usize].clone();
                        self.fiber.stack.push(value);
                    }
                    Op::LocalBox(i) => {
                        let value = unbox(&self.fiber.stack[base + i as usize]);
                        self.fiber.stack.push(value);
                    }
                    Op::SetLocal(i) => {
                        let value = pop!();
                        self.fiber.stack[base + i as usize] = value;
                    }
                    Op::SetLocalBox(i) => {
                        let value = pop!();
                        if let Value::Cell(cell) = &self.fiber.stack[base + i as usize] {
                            cell.set(value);
                        }
                    }
                    Op::MakeBox(i) => {
                        let place = &mut self.fiber.stack[base + i as usize];
                        let value = std::mem::take(place);
                        *place = Value::Cell(Rc::new(Slot::new(value)));
                    }
                    Op::Free(i) => self.fiber.stack.push(captured[i as usize].clone()),
                    Op::FreeBox(i) => self.fiber.stack.push(unbox(&captured[i as usize])),
                    Op::SetFreeBox(i) => {
                        let value = pop!();
                        if let Value::Cell(cell) = &captured[i as usize] {
                            cell.set(value);
                        }
                    }
                    Op::Global(sym) => {
                        let value = self.image.symbols.get(sym).value.clone();
                        if value.is_unbound() {
                            fail!(Raise::unbound_variable(sym));
                        }
                        self.fiber.stack.push(value);
                    }
                    Op::SetGlobal(sym) => {
                        let value = pop!();
                        self.image.symbols.get_mut(sym).value = value;
                    }
                    Op::Function(sym) => match &self.image.symbols.get(sym).function {
                        FunctionCell::Function(f) => {
                            self.fiber.stack.push(Value::Function(f.clone()));
                        }
                        _ => fail!(Raise::undefined_function(sym.into())),
                    },
                    Op::SetfFunction(sym) => match &self.image.symbols.get(sym).setf_function {
                        Some(f) => self.fiber.stack.push(Value::Function(f.clone())),
                        None => {
                            let name = Value::list([known::SETF.into(), sym.into()]);
                            fail!(Raise::undefined_function(name))
                        }
                    },
                    Op::Closure(i) => {
                        let closure = self.make_closure(&code, i as usize, base, captured);
                        self.fiber.stack.push(closure);
                    }
                    Op::Pop => {
                        self.fiber.stack.pop();
                    }
                    Op::Drop(n) => {
                        let height = self.fiber.stack.len() - n as usize;
                        self.fiber.stack.truncate(height);
                    }
                    Op::Slide(n) => {
                        let top = pop!();
                        let height = self.fiber.stack.len() - n as usize;
                        self.fiber.stack.truncate(height);
                        self.fiber.stack.push(top);
                    }
                    Op::Dup => {
                        let top = self.fiber.stack.last().cloned().unwrap_or_default();
                        self.fiber.stack.push(top);
                    }
                    Op::Jump(target) => {
                        let target = target as usize;
                        if target < pc {
                            budget -= 1;
                            if budget == 0 {
                                self.save_pc(target);
                                if self.is_interrupted() {
                                    return Next::Stop(Event::Interrupted);
                                }
                                budget = INTERRUPT_INTERVAL;
                            }
                        }
                        pc = target;
                    }
                    Op::JumpIfNil(target) => {
                        if pop!().is_nil() {
                            pc = target as usize;
                        }
                    }
                    Op::JumpIfTrue(target) => {
                        if pop!().is_true() {
                            pc = target as usize;
                        }
                    }
                    Op::JumpIfTrueOrPop(target) => {
                        if self.fiber.stack.last().is_some_and(Value::is_true) {
                            pc = target as usize;
                        } else {
                            self.fiber.stack.pop();
                        }
                    }
                    Op::JumpIfSupplied(i, target) => {
                        if !self.fiber.stack[base + i as usize].is_unbound() {
                            pc = target as usize;
                        }
                    }
                    Op::Supplied(i) => {
                        let supplied = !self.fiber.stack[base + i as usize].is_unbound();
                        self.fiber.stack.push(Value::bool(supplied));
                    }
                    Op::Call(sym, count) | Op::CallMulti(sym, count) => {
                        let multi = matches!(op, Op::CallMulti(..));
                        let count = usize::from(count);
                        let called = match &self.image.symbols.get(sym).function {
                            FunctionCell::Function(f) => f.clone(),
                            _ => {
                                let height = self.fiber.stack.len() - count;
                                self.fiber.stack.truncate(height);
                                fail!(Raise::undefined_function(sym.into()))
                            }
                        };
                        let cut = self.fiber.stack.len() - count;
                        if let Body::Native(native) = &called.body
                            && let NativeCall::Pure(f) = native.call
                            && count >= usize::from(native.min)
                            && native.max.is_none_or(|max| count <= usize::from(max))
                        {
                            let result = f(self.image, &self.fiber.stack[cut..]);
                            self.fiber.stack.truncate(cut);
                            let value = check!(result);
                            self.fiber
                                .stack
                                .push(if multi { value } else { value.primary() });
                            continue 'code;
                        }
                        self.save_pc(pc);
                        budget -= 1;
                        match self.call_on_stack(called, count, cut, multi) {
                            Next::Run if budget > 0 => break 'code,
                            next => return self.or_interrupt(next, budget),
                        }
                    }
                    Op::CallValue(count) | Op::CallValueMulti(count) => {
                        let multi = matches!(op, Op::CallValueMulti(_));
                        let count = usize::from(count);
                        let cut = self.fiber.stack.len() - count - 1;
                        self.save_pc(pc);
                        let called = match &self.fiber.stack[cut] {
                            Value::Function(f) => f.clone(),
                            other => {
                                let other = other.clone();
                                match self.image.coerce_to_function(&other) {
                                    Ok(f) => f,
                                    Err(raise) => {
                                        self.fiber.stack.truncate(cut);
                                        return self.raise(raise);
                                    }
                                }
                            }
                        };
                        budget -= 1;
                        match self.call_on_stack(called, count, cut, multi) {
                            Next::Run if budget > 0 => break 'code,
                            next => return self.or_interrupt(next, budget),
                        }
                    }
                    Op::MultipleValueCall(count, multi) => {
                        let start = self.fiber.stack.len() - usize::from(count);
                        let args: Vec<Value> = self
                            .fiber
                            .stack
                            .drain(start..)
                            .flat_map(Value::into_values)
                            .collect();
                        let called = pop!();
                        self.save_pc(pc);
                        match self.call_value(called, args, multi) {
                            Next::Run => break 'code,
                            next => return next,
                        }
                    }
                    Op::Return => {
                        let value = pop!();
                        let Some(frame) = self.fiber.frames.pop() else {
                            return Next::Deliver(value);
                        };
                        if self.fiber.dynamic.len() > frame.dynamic {
                            self.drop_dynamic(frame.dynamic);
                        }
                        self.fiber.stack.truncate(frame.cut);
                        let value = if frame.multi { value } else { value.primary() };
                        match self.fiber.frames.last() {
                            Some(Frame {
                                kind: FrameKind::Code { .. },
                                ..
                            }) => {
                                self.fiber.stack.push(value);
                                break 'code;
                            }
                            _ => return Next::Deliver(value),
                        }
                    }
                    Op::Primary => {
                        let value = pop!();
                        self.fiber.stack.push(value.primary());
                    }
                    Op::Spread(count) => {
                        let count = count as usize;
                        match pop!() {
                            Value::Multiple(values) => {
                                for i in 0..count {
                                    let value = values.get(i).cloned().unwrap_or(Value::NIL);
                                    self.fiber.stack.push(value);
                                }
                            }
                            single => {
                                if count > 0 {
                                    self.fiber.stack.push(single);
                                }
                                for _ in 1..count {
                                    self.fiber.stack.push(Value::NIL);
                                }
                            }
                        }
                    }
                    Op::Car => {
                        let value = match pop!() {
                            Value::Cons(cons) => cons.car(),
                            Value::Symbol(known::NIL) => Value::NIL,
                            other => fail!(Raise::type_error(&other, known::LIST)),
                        };
                        self.fiber.stack.push(value);
                    }
                    Op::Cdr => {
                        let value = match pop!() {
                            Value::Cons(cons) => cons.cdr(),
                            Value::Symbol(known::NIL) => Value::NIL,
                            other => fail!(Raise::type_error(&other, known::LIST)),
                        };
                        self.fiber.stack.push(value);
                    }
                    Op::Cons => {
                        let b = pop!();
                        let a = pop!();
                        self.fiber.stack.push(Value::cons(a, b));
                    }
                    Op::Eq => {
                        let b = pop!();
                        let a = pop!();
                        self.fiber.stack.push(Value::bool(a.is_eq(&b)));
                    }
                    Op::Not => {
                        let a = pop!();
                        self.fiber.stack.push(Value::bool(a.is_nil()));
                    }
                    Op::Consp => {
                        let a = pop!();
                        self.fiber
                            .stack
                            .push(Value::bool(matches!(a, Value::Cons(_))));
                    }
                    Op::Add => binary!(number::add),
                    Op::Sub => binary!(number::sub),
                    Op::Mul => binary!(number::mul),
                    Op::AddInt(n) => {
                        let a = pop!();
                        let n = i64::from(n);
                        let value = match &a {
                            Value::Int(x) if x.checked_add(n).is_some() => {
                                Value::Int(x.wrapping_add(n))
                            }
                            _ => check!(number::add(&a, &Value::Int(n))),
                        };
                        self.fiber.stack.push(value);
                    }
                    Op::Less => compare!(<, number::less),
                    Op::Greater => compare!(>, |a, b| number::less(b, a)),
                    Op::LessEqual => compare!(<=, number::less_equal),
                    Op::GreaterEqual => compare!(>=, |a, b| number::less_equal(b, a)),
                    Op::NumEqual => compare!(==, number::number_equal),
                    Op::BindSpecial(sym) => {
                        let value = pop!();
                        self.bind_special(sym, value);
                    }
                    Op::Progv => {
                        let values = pop!();
                        let symbols = pop!();
                        self.fiber.dynamic.push(Dynamic::ProgvMark);
                        let mut values = values.iter_list();
                        for symbol in symbols.iter_list() {
                            match symbol.as_symbol() {
                                Some(sym) => {
                                    let value = values.next().unwrap_or(Value::Unbound);
                                    self.bind_special(sym, value);
                                }
                                None => fail!(Raise::type_error(&symbol, known::SYMBOL)),
                            }
                        }
                    }
                    Op::EndProgv => {
                        let mark = self
                            .fiber
                            .dynamic
                            .iter()
                            .rposition(|d| matches!(d, Dynamic::ProgvMark));
                        self.drop_dynamic(mark.unwrap_or(0));
                    }
                    Op::PopDynamic(n) => {
                        let length = self.fiber.dynamic.len() - n as usize;
                        self.drop_dynamic(length);
                    }
                    Op::EnterBlock { target, multi } => {
                        let id = self.image.fresh_identity();
                        self.fiber.dynamic.push(Dynamic::Block {
                            id,
                            frame: self.fiber.frames.len() - 1,
                            height: self.fiber.stack.len(),
                            target,
                            multi,
                        });
                        self.fiber.stack.push(Value::Int(id));
                    }
                    Op::EnterTagbody(table) => {
                        let id = self.image.fresh_identity();
                        self.fiber.stack.push(Value::Int(id));
                        self.fiber.dynamic.push(Dynamic::Tagbody {
                            id,
                            frame: self.fiber.frames.len() - 1,
                            height: self.fiber.stack.len(),
                            table,
                        });
                    }
                    Op::ReturnFrom => {
                        let id = pop!();
                        let value = pop!();
                        self.save_pc(pc);
                        match self.return_from(&id, value) {
                            Next::Run => break 'code,
                            next => return next,
                        }
                    }
                    Op::Go(tag) => {
                        let id = pop!();
                        self.save_pc(pc);
                        match self.go(&id, tag) {
                            Next::Run => {
                                // A loop through closures can be interrupted, too.
                                budget -= 1;
                                if budget == 0 {
                                    return self.or_interrupt(Next::Run, budget);
                                }
                                break 'code;
                            }
                            next => return next,
                        }
                    }
                    Op::EnterCatch { target, multi } => {
                        let tag = pop!();
                        self.fiber.dynamic.push(Dynamic::Catch {
                            tag,
                            frame: self.fiber.frames.len() - 1,
                            height: self.fiber.stack.len(),
                            target,
                            multi,
                        });
                    }
                    Op::EnterUnwind(target) => self.fiber.dynamic.push(Dynamic::Unwind {
                        frame: self.fiber.frames.len() - 1,
                        height: self.fiber.stack.len(),
                        target,
                    }),
                    Op::LeaveUnwind => {
                        self.fiber.dynamic.pop();
                        self.fiber.stack.push(Value::Int(0));
                    }
                    Op::EndCleanup => {
                        let unwinding = matches!(pop!(), Value::Int(1));
                        if unwinding {
                            self.fiber.stack.pop();
                            self.save_pc(pc);
                            match self.continue_unwinding() {
                                Next::Run => break 'code,
                                next => return next,
                            }
                        }
                    }
                    Op::EnterHandlers(types, count) => {
                        let start = self.fiber.stack.len() - usize::from(count);
                        let handlers: Rc<[Handler]> = code.constants[types as usize]
                            .iter_list()
                            .zip(self.fiber.stack.drain(start..))
                            .map(|(condition_type, function)| Handler {
                                condition_type,
                                function,
                            })
                            .collect();
                        self.fiber.dynamic.push(Dynamic::Handlers(handlers));
                    }
                    Op::EnterRestarts => {
                        let list = pop!();
                        self.fiber.dynamic.push(Dynamic::Restarts(list));
                    }
                }
            }
        }
    }

    /// What to do next, which is to stop if the budget is used up and there is an interrupt.
    fn or_interrupt(&mut self, next: Next, budget: u32) -> Next {
        if budget > 0 || matches!(next, Next::Stop(_)) || !self.is_interrupted() {
            return next;
        }
        if let Next::Deliver(value) = next {
            self.fiber.undelivered = Some(value);
        }
        Next::Stop(Event::Interrupted)
    }

    fn is_interrupted(&self) -> bool {
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

    /// Calls a function whose arguments are the topmost `count` values; the call's result
    /// takes the place of everything from `cut`.
    fn call_on_stack(
        &mut self,
        function: Rc<Function>,
        count: usize,
        cut: usize,
        multi: bool,
    ) -> Next {
        if let Body::Closure { code, .. } = &function.body {
            let code = code.clone();
            return match self.enter_closure(function, &code, count, cut, multi) {
                Ok(()) => Next::Run,
                Err(raise) => {
                    self.fiber.stack.truncate(cut);
                    self.raise(raise)
                }
            };
        }
        if let Body::Deferred(deferred) = &function.body {
            return match library::deferred::force(self.image, deferred) {
                Ok(function) => self.call_on_stack(function, count, cut, multi),
                Err(raise) => {
                    self.fiber.stack.truncate(cut);
                    self.raise(raise)
                }
            };
        }
        let start = self.fiber.stack.len() - count;
        let args: Vec<Value> = self.fiber.stack.drain(start..).collect();
        self.fiber.stack.truncate(cut);
        match self.call_value(Value::Function(function), args, multi) {
            Next::Deliver(value)
                if matches!(
                    self.fiber.frames.last(),
                    Some(Frame {
                        kind: FrameKind::Code { .. },
                        ..
                    })
                ) =>
            {
                self.fiber.stack.push(value);
                Next::Run
            }
            next => next,
        }
    }

    fn make_closure(&self, code: &Code, i: usize, base: usize, captured: &[Value]) -> Value {
        let (inner, captures) = &code.inner[i];
        let values = captures
            .iter()
            .map(|capture| match capture {
                Capture::Local(slot) => self.fiber.stack[base + *slot as usize].clone(),
                Capture::Free(i) => captured[*i as usize].clone(),
            })
            .collect();
        Value::Function(Rc::new(Function::closure(inner.clone(), values)))
    }

    fn bind_special(&mut self, sym: Sym, value: Value) {
        let place = &mut self.image.symbols.get_mut(sym).value;
        let outside = std::mem::replace(place, value);
        self.fiber.dynamic.push(Dynamic::Bind(sym, outside));
    }

    /// Drops dynamic entries beyond `length`, restoring special variables. There is no
    /// cleanup code among them.
    pub(super) fn drop_dynamic(&mut self, length: usize) {
        while self.fiber.dynamic.len() > length {
            if let Some(Dynamic::Bind(sym, outside)) = self.fiber.dynamic.pop() {
                self.image.symbols.get_mut(sym).value = outside;
            }
        }
    }

    /// The place in the source of the call that is being carried out, innermost known first.
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

fn unbox(value: &Value) -> Value {
    match value {
        Value::Cell(cell) => cell.get(),
        other => other.clone(),
    }
}

fn wrong_count(count: usize) -> Box<Raise> {
    Raise::program(format!("invalid number of arguments: {count}"))
}

fn check_keywords(image: &Image, code: &Code, more: &[Value]) -> Result<(), Box<Raise>> {
    if !more.len().is_multiple_of(2) {
        return Err(Raise::program("odd number of &KEY arguments"));
    }
    let others_allowed = code.parameters.allow_other_keys
        || more.chunks_exact(2).any(|pair| {
            pair[0].as_symbol() == Some(known::K_ALLOW_OTHER_KEYS) && pair[1].is_true()
        });
    if others_allowed {
        return Ok(());
    }
    for pair in more.chunks_exact(2) {
        let is_known = pair[0]
            .as_symbol()
            .is_some_and(|s| s == known::K_ALLOW_OTHER_KEYS || code.parameters.keys.contains(&s));
        if !is_known {
            let shown = crate::lisp::print::to_string(image, &pair[0], true);
            return Err(Raise::program(format!("Unknown &KEY argument: {shown}")));
        }
    }
    Ok(())
}

/// Calls a function outside any plan, to the end: for macro functions and the like, which
/// cannot wait.
pub(crate) fn call_nested(
    image: &mut Image,
    function: Value,
    args: Vec<Value>,
) -> Result<Value, Box<Raise>> {
    run_nested(image, function, args).map(Value::primary)
}

/// Like [`call_nested`], with all values.
pub(crate) fn call_nested_values(
    image: &mut Image,
    function: Value,
    args: Vec<Value>,
) -> Result<Vec<Value>, Box<Raise>> {
    run_nested(image, function, args).map(Value::into_values)
}

fn run_nested(image: &mut Image, function: Value, args: Vec<Value>) -> Result<Value, Box<Raise>> {
    if image.nesting >= MOST_NESTED {
        return Err(Raise::new(
            known::CONTROL_STACK_EXHAUSTED,
            "Macro expansion is nested too deeply. Does a macro expand into itself?",
        ));
    }
    image.nesting += 1;
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(image, &mut fiber);
    let mut event = machine.start(function, args);
    let result = loop {
        match event {
            Event::Done(value) => break Ok(value),
            Event::Unhandled(condition) => {
                machine.unwind_all();
                break Err(Box::new(Raise::Condition(condition)));
            }
            Event::Request(_) => {
                event = machine.resume_with_error(Raise::control(
                    "A macro function cannot wait, move the robot or start tasks.",
                ));
            }
            Event::Interrupted => {
                machine.image.interrupt.store(true, Ordering::Relaxed);
                machine.unwind_all();
                break Err(Raise::new(known::INTERACTIVE_INTERRUPT, "Interrupted."));
            }
            Event::Unwound => break Ok(Value::NIL),
        }
    };
    image.nesting -= 1;
    result
}

/// Nested runs of macro functions.
const MOST_NESTED: usize = 64;
