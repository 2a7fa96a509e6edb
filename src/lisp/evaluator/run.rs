//! The loop that executes the code of the topmost frame, one operation after the other.
//!
//! The functions that carry out operations are grouped in files of their own and inlined here; the
//! loop itself controls where execution continues. An operation either falls through to the next
//! one, moves the program counter, switches to another frame of code, or leaves the loop.

use super::entry::{INTERRUPT_INTERVAL, Next};
use super::variables::unbox;
use crate::lisp::value::Value;
use crate::lisp::value::code::Op;
use crate::lisp::value::function::Body;
use crate::lisp::value::number;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::{FunctionCell, Sym};
use crate::lisp::vm::fiber::{Frame, FrameKind};
use crate::lisp::vm::machine::{Event, Machine};

/// Where execution continues after a call.
enum Called {
    /// At the next operation: the call's value is on the stack.
    Here,
    /// In the topmost frame, which has changed.
    Frame,
    /// Outside the loop.
    Elsewhere(Next),
}

impl Machine<'_> {
    /// `budget`: how many calls and jumps backwards there may be before the next pause.
    pub(super) fn run_code(&mut self, budget: &mut u32) -> Next {
        loop {
            if self.image.output.is_due() {
                return Next::Stop(Event::Output);
            }
            // Registers of the topmost frame.
            let Some(frame) = self.fiber.frames.last() else {
                return Next::Run;
            };
            let FrameKind::Code { function, pc } = &frame.kind else {
                return Next::Run;
            };
            let function = function.clone();
            let mut pc = *pc;
            let base = frame.base;
            let Body::Closure { code, captured } = &function.body else {
                return Next::Run;
            };

            macro_rules! check {
                ($result:expr) => {
                    if let Err(raise) = $result {
                        self.save_pc(pc);
                        return self.raise(raise);
                    }
                };
            }
            // Continues in the topmost frame, or outside the loop.
            macro_rules! leave {
                ($next:expr) => {
                    match $next {
                        Next::Run => break,
                        next => return next,
                    }
                };
            }

            loop {
                // The emitter ends every function with a return, so there is an operation.
                let op = code.ops[pc];
                pc += 1;
                match op {
                    Op::Const(i) => self.fiber.stack.push(code.constants[i as usize].clone()),
                    Op::Nil => self.fiber.stack.push(Value::NIL),
                    Op::Int(n) => self.fiber.stack.push(Value::Int(i64::from(n))),

                    Op::Local(i) => self.local(base + i as usize),
                    Op::LocalBox(i) => self.local_box(base + i as usize),
                    Op::SetLocal(i) => self.set_local(base + i as usize),
                    Op::SetLocalBox(i) => self.set_local_box(base + i as usize),
                    Op::MakeBox(i) => self.make_box(base + i as usize),
                    Op::Free(i) => self.fiber.stack.push(captured[i as usize].clone()),
                    Op::FreeBox(i) => self.fiber.stack.push(unbox(&captured[i as usize])),
                    Op::SetFreeBox(i) => self.set_free_box(&captured[i as usize]),
                    Op::Global(sym) => check!(self.global(sym)),
                    Op::SetGlobal(sym) => self.set_global(sym),
                    Op::Function(sym) => check!(self.function(sym)),
                    Op::SetfFunction(sym) => check!(self.setf_function(sym)),
                    Op::Closure(i) => self.closure(code, i as usize, base, captured),
                    Op::Supplied(i) => {
                        let supplied = self.is_supplied(base + i as usize);
                        self.fiber.stack.push(Value::bool(supplied));
                    }

                    Op::Pop => {
                        self.fiber.stack.pop();
                    }
                    Op::Drop(n) => self.drop_values(n),
                    Op::Slide(n) => self.slide(n),
                    Op::Dup => self.duplicate(),
                    Op::Spread(count) => self.spread(count),

                    Op::Jump(target) => {
                        let target = target as usize;
                        if target < pc {
                            *budget -= 1;
                            if *budget == 0 {
                                *budget = INTERRUPT_INTERVAL;
                                // After an interrupt it jumps again: here, variables are in scope.
                                self.save_pc(pc - 1);
                                if let Some(next) = self.pause() {
                                    return next;
                                }
                            }
                        }
                        pc = target;
                    }
                    Op::JumpIfNil(target) => {
                        if self.pop().is_nil() {
                            pc = target as usize;
                        }
                    }
                    Op::JumpIfTrue(target) => {
                        if self.pop().is_true() {
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
                        if self.is_supplied(base + i as usize) {
                            pc = target as usize;
                        }
                    }

                    Op::Call(sym, count) | Op::CallMulti(sym, count) => {
                        let multi = matches!(op, Op::CallMulti(..));
                        match self.call_symbol(sym, usize::from(count), multi, pc, budget) {
                            Called::Here => {}
                            Called::Frame => break,
                            Called::Elsewhere(next) => return next,
                        }
                    }
                    Op::CallValue(count) | Op::CallValueMulti(count) => {
                        let multi = matches!(op, Op::CallValueMulti(_));
                        self.save_pc(pc);
                        match self.call_top(usize::from(count), multi, budget) {
                            Called::Here => {}
                            Called::Frame => break,
                            Called::Elsewhere(next) => return next,
                        }
                    }
                    Op::MultipleValueCall(count, multi) => {
                        self.save_pc(pc);
                        leave!(self.call_with_values(usize::from(count), multi));
                    }
                    Op::Return => leave!(self.return_value()),

                    Op::Car => check!(self.car()),
                    Op::Cdr => check!(self.cdr()),
                    Op::Cons => self.join_top(Value::cons),
                    Op::Eq => self.join_top(|a, b| Value::bool(a.is_eq(&b))),
                    Op::Not => self.map_top(|a| Value::bool(a.is_nil())),
                    Op::Consp => self.map_top(|a| Value::bool(matches!(a, Value::Cons(_)))),
                    Op::Add => check!(self.arithmetic(number::add)),
                    Op::Sub => check!(self.arithmetic(number::sub)),
                    Op::Mul => check!(self.arithmetic(number::mul)),
                    Op::AddInt(n) => check!(self.add_int(n)),
                    Op::Less => check!(self.compare(i64::lt, number::less)),
                    Op::Greater => check!(self.compare(i64::gt, |a, b| number::less(b, a))),
                    Op::LessEqual => check!(self.compare(i64::le, number::less_equal)),
                    Op::GreaterEqual => {
                        check!(self.compare(i64::ge, |a, b| number::less_equal(b, a)));
                    }
                    Op::NumEqual => check!(self.compare(i64::eq, number::number_equal)),

                    Op::BindSpecial(sym) => {
                        let value = self.pop();
                        self.bind_special(sym, value);
                    }
                    Op::Progv => check!(self.progv()),
                    Op::EndProgv => self.end_progv(),
                    Op::PopDynamic(n) => self.pop_dynamic(n),
                    Op::EnterBlock { target, multi } => self.enter_block(target, multi),
                    Op::EnterTagbody(table) => self.enter_tagbody(table),
                    Op::EnterCatch { target, multi } => self.enter_catch(target, multi),
                    Op::EnterUnwind(target) => self.enter_unwind(target),
                    Op::LeaveUnwind => self.leave_unwind(),
                    Op::EnterHandlers(types, count) => self.enter_handlers(code, types, count),
                    Op::EnterRestarts => self.enter_restarts(),
                    Op::ReturnFrom => {
                        let id = self.pop();
                        let value = self.pop();
                        self.save_pc(pc);
                        leave!(self.return_from(&id, value));
                    }
                    Op::Go(tag) => {
                        let id = self.pop();
                        self.save_pc(pc);
                        let next = self.go(&id, tag);
                        // A loop through closures can be interrupted, too.
                        *budget -= 1;
                        if *budget == 0 {
                            return self.or_interrupt(next, budget);
                        }
                        leave!(next);
                    }
                    Op::EndCleanup => {
                        let unwinding = matches!(self.pop(), Value::Int(1));
                        if unwinding {
                            self.fiber.stack.pop();
                            self.save_pc(pc);
                            leave!(self.continue_unwinding());
                        }
                    }
                }
            }
        }
    }

    /// Calls a symbol's function with the topmost arguments.
    #[inline(always)]
    fn call_symbol(
        &mut self,
        sym: Sym,
        count: usize,
        multi: bool,
        pc: usize,
        budget: &mut u32,
    ) -> Called {
        let cut = self.fiber.stack.len() - count;
        let FunctionCell::Function(called) = &self.image.symbols.get(sym).function else {
            self.fiber.stack.truncate(cut);
            self.save_pc(pc);
            return Called::Elsewhere(self.raise(Raise::undefined_function(sym.into())));
        };
        let called = called.clone();
        if let Body::Native(native) = &called.body
            && native.accepts(count)
            && let Some(f) = self.image.pure_call(native)
        {
            let result = f(self.image, &self.fiber.stack[cut..]);
            self.fiber.stack.truncate(cut);
            return match result {
                Ok(value) => {
                    let value = if multi { value } else { value.primary() };
                    self.fiber.stack.push(value);
                    if self.image.output.is_due() {
                        self.save_pc(pc);
                        return Called::Elsewhere(Next::Stop(Event::Output));
                    }
                    Called::Here
                }
                Err(raise) => {
                    self.save_pc(pc);
                    Called::Elsewhere(self.raise(raise))
                }
            };
        }
        self.save_pc(pc);
        *budget -= 1;
        match self.call_on_stack(called, count, cut, multi) {
            Next::Run if *budget > 0 => Called::Frame,
            next => Called::Elsewhere(self.or_interrupt(next, budget)),
        }
    }

    /// Calls the function below the topmost arguments.
    #[inline(always)]
    fn call_top(&mut self, count: usize, multi: bool, budget: &mut u32) -> Called {
        let cut = self.fiber.stack.len() - count - 1;
        let called = match &self.fiber.stack[cut] {
            Value::Function(f) => f.clone(),
            other => match self.image.coerce_to_function(other) {
                Ok(f) => f,
                Err(raise) => {
                    self.fiber.stack.truncate(cut);
                    return Called::Elsewhere(self.raise(raise));
                }
            },
        };
        *budget -= 1;
        match self.call_on_stack(called, count, cut, multi) {
            Next::Run if *budget > 0 => Called::Frame,
            next => Called::Elsewhere(self.or_interrupt(next, budget)),
        }
    }

    /// Calls the function below the topmost `count` results with all their values.
    fn call_with_values(&mut self, count: usize, multi: bool) -> Next {
        let start = self.fiber.stack.len() - count;
        let results = self.fiber.stack.drain(start..);
        let args: Vec<Value> = results.flat_map(Value::into_values).collect();
        let called = self.pop();
        self.call_value(called, args, multi)
    }

    /// Returns the top value from the topmost frame.
    #[inline(always)]
    fn return_value(&mut self) -> Next {
        let value = self.pop();
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
                Next::Run
            }
            _ => Next::Deliver(value),
        }
    }
}
