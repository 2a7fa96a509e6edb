//! Operations that make and undo dynamic entries: bindings, exits, cleanup code, handlers,
//! restarts.

use std::rc::Rc;

use super::matching::check_type;
use crate::image::Image;
use crate::types::standard_variables::check_value;
use crate::value::Value;
use crate::value::known;
use crate::value::placing::push_made;
use crate::value::raise::Raise;
use crate::value::symbol::Sym;
use crate::vm::fiber::{Dynamic, Handler};
use crate::vm::frames::Frames;
use crate::vm::machine::Machine;

impl Machine<'_> {
    /// Pops the top value.
    pub(super) fn pop(&mut self) -> Value {
        self.fiber.stack.pop().unwrap_or_default()
    }

    /// Pops a list of values and a list of symbols, and binds the symbols.
    pub(super) fn progv(&mut self) -> Result<(), Box<Raise>> {
        let values = self.pop();
        let symbols = self.pop();
        self.fiber.dynamic.push(Dynamic::ProgvMark);
        let mut values = values.iter_list();
        for symbol in symbols.iter_list() {
            match symbol.as_symbol() {
                Some(sym) => {
                    let mut value = values.next().unwrap_or(Value::Unbound);
                    check_value(self.image, sym, &value)?;
                    bind(self.image, &mut self.fiber.dynamic, sym, &mut value);
                }
                None => return Err(Raise::type_error(&symbol, known::SYMBOL)),
            }
        }
        Ok(())
    }

    /// Undoes the dynamic entries beyond the innermost `progv` mark, and the mark.
    pub(super) fn end_progv(&mut self) {
        let mut entries = self.fiber.dynamic.iter();
        let mark = entries.rposition(|d| matches!(d, Dynamic::ProgvMark));
        undo(self.image, &mut self.fiber.dynamic, mark.unwrap_or(0));
    }

    /// Pops `count` handler functions and establishes them with these types.
    pub(super) fn enter_handlers(&mut self, types: &Value, count: u16) -> Result<(), Box<Raise>> {
        let start = self.fiber.stack.len() - usize::from(count);
        let handlers: Rc<[Handler]> = types
            .iter_list()
            .zip(self.fiber.stack.split_off(start))
            .map(|(condition_type, function)| Handler {
                condition_type,
                function,
            })
            .collect();
        for handler in handlers.iter() {
            check_type(self.image, &handler.condition_type)?;
        }
        self.fiber.dynamic.push(Dynamic::Handlers(handlers));
        Ok(())
    }

    /// Pops a list of restarts and establishes them.
    pub(super) fn enter_restarts(&mut self) {
        let list = self.pop();
        self.fiber.dynamic.push(Dynamic::Restarts(list));
    }
}

/// Establishes something whose extent begins now.
#[inline(always)]
pub(super) fn establish(fiber: (&mut Vec<Dynamic>, &Frames), make: impl FnOnce(usize) -> Dynamic) {
    let (dynamic, frames) = fiber;
    // It belongs to the frame of the code that runs.
    let frame = frames.len() - 1;
    push_made(dynamic, || make(frame));
}

/// Binds a special variable to a value that is moved out of its place.
#[inline(always)]
pub(super) fn bind(image: &mut Image, dynamic: &mut Vec<Dynamic>, sym: Sym, value: &mut Value) {
    let place = &mut image.symbols.get_mut(sym).value;
    let mut outside = std::mem::take(place);
    value.move_into(place);
    push_made(dynamic, || Dynamic::Bind(sym, std::mem::take(&mut outside)));
}

/// Drops dynamic entries beyond `length`, restoring special variables. There is no cleanup code
/// among them.
#[inline(always)]
pub(super) fn undo(image: &mut Image, dynamic: &mut Vec<Dynamic>, length: usize) {
    while dynamic.len() > length {
        if let Some(Dynamic::Bind(sym, outside)) = dynamic.pop() {
            image.symbols.get_mut(sym).value = outside;
        }
    }
}
