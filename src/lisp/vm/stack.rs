//! The values of a fiber.
//!
//! The places beyond the height are there already for the next values. So running code, which says
//! how many places it needs, has a window onto the stack that does not move, and pushing is to
//! store. There is nothing to free in these places: what was popped has left behind no reference.

use std::cell::Cell;
use std::mem::take;
use std::ops::{Deref, DerefMut};

use crate::value::Value;

/// A stack of values; as a slice, it is those that are in use.
#[derive(Default)]
pub struct Stack {
    places: Vec<Value>,
    height: Cell<usize>,
}

/// The places of the code that runs, from the base of its frame on.
pub(crate) struct Window<'a> {
    /// Its slots, and the room for what it pushes.
    pub slots: &'a mut [Value],
    /// The number of those that are in use.
    pub top: usize,
    base: usize,
    height: &'a Cell<usize>,
}

/// Places that a stack has at least, once it is used.
const FEWEST: usize = 16;

impl Stack {
    /// The places from `base` on, of which at least `room` are there.
    #[inline(always)]
    pub(crate) fn window(&mut self, base: usize, room: usize) -> Window<'_> {
        if self.places.len() < base + room {
            self.grow(base + room);
        }
        let top = self.height.get() - base;
        Window {
            slots: &mut self.places[base..],
            top,
            base,
            height: &self.height,
        }
    }

    /// Makes so many places at least: often more, so that it happens seldom.
    #[cold]
    #[inline(never)]
    fn grow(&mut self, least: usize) {
        let count = least.max(FEWEST).max(2 * self.places.len());
        self.places.resize(count, Value::Unbound);
    }

    /// How many values it has places for.
    pub(crate) fn room(&self) -> usize {
        self.places.len()
    }

    /// Pushes a value.
    #[inline]
    pub fn push(&mut self, value: Value) {
        let height = self.height.get();
        if height == self.places.len() {
            self.grow(height + 1);
        }
        self.places[height].fill(value);
        self.height.set(height + 1);
    }

    /// Pushes values.
    pub fn extend(&mut self, values: impl IntoIterator<Item = Value>) {
        for value in values {
            self.push(value);
        }
    }

    /// Pushes "no value" up to a height.
    pub(crate) fn fill_up(&mut self, height: usize) {
        while self.height.get() < height {
            self.push(Value::Unbound);
        }
    }

    /// Pops the top value.
    #[inline]
    pub fn pop(&mut self) -> Option<Value> {
        let top = self.height.get().checked_sub(1)?;
        self.height.set(top);
        Some(take(&mut self.places[top]))
    }

    /// Drops values down to a height.
    pub fn truncate(&mut self, height: usize) {
        for top in (height..self.height.get()).rev() {
            self.height.set(top);
            self.places[top].clear();
        }
    }

    /// Takes out the values from a height on.
    pub fn split_off(&mut self, height: usize) -> Vec<Value> {
        let above = self.places[height..self.height.get()].iter_mut();
        let above = above.map(take).collect();
        self.height.set(height);
        above
    }

    /// Drops all values.
    pub fn clear(&mut self) {
        self.truncate(0);
    }

    /// Drops what the code that ran, and was left, still had above the height.
    pub(crate) fn clear_above(&mut self) {
        self.places[self.height.get()..]
            .iter_mut()
            .for_each(Value::clear);
    }

    /// Moves the top value down to a height, and drops what is between. False, and nothing is done, if
    /// it is several values, of which perhaps not all are wanted.
    #[inline(always)]
    pub(crate) fn lower_top(&mut self, to: usize) -> bool {
        let top = self.height.get() - 1;
        let (below, at) = self.places.split_at_mut(top);
        let [value, ..] = at else {
            return false;
        };
        if matches!(value, Value::Multiple(_)) {
            return false;
        }
        let below = &mut below[to..];
        for place in below.iter_mut() {
            place.clear();
        }
        if let [place, ..] = below {
            value.move_into(place);
        }
        self.height.set(to + 1);
        true
    }
}

impl Deref for Stack {
    type Target = [Value];

    fn deref(&self) -> &[Value] {
        &self.places[..self.height.get()]
    }
}

impl DerefMut for Stack {
    fn deref_mut(&mut self) -> &mut [Value] {
        &mut self.places[..self.height.get()]
    }
}

impl Window<'_> {
    /// The height of the stack.
    #[inline(always)]
    pub(crate) fn height(&self) -> usize {
        self.base + self.top
    }

    /// Notes the height in the stack, for others who look at it.
    #[inline(always)]
    pub(crate) fn close(&self) {
        self.height.set(self.height());
    }

    /// Notes a lower height: the values above it are still there, but would be gone if the code were
    /// left now.
    #[inline(always)]
    pub(crate) fn close_below(&self, top: usize) {
        self.height.set(self.base + top);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::rc::Rc;

    #[test]
    fn what_code_that_was_left_has_above_the_height_is_dropped() {
        let object = Rc::new(Vec::new());
        let mut stack = Stack::default();
        stack.push(Value::Int(1));
        let mut window = stack.window(0, 8);
        for slot in &mut window.slots[1..4] {
            slot.fill(Value::Multiple(object.clone()));
        }
        window.top = 4;
        window.close_below(2);
        stack.clear_above();
        assert_eq!((stack.len(), Rc::strong_count(&object)), (2, 2));
        stack.truncate(1);
        assert_eq!(Rc::strong_count(&object), 1);
    }

    #[test]
    fn the_top_is_lowered_over_what_is_dropped() {
        let mut stack = Stack::default();
        stack.extend([Value::Int(1), Value::list([Value::T]), Value::T]);
        stack.push(Value::Int(2));
        assert!(stack.lower_top(1));
        assert_eq!(stack.len(), 2);
        assert!(stack[1].is_eq(&Value::Int(2)));
        stack.push(Value::Multiple(Rc::default()));
        assert!(!stack.lower_top(0));
        assert_eq!(stack.len(), 3);
    }
}
