//! Arrays: one-dimensional ones with an optional fill pointer, and those of other ranks.

use std::cell::{Cell, RefCell};

use super::Value;
use super::release::release_values;
use super::symbol::{Sym, known};

/// A one-dimensional array.
pub(crate) struct Vector {
    /// All elements, those beyond the fill pointer included.
    pub(crate) items: RefCell<Vec<Value>>,
    /// Number of active elements, if the vector has a fill pointer.
    pub(crate) fill_pointer: Cell<Option<usize>>,
    /// May the vector grow?
    pub(crate) adjustable: bool,
    /// `T`, or the element type the vector was made with (`BIT`, `DOUBLE-FLOAT`, …).
    pub(crate) element_type: Sym,
}

impl Vector {
    /// A simple vector.
    pub(crate) fn simple(items: Vec<Value>) -> Vector {
        Vector::of_type(known::T, items)
    }

    /// A vector of an element type, without fill pointer.
    pub(crate) fn of_type(element_type: Sym, items: Vec<Value>) -> Vector {
        Vector {
            items: RefCell::new(items),
            fill_pointer: Cell::new(None),
            adjustable: false,
            element_type,
        }
    }

    /// Number of active elements.
    pub(crate) fn len(&self) -> usize {
        self.fill_pointer
            .get()
            .unwrap_or_else(|| self.items.borrow().len())
    }

    /// The element at an index, whether or not the fill pointer covers it.
    pub(crate) fn get(&self, index: usize) -> Option<Value> {
        self.items.borrow().get(index).cloned()
    }

    /// Replaces the element at an index; false if there is none.
    pub(crate) fn set(&self, index: usize, value: Value) -> bool {
        match self.items.borrow_mut().get_mut(index) {
            Some(item) => {
                *item = value;
                true
            }
            None => false,
        }
    }

    /// A copy of the active elements.
    pub(crate) fn to_vec(&self) -> Vec<Value> {
        let items = self.items.borrow();
        items.iter().take(self.len()).cloned().collect()
    }
}

/// An array whose rank is not one.
pub(crate) struct Array {
    /// Size of each dimension.
    pub(crate) dimensions: RefCell<Vec<usize>>,
    /// May its dimensions change?
    pub(crate) adjustable: bool,
    /// The elements, the last index running fastest.
    pub(crate) items: RefCell<Vec<Value>>,
    /// `T`, or the element type the array was made with.
    pub(crate) element_type: Sym,
}

impl Drop for Vector {
    fn drop(&mut self) {
        release_values(self.items.take());
    }
}

impl Drop for Array {
    fn drop(&mut self) {
        release_values(self.items.take());
    }
}
