//! Finding values that hold each other and that nobody else holds, which counting references
//! alone never frees.
//!
//! Every circle has an object that was changed after it was made, to hold another one: its
//! variable, element, half or slot was assigned. Those objects are noted ([`note`]), as weak
//! references. When there are many, the machine has them examined between two operations
//! ([`collect_if_due`]): what can be reached from them is walked, and the references found on the
//! way are counted. An object with more references than that is held from elsewhere, and so is
//! all that can be reached from it; the rest is freed. No roots need to be known for that, and a
//! part that was not walked only means that less is freed.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::{Rc, Weak};

use super::Value;
use super::array::{Array, Vector};
use super::class::Instance;
use super::cons::Cons;
use super::foreign::ForeignBox;
use super::function::Body;
use super::hash_table::HashTable;
use super::slot::Slot;

/// An object that may be a part of a circle.
pub enum Suspect {
    Cons(Weak<Cons>),
    Cell(Weak<Slot>),
    Vector(Weak<Vector>),
    Array(Weak<Array>),
    Hash(Weak<HashTable>),
    Instance(Weak<Instance>),
    Foreign(Weak<ForeignBox>),
}

/// Suspects at which they are first examined.
const FIRST: usize = 10_000;
/// References that are followed between two operations: some hundredths of a second's worth.
const MOST: usize = 200_000;

thread_local! {
    static SUSPECTS: RefCell<Vec<Suspect>> = const { RefCell::new(Vec::new()) };
    /// The number of suspects at which they are examined.
    static DUE: Cell<usize> = const { Cell::new(FIRST) };
}

/// Notes that an object has been assigned a value. Objects that are noted already have a weak
/// reference.
#[inline(always)]
pub fn note<T>(object: &Rc<T>, assigned: &Value)
where
    for<'a> Suspect: From<&'a Rc<T>>,
{
    if !assigned.is_plain() {
        note_suspect(object, assigned);
    }
}

#[inline(never)]
fn note_suspect<T>(object: &Rc<T>, assigned: &Value)
where
    for<'a> Suspect: From<&'a Rc<T>>,
{
    if is_walked(assigned) && Rc::weak_count(object) == 0 {
        let suspect = Suspect::from(object);
        // At the end of the thread nothing is examined any more.
        let _ = SUSPECTS.try_with(|suspects| suspects.borrow_mut().push(suspect));
    }
}

/// Notes that an object of another layer has been changed to hold a value.
pub fn note_foreign(object: &Rc<ForeignBox>) {
    // Such objects may have weak references of their own.
    if !object.is_suspect.replace(true) {
        let suspect = Suspect::from(object);
        let _ = SUSPECTS.try_with(|suspects| suspects.borrow_mut().push(suspect));
    }
}

/// Notes an object that gets a weak reference: without this it would be taken for one that is noted.
pub(super) fn note_watched(object: &Value) {
    macro_rules! note_unless_noted {
        ($($kind:ident)*) => {
            match object {
                $(Value::$kind(object) if Rc::weak_count(object) == 0 => {
                    let suspect = Suspect::from(object);
                    let _ = SUSPECTS.try_with(|suspects| suspects.borrow_mut().push(suspect));
                })*
                _ => {}
            }
        };
    }
    note_unless_noted!(Cons Cell Vector Array Hash Instance);
}

/// Notes the copy of an object if the object itself may be noted.
pub(super) fn note_copy(original: &Value, copy: &Value) {
    macro_rules! note_if_noted {
        ($($kind:ident)*) => {
            match (original, copy) {
                $((Value::$kind(original), Value::$kind(copy)) if Rc::weak_count(original) > 0 => {
                    let suspect = Suspect::from(copy);
                    let _ = SUSPECTS.try_with(|suspects| suspects.borrow_mut().push(suspect));
                })*
                (Value::Foreign(original), Value::Foreign(copy)) if original.is_suspect.get() => {
                    note_foreign(copy);
                }
                _ => {}
            }
        };
    }
    note_if_noted!(Cons Cell Vector Array Hash Instance);
}

macro_rules! suspects {
    ($($kind:ident $type:ty,)*) => {$(
        impl From<&Rc<$type>> for Suspect {
            fn from(object: &Rc<$type>) -> Suspect {
                Suspect::$kind(Rc::downgrade(object))
            }
        }
    )*

        impl Suspect {
            fn object(&self) -> Option<Value> {
                Some(match self {
                    $(Suspect::$kind(weak) => Value::$kind(weak.upgrade()?),)*
                })
            }

            fn is_alive(&self) -> bool {
                match self {
                    $(Suspect::$kind(weak) => weak.strong_count() > 0,)*
                }
            }
        }
    };
}

suspects! {
    Cons Cons,
    Cell Slot,
    Vector Vector,
    Array Array,
    Hash HashTable,
    Instance Instance,
    Foreign ForeignBox,
}

/// Examines the suspects if there are many.
pub(crate) fn collect_if_due() {
    if SUSPECTS.with_borrow(Vec::len) >= DUE.get() {
        collect(MOST);
    }
}

/// Examines all suspects and whatever can be reached from them.
pub(crate) fn collect_all() {
    collect(usize::MAX);
}

fn collect(most: usize) {
    // At the end of the thread nobody knows them any more.
    let suspects = SUSPECTS.try_with(RefCell::take).unwrap_or_default();
    let mut graph = Graph::default();
    // The newest ones first: most circles are short-lived.
    for suspect in suspects.iter().rev() {
        if let Some(object) = suspect.object() {
            graph.find(&object);
        }
    }
    graph.walk(most);
    graph.free();
    let _ = SUSPECTS.try_with(|new| {
        let mut new = new.borrow_mut();
        // Freeing may have noted others meanwhile.
        let survivors = suspects.into_iter().filter(Suspect::is_alive);
        let newer = std::mem::take(&mut *new);
        new.extend(survivors.chain(newer));
        DUE.set((2 * new.len()).max(FIRST));
    });
}

/// What can be reached from the suspects.
#[derive(Default)]
struct Graph {
    /// Where an object stands among the nodes, by address.
    places: HashMap<usize, usize>,
    nodes: Vec<Node>,
}

struct Node {
    object: Value,
    /// References to it that were found.
    found: usize,
    /// Are its own references known?
    is_walked: bool,
    is_alive: bool,
}

impl Graph {
    /// The place of an object, which becomes a node unless it is one.
    fn find(&mut self, object: &Value) -> usize {
        let nodes = &mut self.nodes;
        *self.places.entry(address(object)).or_insert_with(|| {
            nodes.push(Node {
                object: object.clone(),
                found: 0,
                is_walked: false,
                is_alive: false,
            });
            nodes.len() - 1
        })
    }

    /// Follows references until all are known, or so many.
    fn walk(&mut self, most: usize) {
        let mut budget = most;
        let mut next = 0;
        while next < self.nodes.len() && budget > 0 {
            let object = self.nodes[next].object.clone();
            let count = size(&object);
            if count <= budget {
                budget -= count;
                for_each_reference(&object, &mut |held| {
                    let place = self.find(held);
                    self.nodes[place].found += 1;
                });
                self.nodes[next].is_walked = true;
            }
            next += 1;
        }
    }

    /// Frees the objects that are held by none but each other.
    fn free(mut self) {
        let is_held = |node: &Node| !node.is_walked || strong_count(&node.object) > node.found + 1;
        let mut pending: Vec<usize> = Vec::new();
        for (place, node) in self.nodes.iter_mut().enumerate() {
            if is_held(node) {
                node.is_alive = true;
                pending.push(place);
            }
        }
        while let Some(place) = pending.pop() {
            if !self.nodes[place].is_walked {
                continue;
            }
            let object = self.nodes[place].object.clone();
            for_each_reference(&object, &mut |held| {
                if let Some(place) = self.places.get(&address(held))
                    && !self.nodes[*place].is_alive
                {
                    self.nodes[*place].is_alive = true;
                    pending.push(*place);
                }
            });
        }
        for node in self.nodes.iter().filter(|node| !node.is_alive) {
            empty(&node.object);
        }
    }
}

/// Is the value an object whose references are followed?
#[inline]
fn is_walked(value: &Value) -> bool {
    matches!(
        value,
        Value::Cons(_)
            | Value::Cell(_)
            | Value::Function(_)
            | Value::Instance(_)
            | Value::Vector(_)
            | Value::Hash(_)
            | Value::Array(_)
    ) || matches!(value, Value::Foreign(object) if object.object().may_be_in_circle())
}

fn for_each_reference(object: &Value, visit: &mut dyn FnMut(&Value)) {
    let mut visit = |held: &Value| {
        if is_walked(held) {
            visit(held);
        }
    };
    match object {
        Value::Cons(cons) => cons.for_each(&mut visit),
        Value::Cell(slot) => slot.with(visit),
        Value::Function(function) => {
            if let Body::Closure { captured, .. } = &function.body {
                captured.iter().for_each(visit);
            }
        }
        Value::Instance(instance) => instance.slots.borrow().iter().for_each(visit),
        Value::Vector(vector) => vector.items.for_each_reference(&mut visit),
        Value::Array(array) => array.items.for_each_reference(&mut visit),
        Value::Hash(table) => table.for_each_reference(&mut visit),
        Value::Foreign(object) => object.object().for_each_reference(&mut visit),
        _ => {}
    }
}

/// About how many references an object has.
fn size(object: &Value) -> usize {
    match object {
        Value::Vector(vector) => vector.items.len() + 1,
        Value::Array(array) => array.items.len() + 1,
        Value::Hash(table) => 3 * table.len() + 1,
        _ => 3,
    }
}

fn address(object: &Value) -> usize {
    match object {
        Value::Cons(r) => Rc::as_ptr(r).addr(),
        Value::Cell(r) => Rc::as_ptr(r).addr(),
        Value::Function(r) => Rc::as_ptr(r).addr(),
        Value::Instance(r) => Rc::as_ptr(r).addr(),
        Value::Vector(r) => Rc::as_ptr(r).addr(),
        Value::Array(r) => Rc::as_ptr(r).addr(),
        Value::Hash(r) => Rc::as_ptr(r).addr(),
        Value::Foreign(r) => Rc::as_ptr(r).addr(),
        _ => 0,
    }
}

fn strong_count(object: &Value) -> usize {
    match object {
        Value::Cons(r) => Rc::strong_count(r),
        Value::Cell(r) => Rc::strong_count(r),
        Value::Function(r) => Rc::strong_count(r),
        Value::Instance(r) => Rc::strong_count(r),
        Value::Vector(r) => Rc::strong_count(r),
        Value::Array(r) => Rc::strong_count(r),
        Value::Hash(r) => Rc::strong_count(r),
        Value::Foreign(r) => Rc::strong_count(r),
        _ => usize::MAX,
    }
}

/// Takes everything out of an object that nobody can see any more. Closures cannot be changed;
/// the boxes that they hold are emptied.
fn empty(object: &Value) {
    match object {
        Value::Cons(cons) => cons.empty(),
        Value::Cell(slot) => drop(slot.take()),
        Value::Instance(instance) => drop(instance.slots.take()),
        Value::Vector(vector) => vector.items.empty(),
        Value::Array(array) => array.items.empty(),
        Value::Hash(table) => table.clear(),
        Value::Foreign(object) => object.object().let_go(),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::value::hash_table::HashTest;

    /// A pair that holds itself, and a weak reference to it.
    fn circle(car: Value) -> (Value, Weak<Cons>) {
        let cons = Rc::new(Cons::new(car, Value::NIL));
        let value = Value::Cons(cons.clone());
        cons.set_cdr(value.clone());
        note(&cons, &value);
        let weak = Rc::downgrade(&cons);
        (value, weak)
    }

    #[test]
    fn a_circle_is_freed_once_nobody_holds_it() {
        let (held, weak) = circle(Value::NIL);
        collect_all();
        assert_eq!(weak.strong_count(), 2);
        drop(held);
        assert_eq!(weak.strong_count(), 1);
        collect_all();
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn what_a_held_object_reaches_is_kept() {
        let (inner, weak) = circle(Value::Int(1));
        let (outer, _) = circle(inner);
        collect_all();
        assert_eq!(weak.strong_count(), 2);
        drop(outer);
        collect_all();
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn circles_through_all_kinds_of_objects() {
        let table = Rc::new(HashTable::new(HashTest::Equal));
        let slot = Rc::new(Slot::new(Value::Hash(table.clone())));
        let vector = Rc::new(Vector::simple(vec![Value::Cell(slot.clone())]));
        let value = Value::Vector(vector.clone());
        table.insert(Value::list([value.clone()]), Value::Hash(table.clone()));
        note(&table, &value);
        let weak = Rc::downgrade(&vector);
        drop((table, slot, vector));
        collect_all();
        assert_eq!(weak.strong_count(), 2, "{}", "it is held here");
        drop(value);
        collect_all();
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn what_is_too_large_to_be_walked_is_kept() {
        let (held, weak) = circle(Value::vector(vec![Value::NIL; 100]));
        drop(held);
        collect(50);
        // The vector in it was not walked, but nothing leads from it back.
        assert_eq!(weak.strong_count(), 0);
        let vector = Rc::new(Vector::simple(vec![Value::NIL; 100]));
        vector.set(0, Value::Vector(vector.clone()));
        note(&vector, &Value::Vector(vector.clone()));
        let weak = Rc::downgrade(&vector);
        drop(vector);
        collect(50);
        assert_eq!(weak.strong_count(), 1);
        collect_all();
        assert_eq!(weak.strong_count(), 0);
    }
}
