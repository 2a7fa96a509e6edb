//! Searching in lists and association lists: `member` and `assoc`.

use super::criterion::{Compare, Criterion, Key, Test};
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::ListWalk;
use crate::vm::calls::{Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// What matches an item.
fn criterion(
    image: &Image,
    item: Value,
    key: Option<Value>,
    test: Option<Value>,
    test_not: Option<Value>,
) -> Result<Criterion, Box<Raise>> {
    let test = Test::new(image, test, test_not)?;
    Ok(Criterion::item(item, test, Key::new(image, key)?))
}

/// The same without calls of functions.
fn find_tail_at_once(item: &Value, test: Compare, list: Value) -> Outcome {
    let mut walk = ListWalk::new(list);
    while let Some(cons) = walk.next_cons()? {
        if test(item, &cons.car()) {
            return Ok(Value::Cons(cons));
        }
    }
    Ok(Value::NIL)
}

async fn find_tail(calls: Calls, criterion: Criterion, list: Value) -> Outcome {
    let mut walk = ListWalk::new(list);
    while let Some(cons) = walk.next_cons()? {
        if criterion.accepts(&calls, &cons.car()).await {
            return Ok(Value::Cons(cons));
        }
    }
    Ok(Value::NIL)
}

/// The list from the first element that matches an item, or `NIL`.
///
/// `(member 2 '(1 2 3))` => `(2 3)`
/// `(member "b" '("a" "b") :test #'equal)` => `("b")`
#[builtin]
fn member(
    machine: &mut Machine<'_>,
    item: Value,
    list: Value,
    #[key] key: Option<Value>,
    #[key] test: Option<Value>,
    #[key] test_not: Option<Value>,
) -> Result<Step, Box<Raise>> {
    let criterion = criterion(machine.image, item, key, test, test_not)?;
    if let Some((item, test)) = criterion.simple() {
        return Ok(find_tail_at_once(item, test, list)?.into());
    }
    run(machine, "MEMBER", |calls| find_tail(calls, criterion, list))
}

/// The same without calls of functions.
fn find_entry_at_once(item: &Value, test: Compare, alist: Value) -> Outcome {
    let mut walk = ListWalk::new(alist);
    while let Some(entry) = walk.next()? {
        match &entry {
            Value::Symbol(known::NIL, ..) => {}
            Value::Cons(pair) => {
                if test(item, &pair.car()) {
                    return Ok(entry);
                }
            }
            other => return Err(Raise::type_error(other, known::LIST)),
        }
    }
    Ok(Value::NIL)
}

async fn find_entry(calls: Calls, criterion: Criterion, alist: Value) -> Outcome {
    let mut walk = ListWalk::new(alist);
    while let Some(entry) = walk.next()? {
        match &entry {
            Value::Symbol(known::NIL, ..) => {}
            Value::Cons(pair) => {
                if criterion.accepts(&calls, &pair.car()).await {
                    return Ok(entry);
                }
            }
            other => return Err(Raise::type_error(other, known::LIST)),
        }
    }
    Ok(Value::NIL)
}

/// The first entry of an association list whose car matches an item.
///
/// `(assoc 'b '((a . 1) (b . 2)))` => `(B . 2)`
#[builtin]
fn assoc(
    machine: &mut Machine<'_>,
    item: Value,
    alist: Value,
    #[key] key: Option<Value>,
    #[key] test: Option<Value>,
    #[key] test_not: Option<Value>,
) -> Result<Step, Box<Raise>> {
    let criterion = criterion(machine.image, item, key, test, test_not)?;
    if let Some((item, test)) = criterion.simple() {
        return Ok(find_entry_at_once(item, test, alist)?.into());
    }
    run(machine, "ASSOC", |calls| {
        find_entry(calls, criterion, alist)
    })
}

/// Searching in lists.
pub(crate) static TABLE: &[Builtin] = builtins![member, assoc,];
