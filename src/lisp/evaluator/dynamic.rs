//! Operations that make and undo dynamic entries: bindings, exits, cleanup code, handlers,
//! restarts.

use std::rc::Rc;

use crate::lisp::value::Value;
use crate::lisp::value::code::Code;
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::symbol::Sym;
use crate::lisp::vm::fiber::{Dynamic, Handler};
use crate::lisp::vm::machine::Machine;

impl Machine<'_> {
    /// Binds a special variable.
    pub(super) fn bind_special(&mut self, sym: Sym, value: Value) {
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

    /// Pops a list of values and a list of symbols, and binds the symbols.
    pub(super) fn progv(&mut self) -> Result<(), Box<Raise>> {
        let values = self.pop();
        let symbols = self.pop();
        self.fiber.dynamic.push(Dynamic::ProgvMark);
        let mut values = values.iter_list();
        for symbol in symbols.iter_list() {
            match symbol.as_symbol() {
                Some(sym) => self.bind_special(sym, values.next().unwrap_or(Value::Unbound)),
                None => return Err(Raise::type_error(&symbol, known::SYMBOL)),
            }
        }
        Ok(())
    }

    /// Undoes the dynamic entries beyond the innermost `progv` mark, and the mark.
    pub(super) fn end_progv(&mut self) {
        let mut entries = self.fiber.dynamic.iter();
        let mark = entries.rposition(|d| matches!(d, Dynamic::ProgvMark));
        self.drop_dynamic(mark.unwrap_or(0));
    }

    /// Undoes the innermost `count` dynamic entries.
    pub(super) fn pop_dynamic(&mut self, count: u32) {
        let length = self.fiber.dynamic.len() - count as usize;
        self.drop_dynamic(length);
    }

    /// Enters a block that closures may leave: pushes its identity.
    pub(super) fn enter_block(&mut self, target: u32, multi: bool) {
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

    /// Enters a tagbody that closures may jump into: pushes its identity.
    pub(super) fn enter_tagbody(&mut self, table: u32) {
        let id = self.image.fresh_identity();
        self.fiber.stack.push(Value::Int(id));
        self.fiber.dynamic.push(Dynamic::Tagbody {
            id,
            frame: self.fiber.frames.len() - 1,
            height: self.fiber.stack.len(),
            table,
        });
    }

    /// Pops a tag and establishes a catch.
    pub(super) fn enter_catch(&mut self, target: u32, multi: bool) {
        let tag = self.pop();
        self.fiber.dynamic.push(Dynamic::Catch {
            tag,
            frame: self.fiber.frames.len() - 1,
            height: self.fiber.stack.len(),
            target,
            multi,
        });
    }

    /// Protects what follows with the cleanup code at the target.
    pub(super) fn enter_unwind(&mut self, target: u32) {
        self.fiber.dynamic.push(Dynamic::Unwind {
            frame: self.fiber.frames.len() - 1,
            height: self.fiber.stack.len(),
            target,
        });
    }

    /// Leaves the protected form normally: pushes the mark that no exit is pending.
    pub(super) fn leave_unwind(&mut self) {
        self.fiber.dynamic.pop();
        self.fiber.stack.push(Value::Int(0));
    }

    /// Pops `count` handler functions and establishes them with the types in a constant.
    pub(super) fn enter_handlers(&mut self, code: &Code, types: u32, count: u16) {
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

    /// Pops a list of restarts and establishes them.
    pub(super) fn enter_restarts(&mut self) {
        let list = self.pop();
        self.fiber.dynamic.push(Dynamic::Restarts(list));
    }
}
