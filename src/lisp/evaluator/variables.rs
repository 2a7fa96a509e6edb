//! Operations on variables: locals, free variables, their boxes, global names, closures.

use std::rc::Rc;

use crate::image::Image;
use crate::types::standard_variables::check_value;
use crate::value::Value;
use crate::value::code::{Capture, Content};
use crate::value::cycles;
use crate::value::function::Function;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::shared_slot::SharedSlot;
use crate::value::symbol::{FunctionCell, Sym};
use crate::vm::stack::Window;

impl Window<'_> {
    /// Pushes a local.
    #[inline(always)]
    pub(super) fn local(&mut self, i: usize) {
        let (used, room) = self.slots.split_at_mut(self.top);
        used[i].copy_into(&mut room[0]);
        self.top += 1;
    }

    /// Pushes two locals.
    #[inline(always)]
    pub(super) fn two_locals(&mut self, a: usize, b: usize) {
        let (used, room) = self.slots.split_at_mut(self.top);
        let [first, second, ..] = room else {
            unreachable!("code has room for what it pushes");
        };
        used[a].copy_into(first);
        used[b].copy_into(second);
        self.top += 2;
    }

    /// Pushes what a local's box holds.
    #[inline(always)]
    pub(super) fn local_box(&mut self, i: usize) {
        let (used, room) = self.slots.split_at_mut(self.top);
        unboxed_into(&used[i], &mut room[0]);
        self.top += 1;
    }

    /// Pops into a local.
    #[inline(always)]
    pub(super) fn set_local(&mut self, i: usize) {
        self.top -= 1;
        let (below, top) = self.slots.split_at_mut(self.top);
        top[0].move_to(&mut below[i]);
    }

    /// Pops into a local's box.
    #[inline(always)]
    pub(super) fn set_local_box(&mut self, i: usize) {
        let value = self.pop();
        if let Value::Cell(cell) = &self.slots[i] {
            cycles::note(cell, &value);
            cell.set(value);
        }
    }

    /// Puts a local into a fresh box.
    #[inline(always)]
    pub(super) fn make_box(&mut self, i: usize) {
        let place = &mut self.slots[i];
        let value = std::mem::take(place);
        place.fill(Value::Cell(Rc::new(SharedSlot::new(value))));
    }

    /// Was a parameter supplied?
    #[inline(always)]
    pub(super) fn is_supplied(&self, i: usize) -> bool {
        !self.slots[i].is_unbound()
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
    pub(super) fn global(&mut self, image: &Image, sym: Sym) -> Result<(), Box<Raise>> {
        let value = &image.symbols.get(sym).value;
        if value.is_unbound() {
            return Err(Raise::unbound_variable(sym));
        }
        value.copy_into(self.next());
        Ok(())
    }

    /// Pops into a global or special variable.
    #[inline(always)]
    pub(super) fn set_global(&mut self, image: &mut Image, sym: Sym) -> Result<(), Box<Raise>> {
        let value = &mut self.slots[self.top - 1];
        check_value(image, sym, value)?;
        self.top -= 1;
        value.move_to(&mut image.symbols.get_mut(sym).value);
        Ok(())
    }

    /// Pops the values of a call and pushes exactly `count` of them.
    #[inline(always)]
    pub(super) fn spread(&mut self, count: u32) {
        let values = self.pop();
        let start = self.top;
        self.top += count as usize;
        spread_into(values, &mut self.slots[start..self.top]);
    }
}

/// Stores the values of a call, as many as there are places, where there is nothing to free.
fn spread_into(values: Value, places: &mut [Value]) {
    match values {
        Value::Multiple(values) => {
            for (i, place) in places.iter_mut().enumerate() {
                place.fill(values.get(i).cloned().unwrap_or(Value::NIL));
            }
        }
        single => {
            if let [first, others @ ..] = places {
                first.fill(single);
                others.iter_mut().for_each(|place| place.fill(Value::NIL));
            }
        }
    }
}

/// A symbol's global function.
pub(super) fn function(image: &Image, sym: Sym) -> Result<Value, Box<Raise>> {
    match &image.symbols.get(sym).function {
        FunctionCell::Function(f) => Ok(Value::Function(f.clone())),
        _ => Err(Raise::undefined_function(sym.into())),
    }
}

/// The function of `(setf symbol)`.
pub(super) fn setf_function(image: &Image, sym: Sym) -> Result<Value, Box<Raise>> {
    match &image.symbols.get(sym).setf_function {
        Some(f) => Ok(Value::Function(f.clone())),
        None => {
            let name = Value::list([known::SETF.into(), sym.into()]);
            Err(Raise::undefined_function(name))
        }
    }
}

/// A closure over the inner code number `i`.
pub(super) fn closure(
    content: &Content,
    i: usize,
    slots: &[Value],
    captured: &[Value],
) -> Rc<Function> {
    let (inner, captures) = &content.inner[i];
    let values = captures
        .iter()
        .map(|capture| match capture {
            Capture::Local(slot) => slots[*slot as usize].clone(),
            Capture::Free(i) => captured[*i as usize].clone(),
        })
        .collect();
    Rc::new(Function::closure(inner.clone(), values))
}

/// Stores a copy of the contents of a box, or of any other value as it is, where there is nothing to
/// free.
#[inline(always)]
pub(super) fn unboxed_into(value: &Value, place: &mut Value) {
    match value {
        Value::Cell(cell) => cell.copy_into(place),
        other => other.copy_into(place),
    }
}
