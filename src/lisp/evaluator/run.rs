//! The loop that executes the code of the topmost frame, one operation after the other.
//!
//! The functions that carry out operations are grouped in files of their own and inlined here; the
//! loop itself controls where execution continues. An operation either falls through to the next
//! one, moves the program counter, switches to another frame of code, or leaves the loop.
//!
//! While it runs, the frame's place in the code and the height of the stack are only known here. They
//! are noted where something else may ask for them: before whatever concerns the machine as a whole,
//! and before a builtin, which may be left by unwinding.

use std::rc::Rc;

use super::calling::MAX_FRAMES;
use super::dynamic::{bind, undo};
use super::entry::{INTERRUPT_INTERVAL, Next};
use super::exits::{enter_block, enter_catch, enter_tagbody, enter_unwind};
use super::primitives::is_cons;
use super::small_integers::{both_ints, int};
use super::variables::{closure, function as function_of, setf_function, unboxed_into};
use crate::types::standard_variables::check_value;
use crate::value::Value;
use crate::value::function::Body;
use crate::value::known;
use crate::value::number;
use crate::value::operation::Op;
use crate::value::symbol::FunctionCell;
use crate::vm::frames::{Frame, FrameKind};
use crate::vm::machine::{Event, Machine};

impl Machine<'_> {
    /// `budget`: how many calls and jumps backwards there may be before the next pause.
    pub(super) fn run_code(&mut self, budget: &mut u32) -> Next {
        if self.image.output.is_due() {
            return Next::Stop(Event::Output);
        }
        'frame: loop {
            // Registers of the topmost frame.
            let fiber = &mut *self.fiber;
            let Some(frame) = fiber.frames.last() else {
                return Next::Run;
            };
            let FrameKind::Code {
                function,
                pc: noted,
            } = &frame.kind
            else {
                return Next::Run;
            };
            let Body::Closure { code, captured } = &function.body else {
                return Next::Run;
            };
            let content = match self.image.content(code) {
                Ok(content) => content,
                Err(raise) => return self.raise(raise),
            };
            let mut pc = noted.get();
            let mut window = fiber.stack.window(frame.base, code.room);
            let ops: &[Op] = &content.ops;

            // Notes where the code is, for what concerns the machine as a whole.
            macro_rules! note {
                () => {
                    noted.set(pc);
                    window.close();
                };
            }
            macro_rules! check {
                ($result:expr) => {
                    match $result {
                        Ok(value) => value,
                        Err(raise) => {
                            note!();
                            return self.raise(raise);
                        }
                    }
                };
            }
            // Continues in the topmost frame, or outside the loop.
            macro_rules! leave {
                ($next:expr) => {
                    match $next {
                        Next::Run => continue 'frame,
                        next => return next,
                    }
                };
            }
            // An operation of the machine, after which the code goes on.
            macro_rules! slowly {
                ($operation:expr) => {{
                    note!();
                    $operation;
                    continue 'frame;
                }};
            }
            // Jumps if a test has the wanted result.
            macro_rules! branch {
                ($test:expr, $when:expr, $target:expr) => {
                    if $test == $when {
                        pc = $target as usize;
                    }
                };
            }
            // Computes with numbers that are not small integers. They may be so large that this is
            // left on the way; the topmost values, of which there are so many, are then gone.
            macro_rules! compute {
                ($count:expr, $operation:expr) => {{
                    noted.set(pc);
                    window.close_below(window.top - $count);
                    let result = $operation;
                    window.cut(window.top - $count);
                    match result {
                        Ok(value) => value,
                        Err(raise) => {
                            window.close();
                            return self.raise(raise);
                        }
                    }
                }};
            }
            // Jumps if a comparison of numbers has the wanted result, and drops those of them that are on
            // top of the stack, `count`. The next operation is skipped unless they are no numbers.
            macro_rules! branch_compared {
                ($test:expr, $ints:expr, $numbers:expr, $count:expr, $target:expr) => {{
                    let jumps = match $ints {
                        Some((a, b)) => {
                            window.top -= $count;
                            $test.jumps(a, b)
                        }
                        None => {
                            let result = compute!($count, {
                                let (a, b) = $numbers;
                                number::compare_like($test.comparison(), a, b)
                            });
                            result == $test.when()
                        }
                    };
                    pc = if jumps { $target as usize } else { pc + 1 };
                }};
            }
            macro_rules! arithmetic {
                ($of_integers:expr, $of_numbers:expr) => {
                    if !window.combine($of_integers) {
                        let (a, b) = window.two();
                        let value = compute!(2, $of_numbers(a, b));
                        window.push(value);
                    }
                };
            }
            // The same with the top and a local.
            macro_rules! arithmetic_with {
                ($i:expr, $of_integers:expr, $of_numbers:expr) => {
                    if !window.combine_with($i, $of_integers) {
                        let value = compute!(1, $of_numbers(window.last(), &window.slots[$i]));
                        window.push(value);
                    }
                };
            }
            // Enters the code of a function whose arguments are the topmost values, `below` which
            // there may be what goes with them.
            macro_rules! enter {
                ($called:expr, $count:expr, $below:expr, $multi:expr) => {{
                    let called = Rc::clone($called);
                    note!();
                    let base = window.height() - $count;
                    let dynamic = fiber.dynamic.len();
                    let frames = &mut fiber.frames;
                    frames.enter(called, base, base - $below, dynamic, $multi);
                    *budget -= 1;
                    if *budget > 0 {
                        continue 'frame;
                    }
                    return self.or_interrupt(Next::Run, budget);
                }};
            }
            // Continues in the frame of a call that has begun, or outside the loop.
            macro_rules! called {
                ($called:expr) => {
                    match $called {
                        Ok(()) => continue 'frame,
                        Err(next) => return next,
                    }
                };
            }

            'operation: loop {
                // The emitter ends every function with a return, so there is an operation.
                let op = &ops[pc];
                pc += 1;
                let (sym, count, multi) = 'call: {
                    match *op {
                        Op::Const(i) => content.constants[i as usize].copy_into(window.next()),
                        Op::Nil => window.push(Value::NIL),
                        Op::Int(n) => window.push_int(i64::from(n)),

                        Op::Local(i) => window.local(i as usize),
                        Op::TwoLocals(a, b) => window.two_locals(usize::from(a), usize::from(b)),
                        Op::LocalBox(i) => window.local_box(i as usize),
                        Op::SetLocal(i) => window.set_local(i as usize),
                        Op::SetLocalBox(i) => window.set_local_box(i as usize),
                        Op::MakeBox(i) => window.make_box(i as usize),
                        Op::Free(i) => captured[i as usize].copy_into(window.next()),
                        Op::FreeBox(i) => unboxed_into(&captured[i as usize], window.next()),
                        Op::SetFreeBox(i) => window.set_free_box(&captured[i as usize]),
                        Op::Global(sym) => check!(window.global(self.image, sym)),
                        Op::SetGlobal(sym) => check!(window.set_global(self.image, sym)),
                        Op::Function(sym) => window.push(check!(function_of(self.image, sym))),
                        Op::SetfFunction(sym) => {
                            window.push(check!(setf_function(self.image, sym)))
                        }
                        Op::Closure(i) => {
                            let closure = closure(content, i as usize, window.slots, captured);
                            window.push(Value::Function(closure));
                        }
                        Op::Supplied(i) => {
                            let supplied = window.is_supplied(i as usize);
                            window.push_bool(supplied);
                        }

                        Op::Pop => window.drop_top(),
                        Op::Drop(n) => window.cut(window.top - n as usize),
                        Op::Slide(n) => window.slide(n),
                        Op::Dup => window.duplicate(),
                        Op::Spread(count) => window.spread(count),

                        Op::Jump(target) => {
                            let target = target as usize;
                            if target < pc {
                                *budget -= 1;
                                if *budget == 0 {
                                    *budget = INTERRUPT_INTERVAL;
                                    // After an interrupt it jumps again: here, variables are in scope.
                                    noted.set(pc - 1);
                                    window.close();
                                    if let Some(next) = self.pause() {
                                        return next;
                                    }
                                    self.save_pc(target);
                                    continue 'frame;
                                }
                            }
                            pc = target;
                        }
                        Op::JumpIfNil(target) => {
                            branch!(window.test_top(Value::is_nil), true, target);
                        }
                        Op::JumpIfTrue(target) => {
                            branch!(window.test_top(Value::is_true), true, target);
                        }
                        Op::JumpIfTrueOrPop(target) => {
                            if window.last().is_true() {
                                pc = target as usize;
                            } else {
                                window.top -= 1;
                            }
                        }
                        Op::JumpIfSupplied(i, target) => {
                            branch!(window.is_supplied(i as usize), true, target);
                        }
                        Op::JumpIfLocal { slot, when, target } => {
                            branch!(window.slots[slot as usize].is_true(), when, target);
                        }
                        Op::JumpIfConsp { when, target } => {
                            branch!(window.test_top(is_cons), when, target);
                        }
                        Op::JumpIfLocalConsp { slot, when, target } => {
                            branch!(is_cons(&window.slots[slot as usize]), when, target);
                        }
                        Op::JumpIfEq { when, target } => {
                            branch!(window.are_eq(), when, target);
                        }
                        Op::JumpIfEqConst {
                            constant,
                            when,
                            target,
                        } => {
                            let constant = &content.constants[constant as usize];
                            branch!(window.test_top(|value| value.is_eq(constant)), when, target);
                        }
                        Op::JumpIfCompare { test, target } => {
                            let ints = both_ints(window.two());
                            branch_compared!(test, ints, window.two(), 2, target);
                        }
                        Op::JumpIfCompareInt { test, n, target } => {
                            let n = i64::from(n);
                            let ints = int(window.last()).map(|a| (a, n));
                            branch_compared!(
                                test,
                                ints,
                                (window.last(), &Value::Int(n)),
                                1,
                                target
                            );
                        }
                        Op::JumpIfCompareLocals { test, a, b, target } => {
                            let (a, b) = (usize::from(a), usize::from(b));
                            let ints = both_ints(window.locals(a, b));
                            branch_compared!(test, ints, window.locals(a, b), 0, target);
                        }
                        Op::JumpIfCompareLocal { test, slot, target } => {
                            let slot = usize::from(slot);
                            let ints = both_ints(window.local_and_last(slot));
                            branch_compared!(test, ints, window.local_and_last(slot), 1, target);
                        }
                        Op::JumpIfCompareLocalInt {
                            test,
                            slot,
                            n,
                            target,
                        } => {
                            let (slot, n) = (usize::from(slot), i64::from(n));
                            let ints = int(&window.slots[slot]).map(|a| (a, n));
                            branch_compared!(
                                test,
                                ints,
                                (&window.slots[slot], &Value::Int(n)),
                                0,
                                target
                            );
                        }

                        Op::Call(sym, count) => break 'call (sym, count, false),
                        Op::CallMulti(sym, count) => break 'call (sym, count, true),
                        Op::CallSelf(sym, count) => {
                            let running = match &self.image.symbols.get(sym).function {
                                FunctionCell::Function(other) => Rc::ptr_eq(function, other),
                                _ => false,
                            };
                            if !running {
                                break 'call (sym, count, true);
                            }
                            window.take_arguments_again(usize::from(count));
                            pc = 0;
                            *budget -= 1;
                            if *budget == 0 {
                                *budget = INTERRUPT_INTERVAL;
                                note!();
                                if let Some(next) = self.pause() {
                                    return next;
                                }
                                continue 'frame;
                            }
                        }
                        Op::CallValue(count) | Op::CallValueMulti(count) => {
                            let multi = matches!(op, Op::CallValueMulti(_));
                            let start = window.top - usize::from(count);
                            if let Value::Function(called) = &window.slots[start - 1]
                                && let Body::Closure { code, .. } = &called.body
                                && code.exact_count == Some(count)
                                && fiber.frames.len() < MAX_FRAMES
                            {
                                enter!(called, usize::from(count), 1, multi);
                            }
                            note!();
                            called!(self.call_top(usize::from(count), multi, budget));
                        }
                        Op::MultipleValueCall(count, multi) => {
                            note!();
                            leave!(self.call_with_values(usize::from(count), multi));
                        }
                        Op::Return => {
                            let (cut, multi, length) = (frame.cut, frame.multi, frame.dynamic);
                            window.close();
                            fiber.frames.leave();
                            if fiber.dynamic.len() > length {
                                undo(self.image, &mut fiber.dynamic, length);
                            }
                            let to_code = fiber.frames.last().is_some_and(Frame::is_of_code);
                            if !to_code || !fiber.stack.lower_top(cut) {
                                leave!(self.return_values(cut, multi));
                            }
                            continue 'frame;
                        }

                        Op::Car => check!(window.car()),
                        Op::Cdr => check!(window.cdr()),
                        Op::Path(path) => check!(window.path(path)),
                        Op::LocalCar(i) => check!(window.local_car(i as usize)),
                        Op::LocalCdr(i) => check!(window.local_cdr(i as usize)),
                        Op::LocalToCdr(i) => {
                            check!(window.local_to_cdr(i as usize));
                            pc += 1;
                        }
                        Op::LocalPath(i, path) => check!(window.local_path(i as usize, path)),
                        Op::SetCarOnly => {
                            check!(window.set_car());
                            window.drop_top();
                            pc += 1;
                        }
                        Op::SetCdrOnly => {
                            check!(window.set_cdr());
                            window.drop_top();
                            pc += 1;
                        }
                        Op::SetCar => check!(window.set_car()),
                        Op::SetCdr => check!(window.set_cdr()),
                        Op::Cons => window.join_top(),
                        Op::Eq => {
                            let result = window.are_eq();
                            window.push_bool(result);
                        }
                        Op::Not => window.answer_top(Value::is_nil),
                        Op::Consp => window.answer_top(is_cons),
                        Op::Add => arithmetic!(i64::checked_add, number::add),
                        Op::Sub => arithmetic!(i64::checked_sub, number::sub),
                        Op::Mul => arithmetic!(i64::checked_mul, number::mul),
                        Op::AddLocal(i) => {
                            arithmetic_with!(i as usize, i64::checked_add, number::add);
                        }
                        Op::SubLocal(i) => {
                            arithmetic_with!(i as usize, i64::checked_sub, number::sub);
                        }
                        Op::AddInt(n) => {
                            let n = i64::from(n);
                            if !window.add_int(n) {
                                let sum = compute!(1, number::add(window.last(), &Value::Int(n)));
                                window.push(sum);
                            }
                        }
                        Op::LocalAddInt(i, n) => {
                            let (i, n) = (i as usize, i64::from(n));
                            if !window.local_add_int(i, n) {
                                let local = &window.slots[i];
                                let sum = compute!(0, number::add(local, &Value::Int(n)));
                                window.push(sum);
                            }
                        }
                        Op::AddToLocal(i, n) => {
                            let (i, n) = (i as usize, i64::from(n));
                            if !window.add_to_local(i, n) {
                                let local = &window.slots[i];
                                let sum = compute!(0, number::add(local, &Value::Int(n)));
                                window.slots[i] = sum;
                            }
                            pc += 1;
                        }
                        Op::Compare(comparison) => {
                            let (a, b) = window.two();
                            let holds = if let Some((a, b)) = both_ints((a, b)) {
                                window.top -= 2;
                                comparison.holds(a, b)
                            } else {
                                compute!(2, number::compare_like(comparison, a, b))
                            };
                            window.push_bool(holds);
                        }
                        Op::Element(sym) => {
                            if !window.element(sym) {
                                break 'call (sym, 2, false);
                            }
                        }
                        Op::LocalElement {
                            is_simple,
                            vector,
                            index,
                        } => {
                            let (vector, index) = (usize::from(vector), usize::from(index));
                            if !window.local_element(is_simple, vector, index) {
                                window.two_locals(vector, index);
                                let sym = if is_simple { known::SVREF } else { known::AREF };
                                break 'call (sym, 2, false);
                            }
                        }
                        Op::SetLocalElement { vector, index } => {
                            let (vector, index) = (usize::from(vector), usize::from(index));
                            if window.set_local_element(vector, index) {
                                pc += 4;
                            }
                        }
                        Op::SetElement(sym) => {
                            if !window.set_element() {
                                note!();
                                called!(self.call_setf_function(sym, 3, budget));
                            }
                        }

                        Op::BindSpecial(sym) => {
                            let value = &mut window.slots[window.top - 1];
                            check!(check_value(self.image, sym, value));
                            window.top -= 1;
                            bind(self.image, &mut fiber.dynamic, sym, value);
                        }
                        Op::PopDynamic(n) => {
                            let length = fiber.dynamic.len() - n as usize;
                            undo(self.image, &mut fiber.dynamic, length);
                        }
                        Op::Progv => {
                            note!();
                            if let Err(raise) = self.progv() {
                                return self.raise(raise);
                            }
                            continue 'frame;
                        }
                        Op::EndProgv => slowly!(self.end_progv()),
                        Op::EnterBlock { target, multi } => {
                            let entries = (&mut fiber.dynamic, &fiber.frames);
                            enter_block(self.image, entries, &mut window, (target, multi));
                        }
                        Op::EnterTagbody(table) => {
                            let entries = (&mut fiber.dynamic, &fiber.frames);
                            enter_tagbody(self.image, entries, &mut window, table);
                        }
                        Op::EnterCatch { target, multi } => {
                            let entries = (&mut fiber.dynamic, &fiber.frames);
                            enter_catch(entries, &mut window, (target, multi));
                        }
                        Op::EnterUnwind(target) => {
                            let entries = (&mut fiber.dynamic, &fiber.frames);
                            enter_unwind(entries, &window, target);
                        }
                        Op::LeaveUnwind => {
                            // No exit is pending.
                            fiber.dynamic.pop();
                            window.push_int(0);
                        }
                        Op::EnterHandlers(types, count) => {
                            let types = content.constants[types as usize].clone();
                            note!();
                            if let Err(raise) = self.enter_handlers(&types, count) {
                                return self.raise(raise);
                            }
                            continue 'frame;
                        }
                        Op::EnterRestarts => slowly!(self.enter_restarts()),
                        Op::ReturnFrom => {
                            note!();
                            let id = self.pop();
                            let value = self.pop();
                            leave!(self.return_from(&id, value));
                        }
                        Op::Throw => {
                            note!();
                            let next = self.throw_top();
                            // As after a jump through closures.
                            *budget -= 1;
                            if *budget == 0 {
                                return self.or_interrupt(next, budget);
                            }
                            leave!(next);
                        }
                        Op::Go(tag) => {
                            note!();
                            let id = self.pop();
                            let next = self.go(&id, tag);
                            // A loop through closures can be interrupted, too.
                            *budget -= 1;
                            if *budget == 0 {
                                return self.or_interrupt(next, budget);
                            }
                            leave!(next);
                        }
                        Op::EndCleanup => {
                            let unwinding = matches!(window.pop(), Value::Int(1));
                            if unwinding {
                                window.drop_top();
                                note!();
                                leave!(self.continue_unwinding());
                            }
                        }
                    }
                    continue 'operation;
                };

                // A call of a symbol's function with the topmost values.
                let FunctionCell::Function(called) = &self.image.symbols.get(sym).function else {
                    note!();
                    return self.call_undefined(sym.into(), usize::from(count));
                };
                let pure = match &called.body {
                    Body::Closure { code, .. }
                        if code.exact_count == Some(count) && fiber.frames.len() < MAX_FRAMES =>
                    {
                        enter!(called, usize::from(count), 0, multi)
                    }
                    Body::Native(native) if native.accepts(usize::from(count)) => {
                        let pure = self.image.pure_call(native);
                        pure.map(|pure| (pure, native.name))
                    }
                    _ => None,
                };
                let Some((pure, name)) = pure else {
                    let called = called.clone();
                    note!();
                    called!(self.call_any(called, usize::from(count), 0, multi, budget))
                };
                let start = window.top - usize::from(count);
                noted.set(pc);
                window.close_below(start);
                self.image.wants_all = multi;
                let result = pure(self.image, &window.slots[start..window.top]);
                self.image.wants_all = true;
                match result {
                    Ok(value) => window.return_value(start, value, multi),
                    Err(raise) => {
                        window.close();
                        let start = self.fiber.stack.len() - usize::from(count);
                        return self.failed(name, raise, start, start, multi);
                    }
                }
                if self.image.output.is_due() {
                    window.close();
                    return Next::Stop(Event::Output);
                }
            }
        }
    }
}
