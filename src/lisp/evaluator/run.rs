//! The loop that executes the code of the topmost frame, one operation after the other.
//!
//! The functions that carry out operations are grouped in files of their own and inlined here; the
//! loop itself controls where execution continues. An operation either falls through to the next
//! one, moves the program counter, switches to another frame of code, or leaves the loop.

use std::rc::Rc;

use super::entry::{INTERRUPT_INTERVAL, Next};
use super::variables::push_unboxed;
use crate::lisp::value::Value;
use crate::lisp::value::function::{Body, Function};
use crate::lisp::value::known;
use crate::lisp::value::number;
use crate::lisp::value::operation::Op;
use crate::lisp::value::placing::push_made;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::{FunctionCell, Sym};
use crate::lisp::vm::fiber::{Frame, FrameKind};
use crate::lisp::vm::machine::{Event, Machine, UnderWay};

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
        if self.image.output.is_due() {
            return Next::Stop(Event::Output);
        }
        loop {
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

            let ops: &[Op] = &code.ops;

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

            macro_rules! called {
                ($called:expr) => {
                    match $called {
                        Called::Here => {}
                        Called::Frame => break,
                        Called::Elsewhere(next) => return next,
                    }
                };
            }
            // Jumps if a test has the wanted result.
            macro_rules! branch {
                ($test:expr, $when:expr, $target:expr) => {
                    if $test == $when {
                        pc = $target as usize;
                    }
                };
            }
            // The same if there may be no result; else the next operation is skipped.
            macro_rules! branch_or_skip {
                ($test:expr, $when:expr, $target:expr) => {
                    match $test {
                        Ok(result) if result == $when => pc = $target as usize,
                        Ok(_) => pc += 1,
                        Err(raise) => {
                            self.save_pc(pc);
                            return self.raise(raise);
                        }
                    }
                };
            }

            loop {
                // The emitter ends every function with a return, so there is an operation.
                let op = ops[pc];
                pc += 1;
                match op {
                    Op::Const(i) => code.constants[i as usize].push_copy(&mut self.fiber.stack),
                    Op::Nil => self.push_nil(),
                    Op::Int(n) => self.push_int(i64::from(n)),

                    Op::Local(i) => self.local(base + i as usize),
                    Op::LocalBox(i) => self.local_box(base + i as usize),
                    Op::SetLocal(i) => self.set_local(base + i as usize),
                    Op::SetLocalBox(i) => self.set_local_box(base + i as usize),
                    Op::MakeBox(i) => self.make_box(base + i as usize),
                    Op::Free(i) => captured[i as usize].push_copy(&mut self.fiber.stack),
                    Op::FreeBox(i) => push_unboxed(&captured[i as usize], &mut self.fiber.stack),
                    Op::SetFreeBox(i) => self.set_free_box(&captured[i as usize]),
                    Op::Global(sym) => check!(self.global(sym)),
                    Op::SetGlobal(sym) => self.set_global(sym),
                    Op::Function(sym) => check!(self.function(sym)),
                    Op::SetfFunction(sym) => check!(self.setf_function(sym)),
                    Op::Closure(i) => self.closure(code, i as usize, base, captured),
                    Op::Supplied(i) => {
                        let supplied = self.is_supplied(base + i as usize);
                        self.push_bool(supplied);
                    }

                    Op::Pop => self.drop_top(),
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
                        branch!(self.test_top(Value::is_nil), true, target);
                    }
                    Op::JumpIfTrue(target) => {
                        branch!(self.test_top(Value::is_true), true, target);
                    }
                    Op::JumpIfTrueOrPop(target) => {
                        if self.fiber.stack.last().is_some_and(Value::is_true) {
                            pc = target as usize;
                        } else {
                            self.drop_top();
                        }
                    }
                    Op::JumpIfSupplied(i, target) => {
                        branch!(self.is_supplied(base + i as usize), true, target);
                    }
                    Op::JumpIfLocal { slot, when, target } => {
                        let local = &self.fiber.stack[base + slot as usize];
                        branch!(local.is_true(), when, target);
                    }
                    Op::JumpIfConsp { when, target } => {
                        branch!(
                            self.test_top(|value| matches!(value, Value::Cons(_))),
                            when,
                            target
                        );
                    }
                    Op::JumpIfLocalConsp { slot, when, target } => {
                        let local = &self.fiber.stack[base + slot as usize];
                        branch!(matches!(local, Value::Cons(_)), when, target);
                    }
                    Op::JumpIfEq { when, target } => {
                        branch!(self.are_eq(), when, target);
                    }
                    Op::JumpIfEqConst {
                        constant,
                        when,
                        target,
                    } => {
                        let constant = &code.constants[constant as usize];
                        branch!(self.test_top(|value| value.is_eq(constant)), when, target);
                    }
                    Op::JumpIfCompare {
                        comparison,
                        when,
                        target,
                    } => {
                        branch_or_skip!(self.compare(comparison), when, target);
                    }
                    Op::JumpIfCompareInt {
                        comparison,
                        when,
                        n,
                        target,
                    } => {
                        branch_or_skip!(self.compare_int(comparison, n), when, target);
                    }
                    Op::JumpIfCompareLocals {
                        comparison,
                        when,
                        a,
                        b,
                        target,
                    } => {
                        let stack = &self.fiber.stack;
                        let (a, b) = (&stack[base + usize::from(a)], &stack[base + usize::from(b)]);
                        branch_or_skip!(number::compare_like(comparison, a, b), when, target);
                    }
                    Op::JumpIfCompareLocalInt {
                        comparison,
                        when,
                        slot,
                        n,
                        target,
                    } => {
                        let a = &self.fiber.stack[base + usize::from(slot)];
                        branch_or_skip!(number::compare_int(comparison, a, n), when, target);
                    }

                    Op::Call(sym, count) | Op::CallMulti(sym, count) => {
                        let multi = matches!(op, Op::CallMulti(..));
                        called!(self.call_symbol(sym, usize::from(count), multi, pc, budget));
                    }
                    Op::CallSelf(sym, count) => {
                        let count = usize::from(count);
                        if self.is_function_of(&function, sym) {
                            self.take_arguments_again(base, count);
                            pc = 0;
                            *budget -= 1;
                            if *budget == 0 {
                                *budget = INTERRUPT_INTERVAL;
                                self.save_pc(pc);
                                if let Some(next) = self.pause() {
                                    return next;
                                }
                            }
                        } else {
                            called!(self.call_symbol(sym, count, true, pc, budget));
                        }
                    }
                    Op::CallValue(count) | Op::CallValueMulti(count) => {
                        let multi = matches!(op, Op::CallValueMulti(_));
                        self.save_pc(pc);
                        called!(self.call_top(usize::from(count), multi, budget));
                    }
                    Op::MultipleValueCall(count, multi) => {
                        self.save_pc(pc);
                        leave!(self.call_with_values(usize::from(count), multi));
                    }
                    Op::Return => leave!(self.return_value()),

                    Op::Car => check!(self.car()),
                    Op::Cdr => check!(self.cdr()),
                    Op::Path(path) => check!(self.path(path)),
                    Op::LocalCar(i) => check!(self.local_car(base + i as usize)),
                    Op::LocalCdr(i) => check!(self.local_cdr(base + i as usize)),
                    Op::LocalToCdr(i) => {
                        check!(self.local_to_cdr(base + i as usize));
                        pc += 1;
                    }
                    Op::LocalPath(i, path) => check!(self.local_path(base + i as usize, path)),
                    Op::SetCar => check!(self.set_car()),
                    Op::SetCdr => check!(self.set_cdr()),
                    Op::Cons => self.join_top(),
                    Op::Eq => {
                        let result = self.are_eq();
                        self.push_bool(result);
                    }
                    Op::Not => {
                        let result = self.test_top(Value::is_nil);
                        self.push_bool(result);
                    }
                    Op::Consp => {
                        let result = self.test_top(|value| matches!(value, Value::Cons(_)));
                        self.push_bool(result);
                    }
                    Op::Add => check!(self.arithmetic(i64::checked_add, number::add, pc)),
                    Op::Sub => check!(self.arithmetic(i64::checked_sub, number::sub, pc)),
                    Op::Mul => check!(self.arithmetic(i64::checked_mul, number::mul, pc)),
                    Op::AddInt(n) => check!(self.add_int(n, pc)),
                    Op::LocalAddInt(i, n) => check!(self.local_add_int(base + i as usize, n, pc)),
                    Op::AddToLocal(i, n) => {
                        check!(self.add_to_local(base + i as usize, n, pc));
                        pc += 1;
                    }
                    Op::Compare(comparison) => match self.compare(comparison) {
                        Ok(holds) => self.push_bool(holds),
                        Err(raise) => {
                            self.save_pc(pc);
                            return self.raise(raise);
                        }
                    },
                    Op::Element(sym) => {
                        if !self.element(sym) {
                            called!(self.call_symbol(sym, 2, false, pc, budget));
                        }
                    }
                    Op::SetElement(sym) => {
                        if !self.set_element() {
                            self.save_pc(pc);
                            called!(self.call_setf_function(sym, 3, budget));
                        }
                    }

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
                    Op::Throw => {
                        let value = self.pop();
                        let tag = self.pop();
                        self.save_pc(pc);
                        let next = match self.catch_of(&tag) {
                            Ok(target) => self.unwind(target, value),
                            Err(raise) => self.raise(raise),
                        };
                        // As after a jump through closures.
                        *budget -= 1;
                        if *budget == 0 {
                            return self.or_interrupt(next, budget);
                        }
                        leave!(next);
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
            return self.call_undefined(sym.into(), cut, pc);
        };
        match &called.body {
            Body::Native(native) if native.accepts(count) => {
                if let Some(f) = self.image.pure_call(native) {
                    let name = native.name;
                    self.under_way = Some(UnderWay { pc, cut });
                    let result = f(self.image, &self.fiber.stack[cut..]);
                    self.under_way = None;
                    return match result {
                        Ok(value) => self.returned(value, cut, multi, pc),
                        Err(raise) => {
                            self.save_pc(pc);
                            Called::Elsewhere(self.failed(name, raise, cut, cut, multi))
                        }
                    };
                }
            }
            Body::Closure { code, .. }
                if code.exact_count.map(usize::from) == Some(count) && self.has_room() =>
            {
                let called = called.clone();
                self.save_pc(pc);
                self.push_frame(called, cut, cut, multi);
                *budget -= 1;
                if *budget > 0 {
                    return Called::Frame;
                }
                return Called::Elsewhere(self.or_interrupt(Next::Run, budget));
            }
            _ => {}
        }
        let called = called.clone();
        self.save_pc(pc);
        self.call_any(called, count, cut, multi, budget)
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
        if let Body::Closure { code, .. } = &called.body
            && code.exact_count.map(usize::from) == Some(count)
            && self.has_room()
        {
            self.push_frame(called, cut + 1, cut, multi);
            *budget -= 1;
            if *budget > 0 {
                return Called::Frame;
            }
            return Called::Elsewhere(self.or_interrupt(Next::Run, budget));
        }
        self.call_any(called, count, cut, multi, budget)
    }

    /// Calls the function of `(setf symbol)` with the topmost arguments.
    fn call_setf_function(&mut self, sym: Sym, count: usize, budget: &mut u32) -> Called {
        let cut = self.fiber.stack.len() - count;
        match self.image.symbols.get(sym).setf_function.clone() {
            Some(called) => self.call_any(called, count, cut, false, budget),
            None => {
                let name = Value::list([known::SETF.into(), sym.into()]);
                self.fiber.stack.truncate(cut);
                Called::Elsewhere(self.raise(Raise::undefined_function(name)))
            }
        }
    }

    /// Calls any function with the topmost arguments; its value replaces everything from `cut` up.
    fn call_any(
        &mut self,
        called: Rc<Function>,
        count: usize,
        cut: usize,
        multi: bool,
        budget: &mut u32,
    ) -> Called {
        *budget -= 1;
        match self.call_on_stack(called, count, cut, multi) {
            Next::Run if *budget > 0 && !self.image.output.is_due() => Called::Frame,
            next => Called::Elsewhere(self.or_interrupt(next, budget)),
        }
    }

    #[cold]
    fn call_undefined(&mut self, name: Value, cut: usize, pc: usize) -> Called {
        self.fiber.stack.truncate(cut);
        self.save_pc(pc);
        Called::Elsewhere(self.raise(Raise::undefined_function(name)))
    }

    /// Replaces the arguments of a pure builtin by what it has returned.
    #[inline(always)]
    fn returned(&mut self, value: Value, cut: usize, multi: bool, pc: usize) -> Called {
        self.cut_stack(cut);
        let value = if multi { value } else { value.primary() };
        self.fiber.stack.push(value);
        if self.image.output.is_due() {
            self.save_pc(pc);
            return Called::Elsewhere(Next::Stop(Event::Output));
        }
        Called::Here
    }

    /// Is this the function of a symbol?
    #[inline(always)]
    fn is_function_of(&self, function: &Rc<Function>, sym: Sym) -> bool {
        match &self.image.symbols.get(sym).function {
            FunctionCell::Function(other) => Rc::ptr_eq(function, other),
            _ => false,
        }
    }

    /// Makes the topmost values the arguments of the frame whose slots begin at `base`.
    #[inline(always)]
    fn take_arguments_again(&mut self, base: usize, count: usize) {
        let stack = &mut self.fiber.stack;
        let start = stack.len() - count;
        let (below, arguments) = stack.split_at_mut(start);
        for (place, argument) in below[base..].iter_mut().zip(arguments) {
            argument.move_to(place);
        }
        self.cut_stack(base + count);
    }

    /// Returns the top value from the topmost frame.
    #[inline(always)]
    fn return_value(&mut self) -> Next {
        let (function, cut, dynamic, multi) = match self.fiber.frames.pop() {
            Some(Frame {
                kind: FrameKind::Code { function, .. },
                cut,
                dynamic,
                multi,
                ..
            }) => (function, cut, dynamic, multi),
            // Not reached, since a function runs only in a frame of code.
            other => {
                std::mem::forget(other);
                return Next::Deliver(self.pop());
            }
        };
        drop(function);
        if self.fiber.dynamic.len() > dynamic {
            self.drop_dynamic(dynamic);
        }
        let to_code = matches!(
            self.fiber.frames.last(),
            Some(Frame {
                kind: FrameKind::Code { .. },
                ..
            })
        );
        // The most frequent values are not moved but made again in their new place.
        match self.fiber.stack.last_mut() {
            Some(&mut Value::Int(n)) if to_code => {
                self.cut_stack(cut);
                self.push_int(n);
                return Next::Run;
            }
            Some(&mut Value::Symbol(sym, ref hold)) if to_code && hold.is_none() => {
                self.cut_stack(cut);
                push_made(&mut self.fiber.stack, || Value::symbol(sym));
                return Next::Run;
            }
            Some(value @ Value::Cons(_)) if to_code => {
                let pair = value.take_pair();
                self.cut_stack(cut);
                if let Some(pair) = pair {
                    push_made(&mut self.fiber.stack, || Value::Cons(pair));
                }
                return Next::Run;
            }
            _ => {}
        }
        let value = self.pop();
        self.cut_stack(cut);
        let value = if multi { value } else { value.primary() };
        if !to_code {
            return Next::Deliver(value);
        }
        self.fiber.stack.push(value);
        Next::Run
    }
}
