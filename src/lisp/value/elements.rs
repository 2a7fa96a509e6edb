//! The elements of an array: its own, or a part of those of another one, to which it is displaced.

use std::cell::RefCell;
use std::mem::take;

use super::Value;
use super::release::release_values;

/// The elements of an array in row-major order.
pub struct Elements(RefCell<Place>);

enum Place {
    Own(Vec<Value>),
    Displaced(Displacement),
}

/// A part of the elements of another array.
#[derive(Clone)]
pub(crate) struct Displacement {
    /// The array that has them; it may be displaced itself.
    pub target: Value,
    /// Index of the first of them in row-major order.
    pub offset: usize,
    /// How many they are.
    pub size: usize,
}

impl Displacement {
    /// The element at an index.
    pub(super) fn get(&self, index: usize) -> Option<Value> {
        let (array, at) = self.holder(index)?;
        match array {
            Value::Vector(vector) => vector.items.get(at),
            Value::Array(array) => array.items.get(at),
            Value::Str(string) => string.element(at).map(Value::Char),
            _ => None,
        }
    }

    /// Replaces the element at an index; false if there is none, or if it cannot be stored.
    pub(super) fn set(&self, index: usize, value: Value) -> bool {
        match (self.holder(index), value) {
            (Some((Value::Vector(vector), at)), value) => vector.items.set(at, value),
            (Some((Value::Array(array), at)), value) => array.items.set(at, value),
            (Some((Value::Str(string), at)), Value::Char(c)) => string.set_element(at, c),
            _ => false,
        }
    }

    /// The array that has an element as its own, and the element's index there.
    pub(crate) fn holder(&self, index: usize) -> Option<(Value, usize)> {
        let mut step = self.clone();
        let mut at = index;
        loop {
            if at >= step.size {
                return None;
            }
            at += step.offset;
            match displacement(&step.target) {
                Some(next) => step = next,
                None => return Some((step.target.clone(), at)),
            }
        }
    }

    /// Does the array have its elements from this one, directly or not?
    pub(crate) fn leads_to(&self, array: &Value) -> bool {
        let mut step = self.clone();
        loop {
            if step.target.is_eq(array) {
                return true;
            }
            match displacement(&step.target) {
                Some(next) => step = next,
                None => return false,
            }
        }
    }
}

impl Drop for Displacement {
    fn drop(&mut self) {
        release_values(vec![take(&mut self.target)]);
    }
}

/// What part of which array an array consists of, if it is displaced.
pub(crate) fn displacement(array: &Value) -> Option<Displacement> {
    match array {
        Value::Vector(vector) => vector.items.displacement(),
        Value::Array(array) => array.items.displacement(),
        Value::Str(string) => string.displacement(),
        _ => None,
    }
}

impl Elements {
    /// Elements of its own.
    pub fn new(items: Vec<Value>) -> Elements {
        Elements(RefCell::new(Place::Own(items)))
    }

    /// Elements of its own from now on.
    pub fn own(&self, items: Vec<Value>) {
        drop(self.0.replace(Place::Own(items)));
    }

    /// A part of another array's elements from now on.
    pub(crate) fn displace(&self, displacement: Displacement) {
        drop(self.0.replace(Place::Displaced(displacement)));
    }

    /// What part of which array these elements are, if they are displaced.
    pub(crate) fn displacement(&self) -> Option<Displacement> {
        match &*self.0.borrow() {
            Place::Own(_) => None,
            Place::Displaced(displacement) => Some(displacement.clone()),
        }
    }

    /// Are they a part of another array's elements?
    #[inline]
    pub(crate) fn is_displaced(&self) -> bool {
        matches!(&*self.0.borrow(), Place::Displaced(_))
    }

    /// Whether there are no elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of elements.
    #[inline]
    pub fn len(&self) -> usize {
        match &*self.0.borrow() {
            Place::Own(items) => items.len(),
            Place::Displaced(displacement) => displacement.size,
        }
    }

    /// The element at an index.
    #[inline]
    pub fn get(&self, index: usize) -> Option<Value> {
        match &*self.0.borrow() {
            Place::Own(items) => items.get(index).cloned(),
            Place::Displaced(displacement) => displacement.get(index),
        }
    }

    /// Stores a copy of the element at an index where there is nothing to free; false if there is none.
    #[inline(always)]
    pub(crate) fn copy_into(&self, index: usize, place: &mut Value) -> bool {
        match &*self.0.borrow() {
            Place::Own(items) => match items.get(index) {
                Some(item) => item.copy_into(place),
                None => return false,
            },
            Place::Displaced(displacement) => match displacement.get(index) {
                Some(item) => place.fill(item),
                None => return false,
            },
        }
        true
    }

    /// Replaces an element of the array's own by a value that is moved out of its place; false, and the
    /// value stays, if it has none at that index.
    #[inline(always)]
    pub(crate) fn move_into(&self, index: usize, value: &mut Value) -> bool {
        let mut place = self.0.borrow_mut();
        let Place::Own(items) = &mut *place else {
            return false;
        };
        let Some(item) = items.get_mut(index) else {
            return false;
        };
        if item.is_plain() {
            value.move_into(item);
        } else {
            let old = std::mem::replace(item, take(value));
            // It may hold whatever looks at the array when it is freed.
            drop(place);
            drop(old);
        }
        true
    }

    /// Replaces the element at an index; false if there is none.
    #[inline]
    pub fn set(&self, index: usize, value: Value) -> bool {
        let old = match &mut *self.0.borrow_mut() {
            Place::Own(items) => match items.get_mut(index) {
                Some(item) => std::mem::replace(item, value),
                None => return false,
            },
            Place::Displaced(displacement) => return displacement.set(index, value),
        };
        drop(old);
        true
    }

    /// A copy of so many elements from the first one on.
    pub fn copied(&self, count: usize) -> Vec<Value> {
        match &*self.0.borrow() {
            Place::Own(items) => items.iter().take(count).cloned().collect(),
            Place::Displaced(displacement) => (0..displacement.size.min(count))
                .map(|index| displacement.get(index).unwrap_or(Value::NIL))
                .collect(),
        }
    }

    /// A copy of all elements.
    pub fn to_vec(&self) -> Vec<Value> {
        self.copied(usize::MAX)
    }

    /// Gives the array so many elements of its own, new ones being fillers.
    pub fn resize(&self, count: usize, filler: Value) {
        if let Place::Own(items) = &mut *self.0.borrow_mut() {
            items.resize(count, filler);
            return;
        }
        let mut items = self.to_vec();
        items.resize(count, filler);
        self.own(items);
    }

    /// What the array holds: its own elements, or the array that has them.
    pub fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        match self.0.try_borrow().as_deref() {
            Ok(Place::Own(items)) => items.iter().for_each(visit),
            Ok(Place::Displaced(displacement)) => visit(&displacement.target),
            Err(_) => {}
        }
    }

    /// Shows each of the array's own elements, which may be replaced.
    pub fn change(&self, change: impl FnMut(&mut Value)) {
        if let Place::Own(items) = &mut *self.0.borrow_mut() {
            items.iter_mut().for_each(change);
        }
    }

    /// Takes everything out.
    pub fn empty(&self) {
        self.own(Vec::new());
    }
}

impl Drop for Elements {
    fn drop(&mut self) {
        if let Place::Own(items) = self.0.get_mut() {
            release_values(take(items));
        }
    }
}
