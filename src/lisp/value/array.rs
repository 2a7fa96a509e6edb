//! Arrays: one-dimensional ones with an optional fill pointer, and those of other ranks.

use std::cell::{Cell, RefCell};

use super::Value;
use super::cycles::Mark;
use super::element_type::ElementType;
use super::elements::Elements;

/// A one-dimensional array.
pub struct Vector {
    /// All elements, those beyond the fill pointer included.
    pub items: Elements,
    /// Number of active elements, if the vector has a fill pointer.
    pub(crate) fill_pointer: Cell<Option<usize>>,
    /// May the vector grow?
    pub adjustable: bool,
    /// The type of the elements.
    pub(crate) element_type: ElementType,
    pub(crate) mark: Mark,
}

impl Vector {
    /// A simple vector.
    pub fn simple(items: Vec<Value>) -> Vector {
        Vector::of_type(ElementType::T, items)
    }

    /// A vector of an element type, without fill pointer.
    pub fn of_type(element_type: ElementType, items: Vec<Value>) -> Vector {
        Vector {
            items: Elements::new(items),
            fill_pointer: Cell::new(None),
            adjustable: false,
            element_type,
            mark: Mark::default(),
        }
    }

    /// Number of active elements.
    pub fn len(&self) -> usize {
        self.fill_pointer.get().unwrap_or_else(|| self.items.len())
    }

    /// Whether there are no active elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The element at an index, whether or not the fill pointer covers it.
    pub fn get(&self, index: usize) -> Option<Value> {
        self.items.get(index)
    }

    /// Stores a copy of the element at an index where there is nothing to free; false if there is none.
    #[inline(always)]
    pub(crate) fn copy_into(&self, index: usize, place: &mut Value) -> bool {
        self.items.copy_into(index, place)
    }

    /// Replaces the element at an index by a value that is moved out of its place; false, and the value
    /// stays, if there is none.
    #[inline(always)]
    pub(crate) fn move_into(&self, index: usize, value: &mut Value) -> bool {
        self.items.move_into(index, value)
    }

    /// Replaces the element at an index; false if there is none.
    pub fn set(&self, index: usize, value: Value) -> bool {
        self.items.set(index, value)
    }

    /// A copy of the active elements.
    pub fn to_vec(&self) -> Vec<Value> {
        self.items.copied(self.len())
    }

    /// Is it simple and its element type `T`, so that it takes any value?
    #[inline]
    pub(crate) fn is_general_simple(&self) -> bool {
        self.element_type == ElementType::T && self.is_simple()
    }

    /// Is the vector neither adjustable nor displaced, and without fill pointer?
    pub(crate) fn is_simple(&self) -> bool {
        self.fill_pointer.get().is_none() && !self.adjustable && !self.items.is_displaced()
    }
}

/// An array whose rank is not one.
pub struct Array {
    /// Size of each dimension.
    pub dimensions: RefCell<Vec<usize>>,
    /// May its dimensions change?
    pub adjustable: bool,
    /// The elements, the last index running fastest.
    pub items: Elements,
    /// The type of the elements.
    pub(crate) element_type: ElementType,
    pub(crate) mark: Mark,
}

impl Array {
    /// An array that is not adjustable.
    pub fn new(element_type: ElementType, dimensions: Vec<usize>, items: Vec<Value>) -> Array {
        Array {
            dimensions: RefCell::new(dimensions),
            adjustable: false,
            items: Elements::new(items),
            element_type,
            mark: Mark::default(),
        }
    }

    /// Is the array neither adjustable nor displaced?
    pub(crate) fn is_simple(&self) -> bool {
        !self.adjustable && !self.items.is_displaced()
    }
}
