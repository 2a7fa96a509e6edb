//! Freeing values of any depth and any size: in a loop, whatever contains what, and a part at a
//! time, so that nobody waits for the end of millions of objects.
//!
//! A container hands over what it holds when it is dropped. If one is being freed already, its
//! contents only join a queue; so the Rust stack does not grow with the depth of a structure. What
//! is left after a while stays in the queue until the machine looks after it between operations
//! ([`some`]), or until all is to be freed ([`all`]).

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::mem::ManuallyDrop;
use std::rc::Rc;

use super::Value;
use super::cons::{self, Cons};
use super::cycles;
use super::foreign::Foreign;
use super::spare;

/// What a container held.
pub(super) enum Dead {
    Values(Vec<Value>),
    Conses(Vec<Rc<Cons>>),
    Object(Box<dyn Foreign>),
    /// Something else that holds values, and about how many objects that are.
    Others(Box<dyn Any>, usize),
}

thread_local! {
    /// What has not been freed yet; what is left in it at the end of the thread never is. Nothing runs
    /// at the end of the thread, so values may be dropped even then, by other variables of the thread.
    static QUEUE: RefCell<ManuallyDrop<Vec<Dead>>> =
        const { RefCell::new(ManuallyDrop::new(Vec::new())) };
    /// Is something being freed?
    static IS_FREEING: Cell<bool> = const { Cell::new(false) };
}

/// Objects that are freed before the rest stays in the queue: some milliseconds' worth.
const AT_ONCE: usize = 100_000;

/// Frees what a container held, or some of it.
pub(super) fn release(dead: Dead) {
    if IS_FREEING.replace(true) {
        QUEUE.with_borrow_mut(|queue| queue.push(dead));
        return;
    }
    let spent = free(dead);
    free_queue(AT_ONCE.saturating_sub(spent));
    IS_FREEING.set(false);
}

/// Keeps pairs in the queue that a loop has not come to.
pub(super) fn put_off(conses: Vec<Rc<Cons>>) {
    QUEUE.with_borrow_mut(|queue| queue.push(Dead::Conses(conses)));
}

/// Keeps something in the queue that holds values, about so many.
pub(crate) fn put_off_others(others: impl Any, count: usize) {
    QUEUE.with_borrow_mut(|queue| queue.push(Dead::Others(Box::new(others), count)));
}

/// Frees some of what is in the queue.
pub fn some() {
    if QUEUE.with_borrow(|queue| queue.is_empty()) || IS_FREEING.replace(true) {
        return;
    }
    free_queue(AT_ONCE);
    IS_FREEING.set(false);
}

/// Frees everything that is in the queue; was there anything?
pub fn all() -> bool {
    let is_waiting = || !QUEUE.with_borrow(|queue| queue.is_empty()) && !IS_FREEING.get();
    let was_waiting = is_waiting();
    while is_waiting() {
        some();
    }
    was_waiting
}

fn free_queue(mut budget: usize) {
    while budget > 0 {
        let Some(dead) = QUEUE.with_borrow_mut(|queue| queue.pop()) else {
            return;
        };
        budget = budget.saturating_sub(free(dead));
    }
}

/// Frees what a container held; returns about how many objects that were.
fn free(dead: Dead) -> usize {
    match dead {
        Dead::Values(values) => {
            let count = values.len();
            drop(values);
            count + 1
        }
        Dead::Conses(conses) => cons::free(conses, AT_ONCE),
        Dead::Object(object) => {
            drop(object);
            1
        }
        Dead::Others(others, count) => {
            drop(others);
            count
        }
    }
}

/// Could dropping the value free other containers?
pub(super) fn owns(value: &Value) -> bool {
    matches!(
        value,
        Value::Instance(_)
            | Value::Cons(_)
            | Value::Vector(_)
            | Value::Array(_)
            | Value::Hash(_)
            | Value::Function(_)
            | Value::Foreign(_)
            | Value::Cell(_)
            | Value::Multiple(_)
            | Value::Stream(_)
    )
}

/// Releases values if one of them owns others.
pub(super) fn release_values(values: Vec<Value>) {
    if values.iter().any(owns) {
        release(Dead::Values(values));
    }
}

/// Frees everything when it is dropped, what holds each other, and the room in which this thread
/// keeps what is out of use. The image that it belongs to is to be dropped before it.
#[derive(Default)]
pub struct FreesAll;

impl Drop for FreesAll {
    fn drop(&mut self) {
        all();
        // What circles have held may have held others.
        loop {
            cycles::collect_last();
            if !all() {
                break;
            }
        }
        spare::empty();
        QUEUE.with_borrow_mut(|queue| queue.shrink_to_fit());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Image;
    use crate::value::function::Function;
    use crate::value::hash_table::{HashTable, HashTest};
    use crate::value::shared_slot::SharedSlot;

    #[test]
    fn structures_of_any_depth_are_freed_without_recursion() {
        let code = crate::compile::compile_form(&mut Image::new(), &Value::NIL)
            .unwrap_or_else(|_| unreachable!());
        let mut chain = Value::NIL;
        for i in 0..1_000_000 {
            chain = match i % 5 {
                0 => Value::vector(vec![chain]),
                1 => Value::list([chain]),
                2 => Value::Cell(Rc::new(SharedSlot::new(chain))),
                3 => Value::Function(Rc::new(Function::closure(code.clone(), vec![chain]))),
                _ => {
                    let table = HashTable::new(HashTest::Eql);
                    table.insert(Value::Int(i), chain);
                    Value::Hash(Rc::new(table))
                }
            };
        }
        drop(chain);
        all();
        assert_eq!(Rc::strong_count(&code), 1);
    }
}
