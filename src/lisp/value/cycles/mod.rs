//! Finding values that hold each other and that nobody else holds, which counting references
//! alone never frees.
//!
//! Every circle has an object that was changed after it was made, to hold another one: its
//! variable, element, half or slot was assigned. Those objects are noted ([`note`]), as weak
//! references. Once in a while the machine has them examined between two operations
//! ([`collect_if_due`]): what can be reached from them is walked, and the references found on the
//! way are counted. An object with more references than that is held from elsewhere, and so is
//! all that can be reached from it; the rest is freed. No roots need to be known for that.
//!
//! Most circles are short-lived. So a collection of the young looks only at what no earlier one has
//! found alive; it is due when many objects have been noted. A full one looks at everything; it is due
//! when much more memory is in use than after the last one, when much is held by few objects
//! ([`press`]), and before memory is said to be exhausted ([`collect_all`]).

mod collection;
mod mark;
mod references;
mod suspect;

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use self::collection::{Collection, Extent};
pub use self::mark::Mark;
use self::references::is_walked;
pub use self::suspect::Suspect;
use super::Value;
use super::foreign::ForeignBox;
use super::symbol::SymbolTable;
use crate::guard;

/// Noted objects at which the young are first examined.
const FIRST: usize = 10_000;
/// Old noted objects at which everything is first examined.
const FIRST_OLD: usize = 50_000;
/// Objects that a collection of the young walks for each that was noted, on average.
const SHARE: usize = 16;
/// Bytes by which the memory in use has to grow from one full collection to the next, at least.
const GROWTH: usize = 8 << 20;

/// When collections are due.
struct Schedule {
    /// Noted objects that earlier collections have found alive.
    old: RefCell<Vec<Suspect>>,
    /// The number of noted objects at which the young are examined.
    young_due: Cell<usize>,
    /// The number of old ones at which everything is.
    old_due: Cell<usize>,
    /// The bytes in use at which everything is; none before they are first known.
    bytes_due: Cell<Option<usize>>,
    /// Bytes that few objects hold, since the last full collection.
    pressure: Cell<usize>,
    is_collecting: Cell<bool>,
}

thread_local! {
    static SUSPECTS: RefCell<Vec<Suspect>> = const { RefCell::new(Vec::new()) };
    static SCHEDULE: Schedule = const {
        Schedule {
            old: RefCell::new(Vec::new()),
            young_due: Cell::new(FIRST),
            old_due: Cell::new(FIRST_OLD),
            bytes_due: Cell::new(None),
            pressure: Cell::new(0),
            is_collecting: Cell::new(false),
        }
    };
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

/// Notes that a symbol that may be freed has been given a value, a function or a property.
pub(super) fn note_symbol(suspect: Suspect) {
    let _ = SUSPECTS.try_with(|suspects| suspects.borrow_mut().push(suspect));
}

/// Notes that an object has been made that holds so many bytes, which no number of objects tells.
pub fn press(bytes: usize) {
    let _ = SCHEDULE.try_with(|schedule| {
        schedule
            .pressure
            .set(schedule.pressure.get().saturating_add(bytes));
    });
}

/// Examines objects if that is due. `in_use` are the bytes in use, if they are known.
#[inline]
pub(crate) fn collect_if_due(symbols: &mut SymbolTable, in_use: Option<usize>) {
    if SUSPECTS.with_borrow(Vec::len) >= SCHEDULE.with(|schedule| schedule.young_due.get()) {
        collect(Extent::Young, Some(symbols), true);
    }
    if SCHEDULE.with(|schedule| schedule.is_full_due(in_use)) {
        collect(Extent::Full, Some(symbols), true);
    }
}

/// Examines everything if that is overdue: for functions that work so long that the machine, which also
/// knows the symbols, does not get to it.
pub(crate) fn collect_if_overdue(in_use: Option<usize>) {
    let overdue = |schedule: &Schedule| {
        let due = schedule.bytes_due.get();
        matches!((in_use, due), (Some(bytes), Some(due)) if bytes >= due + GROWTH)
    };
    if SCHEDULE.try_with(overdue) == Ok(true) {
        collect(Extent::Full, None, true);
    }
}

/// Frees all circles; false if somebody wanted to interrupt that.
pub fn collect_all(symbols: Option<&mut SymbolTable>) -> bool {
    collect(Extent::Full, symbols, true)
}

/// Frees all circles at the end of a thread's last image.
pub(super) fn collect_last() {
    collect(Extent::Full, None, false);
    let _ = SUSPECTS.try_with(|suspects| suspects.borrow_mut().shrink_to_fit());
    let _ = SCHEDULE.try_with(|schedule| schedule.old.borrow_mut().shrink_to_fit());
}

impl Schedule {
    fn is_full_due(&self, in_use: Option<usize>) -> bool {
        let is_much = match (in_use, self.bytes_due.get()) {
            (Some(bytes), Some(due)) => bytes >= due,
            (Some(bytes), None) => {
                self.bytes_due.set(Some(bytes + bytes.max(GROWTH)));
                false
            }
            (None, _) => false,
        };
        is_much || self.pressure.get() >= GROWTH || self.old.borrow().len() >= self.old_due.get()
    }

    /// Sets when the next full collection is due, after one that ended or was given up.
    fn set_due(&self, is_done: bool) {
        let old = self.old.borrow().len();
        self.old_due.set((2 * old).max(FIRST_OLD));
        self.pressure.set(0);
        // One that was given up would only be given up again if it began at once.
        let grown = |bytes: usize| {
            bytes
                + if is_done {
                    (bytes / 2).max(GROWTH)
                } else {
                    GROWTH
                }
        };
        self.bytes_due.set(guard::memory_in_use().map(grown));
    }
}

/// Examines the noted objects; false if that was given up.
fn collect(
    extent: Extent,
    mut symbols: Option<&mut SymbolTable>,
    may_be_interrupted: bool,
) -> bool {
    // At the end of the thread nobody knows them any more.
    let is_first = SCHEDULE.try_with(|schedule| !schedule.is_collecting.replace(true));
    if is_first != Ok(true) {
        return false;
    }
    let mut suspects = SUSPECTS.try_with(RefCell::take).unwrap_or_default();
    suspects.retain(Suspect::is_alive);
    if extent == Extent::Full {
        let mut old = SCHEDULE
            .try_with(|schedule| schedule.old.take())
            .unwrap_or_default();
        old.retain(Suspect::is_alive);
        suspects.append(&mut old);
    }
    let mut collection = Collection::new(extent, symbols.as_deref_mut());
    if !may_be_interrupted {
        collection = collection.uninterrupted();
    }
    let outcome = collection.run(&suspects);
    if extent == Extent::Full
        && let Some(symbols) = symbols
    {
        symbols.free_forsaken();
    }
    suspects.retain(Suspect::is_alive);
    let count = suspects.len();
    let _ = SCHEDULE.try_with(|schedule| {
        schedule.is_collecting.set(false);
        match &outcome {
            Ok(walked) => schedule.young_due.set(FIRST.max(walked / SHARE)),
            Err(_) => schedule.young_due.set(2 * count.max(FIRST)),
        }
        if outcome.is_ok() || extent == Extent::Full {
            schedule.old.borrow_mut().append(&mut suspects);
        }
        if extent == Extent::Full {
            schedule.set_due(outcome.is_ok());
        }
    });
    // Freeing may have noted others meanwhile.
    let _ = SUSPECTS.try_with(|noted| noted.borrow_mut().append(&mut suspects));
    outcome.is_ok()
}

#[cfg(test)]
mod tests {
    use std::rc::Weak;
    use std::sync::atomic::Ordering;

    use super::*;
    use crate::guard::Limits;
    use crate::value::array::Vector;
    use crate::value::cons::Cons;
    use crate::value::hash_table::{HashTable, HashTest};
    use crate::value::shared_slot::SharedSlot;

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
        collect_all(None);
        assert_eq!(weak.strong_count(), 2);
        drop(held);
        assert_eq!(weak.strong_count(), 1);
        collect_all(None);
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn what_a_held_object_reaches_is_kept() {
        let (inner, weak) = circle(Value::Int(1));
        let (outer, _) = circle(inner);
        collect_all(None);
        assert_eq!(weak.strong_count(), 2);
        drop(outer);
        collect_all(None);
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn circles_through_all_kinds_of_objects() {
        let table = Rc::new(HashTable::new(HashTest::Equal));
        let slot = Rc::new(SharedSlot::new(Value::Hash(table.clone())));
        let vector = Rc::new(Vector::simple(vec![Value::Cell(slot.clone())]));
        let value = Value::Vector(vector.clone());
        table.insert(Value::list([value.clone()]), Value::Hash(table.clone()));
        note(&table, &value);
        let weak = Rc::downgrade(&vector);
        drop((table, slot, vector));
        collect_all(None);
        assert_eq!(weak.strong_count(), 2, "{}", "it is held here");
        drop(value);
        collect_all(None);
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn a_mark_makes_no_pair_larger() {
        assert_eq!(size_of::<Cons>(), 40);
    }

    #[test]
    fn circles_of_any_size_are_freed() {
        for size in [2, 8, 1_000_000] {
            let first = Rc::new(Cons::new(Value::Int(0), Value::NIL));
            let list = (1..size).fold(Value::Cons(first.clone()), |rest, i| {
                Value::cons(Value::Int(i), rest)
            });
            first.set_cdr(list.clone());
            note(&first, &list);
            let weak = Rc::downgrade(&first);
            drop((first, list));
            assert_eq!(weak.strong_count(), 1);
            collect_all(None);
            assert_eq!(weak.strong_count(), 0, "{size}");
        }
    }

    #[test]
    fn a_circle_that_has_survived_is_freed_by_a_full_collection() {
        let (held, weak) = circle(Value::NIL);
        assert!(collect(Extent::Young, None, true));
        drop(held);
        assert!(collect(Extent::Young, None, true));
        assert_eq!(weak.strong_count(), 1);
        collect_all(None);
        assert_eq!(weak.strong_count(), 0);
    }

    #[test]
    fn what_is_being_changed_is_kept() {
        let table = Rc::new(HashTable::new(HashTest::Eql));
        let (inner, weak) = circle(Value::NIL);
        table.insert(Value::Int(1), inner);
        table.insert(Value::Int(2), Value::Hash(table.clone()));
        note(&table, &Value::Hash(table.clone()));
        {
            let _changing = table.entries();
            collect_all(None);
        }
        assert_eq!(weak.strong_count(), 2);
        let weak_table = Rc::downgrade(&table);
        drop(table);
        collect_all(None);
        assert_eq!((weak.strong_count(), weak_table.strong_count()), (0, 0));
    }

    #[test]
    fn an_interrupt_ends_a_collection_which_is_made_up_for_later() {
        let limits = Rc::new(Limits::default());
        let _watch = limits.watch();
        let list = Value::list((0..100_000).map(|i| Value::list([Value::Int(i)])));
        let (held, weak) = circle(list);
        drop(held);
        limits.polls.flag().store(true, Ordering::Relaxed);
        assert!(!collect_all(None));
        assert_eq!(weak.strong_count(), 1);
        limits.polls.flag().store(false, Ordering::Relaxed);
        assert!(collect_all(None));
        assert_eq!(weak.strong_count(), 0);
    }
}
