//! Calls that the loop does not make itself: of functions that are computed, that take their arguments in
//! another way than on the stack, or that there are not; and returns to what is no code.

use std::rc::Rc;

use super::entry::Next;
use crate::value::Value;
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::frames::Frame;
use crate::vm::machine::Machine;

impl Machine<'_> {
    /// Calls the function below the topmost arguments. Returns whether code goes on in the topmost
    /// frame, or else what comes next. So do the following ones.
    pub(super) fn call_top(
        &mut self,
        count: usize,
        multi: bool,
        budget: &mut u32,
    ) -> Result<(), Next> {
        let cut = self.fiber.stack.len() - count - 1;
        match self.image.coerce_to_function(&self.fiber.stack[cut]) {
            Ok(called) => self.call_any(called, count, 1, multi, budget),
            Err(raise) => {
                self.fiber.stack.truncate(cut);
                Err(self.raise(raise))
            }
        }
    }

    /// Calls the function of `(setf symbol)` with the topmost arguments.
    pub(super) fn call_setf_function(
        &mut self,
        sym: Sym,
        count: usize,
        budget: &mut u32,
    ) -> Result<(), Next> {
        match self.image.symbols.get(sym).setf_function.clone() {
            Some(called) => self.call_any(called, count, 0, false, budget),
            None => {
                let name = Value::list([known::SETF.into(), sym.into()]);
                Err(self.call_undefined(name, count))
            }
        }
    }

    /// Calls any function with the topmost arguments; its value replaces these and what is `below`
    /// them.
    pub(super) fn call_any(
        &mut self,
        called: Rc<Function>,
        count: usize,
        below: usize,
        multi: bool,
        budget: &mut u32,
    ) -> Result<(), Next> {
        *budget -= 1;
        let cut = self.fiber.stack.len() - count - below;
        match self.call_on_stack(called, count, cut, multi) {
            Next::Run if *budget > 0 && !self.image.output.is_due() => Ok(()),
            next => Err(self.or_interrupt(next, budget)),
        }
    }

    #[cold]
    pub(super) fn call_undefined(&mut self, name: Value, count: usize) -> Next {
        let cut = self.fiber.stack.len() - count;
        self.fiber.stack.truncate(cut);
        self.raise(Raise::undefined_function(name))
    }

    /// Returns the top value to what made the call, whose frame is the topmost one now.
    pub(super) fn return_values(&mut self, cut: usize, multi: bool) -> Next {
        let value = self.pop();
        self.fiber.stack.truncate(cut);
        let value = if multi { value } else { value.primary() };
        if !self.fiber.frames.last().is_some_and(Frame::is_of_code) {
            return Next::Deliver(value);
        }
        self.fiber.stack.push(value);
        Next::Run
    }
}
