//! Operations on variables: locals, free variables, their boxes, global names, closures.

use std::rc::Rc;

use crate::lisp::value::Value;
use crate::lisp::value::code::{Capture, Code};
use crate::lisp::value::cycles;
use crate::lisp::value::function::Function;
use crate::lisp::value::known;
use crate::lisp::value::placing::push_made;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::slot::Slot;
use crate::lisp::value::symbol::{FunctionCell, Sym};
use crate::lisp::vm::machine::Machine;

impl Machine<'_> {
    /// Pushes a local.
    #[inline(always)]
    pub(super) fn local(&mut self, at: usize) {
        // As `Value::push_copy`, from a place in the stack itself.
        let stack = &mut self.fiber.stack;
        match &stack[at] {
            &Value::Int(n) => push_made(stack, || Value::Int(n)),
            Value::Cons(cons) => {
                let cons = cons.clone();
                push_made(stack, || Value::Cons(cons));
            }
            &Value::Symbol(sym, ref hold) if hold.is_none() => {
                push_made(stack, || Value::symbol(sym));
            }
            _ => self.local_of_other_kind(at),
        }
    }

    #[inline(never)]
    fn local_of_other_kind(&mut self, at: usize) {
        let value = self.fiber.stack[at].clone();
        self.fiber.stack.push(value);
    }

    /// Pushes what a local's box holds.
    #[inline(always)]
    pub(super) fn local_box(&mut self, at: usize) {
        match &self.fiber.stack[at] {
            Value::Cell(cell) => {
                // Another reference to the box, since the stack that it stands in is pushed on.
                let cell = cell.clone();
                cell.push_copy(&mut self.fiber.stack);
            }
            _ => self.local(at),
        }
    }

    /// Pops into a local.
    #[inline(always)]
    pub(super) fn set_local(&mut self, at: usize) {
        if let Some((top, below)) = self.fiber.stack.split_last_mut() {
            top.move_to(&mut below[at]);
        }
        self.drop_top();
    }

    /// Pops into a local's box.
    #[inline(always)]
    pub(super) fn set_local_box(&mut self, at: usize) {
        let value = self.pop();
        if let Value::Cell(cell) = &self.fiber.stack[at] {
            cycles::note(cell, &value);
            cell.set(value);
        }
    }

    /// Puts a local into a fresh box.
    #[inline(always)]
    pub(super) fn make_box(&mut self, at: usize) {
        let place = &mut self.fiber.stack[at];
        let value = std::mem::take(place);
        *place = Value::Cell(Rc::new(Slot::new(value)));
    }

    /// Was a parameter supplied?
    #[inline(always)]
    pub(super) fn is_supplied(&self, at: usize) -> bool {
        !self.fiber.stack[at].is_unbound()
    }

    /// Pops into a free variable's box.
    #[inline(always)]
    pub(super) fn set_free_box(&mut self, free: &Value) {
        let value = self.pop();
        if let Value::Cell(cell) = free {
            cycles::note(cell, &value);
            cell.set(value);
        }
    }

    /// Pushes the value of a global or special variable.
    #[inline(always)]
    pub(super) fn global(&mut self, sym: Sym) -> Result<(), Box<Raise>> {
        let value = &self.image.symbols.get(sym).value;
        if value.is_unbound() {
            return Err(Raise::unbound_variable(sym));
        }
        value.push_copy(&mut self.fiber.stack);
        Ok(())
    }

    /// Pops into a global or special variable.
    #[inline(always)]
    pub(super) fn set_global(&mut self, sym: Sym) {
        let value = self.pop();
        self.image.symbols.get_mut(sym).value = value;
    }

    /// Pushes a symbol's global function.
    pub(super) fn function(&mut self, sym: Sym) -> Result<(), Box<Raise>> {
        match &self.image.symbols.get(sym).function {
            FunctionCell::Function(f) => {
                self.fiber.stack.push(Value::Function(f.clone()));
                Ok(())
            }
            _ => Err(Raise::undefined_function(sym.into())),
        }
    }

    /// Pushes the function of `(setf symbol)`.
    pub(super) fn setf_function(&mut self, sym: Sym) -> Result<(), Box<Raise>> {
        match &self.image.symbols.get(sym).setf_function {
            Some(f) => {
                self.fiber.stack.push(Value::Function(f.clone()));
                Ok(())
            }
            None => {
                let name = Value::list([known::SETF.into(), sym.into()]);
                Err(Raise::undefined_function(name))
            }
        }
    }

    /// Pushes a closure over the inner code number `i`.
    pub(super) fn closure(&mut self, code: &Code, i: usize, base: usize, captured: &[Value]) {
        let (inner, captures) = &code.inner[i];
        let values = captures
            .iter()
            .map(|capture| match capture {
                Capture::Local(slot) => self.fiber.stack[base + *slot as usize].clone(),
                Capture::Free(i) => captured[*i as usize].clone(),
            })
            .collect();
        let closure = Rc::new(Function::closure(inner.clone(), values));
        self.fiber.stack.push(Value::Function(closure));
    }
}

/// Pushes the contents of a box; any other value as it is.
#[inline(always)]
pub(super) fn push_unboxed(value: &Value, stack: &mut Vec<Value>) {
    match value {
        Value::Cell(cell) => cell.push_copy(stack),
        other => other.push_copy(stack),
    }
}
