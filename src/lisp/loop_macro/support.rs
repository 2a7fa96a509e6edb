//! Functions that loops call when they run.

use std::rc::Rc;

use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::array::Vector;
use crate::value::cons::Cons;
use crate::value::known;
use crate::value::number;
use crate::value::package::PackageTable;
use crate::value::raise::Raise;
use crate::value::sequence::Sequence;
use crate::value::sequence::last_pair;

type Outcome = Result<Value, Box<Raise>>;

/// The symbol of a name in `COMMON-LISP`.
pub(crate) fn common(image: &mut Image, name: &str) -> Value {
    image.intern(PackageTable::CL, name).into()
}

/// The symbol of a name in `SYSTEM`.
pub(crate) fn system(image: &mut Image, name: &str) -> Value {
    image.intern(PackageTable::SYSTEM, name).into()
}

/// Checks that a step is a positive number.
pub(crate) fn check_positive(step: &Value) -> Result<(), Box<Raise>> {
    let positive = number::compare(step, &Value::Int(0)).ok().flatten();
    if positive == Some(std::cmp::Ordering::Greater) {
        Ok(())
    } else {
        let above_zero = Value::list([known::REAL.into(), Value::list([Value::Int(0)])]);
        Err(Raise::type_error(step, above_zero))
    }
}

/// The number, which must be greater than zero.
///
/// `(system::positive-step 2)` => `2`
#[builtin]
fn positive_step(number: &Value) -> Outcome {
    check_positive(number)?;
    Ok(number.clone())
}

fn pair(value: &Value) -> Result<&Rc<Cons>, Box<Raise>> {
    value
        .as_cons()
        .ok_or_else(|| Raise::type_error(value, known::CONS))
}

/// Adds an element behind the last pair of a list; the new last pair.
///
/// `(system::extend-list (list 1) 2)` => `(2)`
#[builtin]
fn extend_list(last_pair: &Rc<Cons>, element: Value) -> Outcome {
    let tail = last_pair;
    let last = Value::cons(element, Value::NIL);
    tail.set_cdr(last.clone());
    Ok(last)
}

fn join(tail: &Value, list: Value) -> Outcome {
    let cons = pair(tail)?;
    let last = last_pair(&list)?;
    cons.set_cdr(list);
    Ok(last.map_or_else(|| tail.clone(), Value::Cons))
}

/// Adds the elements of a list behind the last pair of a list; the new last pair.
///
/// `(system::extend-list-copying (list 1) '(2 3))` => `(3)`
#[builtin]
fn extend_list_copying(last_pair: &Value, list: &Value) -> Outcome {
    let mut iter = list.iter_list();
    let items: Vec<Value> = iter.by_ref().collect();
    join(last_pair, Value::list_with_tail(items, iter.rest))
}

/// Joins a list to the last pair of a list; the new last pair.
///
/// `(system::extend-list-joining (list 1) (list 2 3))` => `(3)`
#[builtin]
fn extend_list_joining(last_pair: &Value, list: Value) -> Outcome {
    join(last_pair, list)
}

/// The elements of a sequence as a list.
///
/// `(system::elements #(1 2))` => `(1 2)`
#[builtin]
fn elements(sequence: &Value) -> Outcome {
    match sequence {
        list @ (Value::Cons(_) | Value::Symbol(known::NIL, ..)) => Ok(list.clone()),
        other => Ok(Value::list(Sequence::of(other)?.all()?)),
    }
}

/// The number of elements of a vector.
///
/// `(system::vector-length #(1 2))` => `2`
#[builtin]
fn vector_length(vector: &Value) -> Outcome {
    match vector {
        Value::Vector(v) => Ok(Vector::len(v).into()),
        Value::Str(s) => Ok(s.len().into()),
        other => Err(Raise::type_error(other, known::VECTOR)),
    }
}

/// Functions that loops call, in package `SYSTEM`.
pub(crate) static SYSTEM_TABLE: &[Builtin] = builtins![
    extend_list,
    extend_list_copying,
    extend_list_joining,
    positive_step,
    elements,
    vector_length,
];
