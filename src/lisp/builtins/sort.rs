//! Sorting: `sort`, `stable-sort`, `merge`. Both sorts are stable.

use super::criterion::Key;
use super::settled_types::sequence_type;
use crate::builtin::Builtin;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Sequence, conses, relink};
use crate::vm::callable::{builtin_name, callable};
use crate::vm::calls::{Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// An item with the value by which it is compared.
#[derive(Clone)]
struct Keyed<T> {
    key: Value,
    item: T,
}

/// Sorts by merging runs of growing length; each pass goes from one buffer to the other.
async fn merge_sort<T: Clone>(
    calls: &Calls,
    before: &Value,
    mut items: Vec<Keyed<T>>,
) -> Vec<Keyed<T>> {
    if sort_numbers(before, &mut items) {
        return items;
    }
    let mut width = 1;
    let mut merged = Vec::with_capacity(items.len());
    while width < items.len() {
        for pair in items.chunks(2 * width) {
            let (left, right) = pair.split_at(width.min(pair.len()));
            merge_runs(calls, before, left, right, &mut merged).await;
        }
        std::mem::swap(&mut items, &mut merged);
        merged.clear();
        width *= 2;
    }
    items
}

/// Merges two sorted runs; equal elements of the left one come first.
async fn merge_runs<T: Clone>(
    calls: &Calls,
    before: &Value,
    left: &[Keyed<T>],
    right: &[Keyed<T>],
    merged: &mut Vec<Keyed<T>>,
) {
    let (mut left, mut right) = (left, right);
    while let ([a, left_rest @ ..], [b, right_rest @ ..]) = (left, right) {
        if calls
            .call2(before, b.key.clone(), a.key.clone())
            .await
            .is_true()
        {
            merged.push(b.clone());
            right = right_rest;
        } else {
            merged.push(a.clone());
            left = left_rest;
        }
    }
    merged.extend_from_slice(left);
    merged.extend_from_slice(right);
}

/// Sorts by `<` or `>` if all keys are small integers, or all are doubles that can be compared;
/// returns whether it did.
fn sort_numbers<T>(before: &Value, items: &mut [Keyed<T>]) -> bool {
    let descending = match builtin_name(before) {
        Some(known::LESS) => false,
        Some(known::GREATER) => true,
        _ => return false,
    };
    let order = |ordering: std::cmp::Ordering| {
        if descending {
            ordering.reverse()
        } else {
            ordering
        }
    };
    if items.iter().all(|i| matches!(i.key, Value::Int(_))) {
        items.sort_by(|a, b| match (&a.key, &b.key) {
            (Value::Int(a), Value::Int(b)) => order(a.cmp(b)),
            _ => std::cmp::Ordering::Equal,
        });
        return true;
    }
    let comparable = |key: &Value| matches!(key, Value::Double(x) if !x.is_nan());
    if items.iter().all(|i| comparable(&i.key)) {
        items.sort_by(|a, b| match (&a.key, &b.key) {
            (Value::Double(a), Value::Double(b)) => {
                order(a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal))
            }
            _ => std::cmp::Ordering::Equal,
        });
        return true;
    }
    false
}

async fn keyed<T>(calls: &Calls, key: &Key, items: Vec<(Value, T)>) -> Vec<Keyed<T>> {
    let mut result = Vec::with_capacity(items.len());
    for (value, item) in items {
        result.push(Keyed {
            key: key.of(calls, value).await,
            item,
        });
    }
    result
}

async fn sort_sequence(
    calls: Calls,
    sequence: Sequence,
    before: Value,
    key: Key,
) -> Result<Value, Box<Raise>> {
    if let Sequence::List(list) = &sequence {
        let pairs = conses(list)?.into_iter().map(|c| (c.car(), c)).collect();
        let items = keyed(&calls, &key, pairs).await;
        let sorted = merge_sort(&calls, &before, items).await;
        let links: Vec<_> = sorted.into_iter().map(|k| k.item).collect();
        return Ok(relink(&links, Value::NIL));
    }
    let items = sequence
        .all()?
        .into_iter()
        .map(|v| (v.clone(), v))
        .collect();
    let items = keyed(&calls, &key, items).await;
    let sorted = merge_sort(&calls, &before, items).await;
    let items: Vec<Value> = sorted.into_iter().map(|k| k.item).collect();
    sequence.set_all(&items)?;
    Ok(sequence.value())
}

fn sort_named(
    machine: &mut Machine<'_>,
    name: &'static str,
    sequence: Sequence,
    predicate: &Value,
    key: Option<Value>,
) -> Result<Step, Box<Raise>> {
    let image = &machine.image;
    let before = callable(image, predicate)?;
    let key = Key::new(image, key)?;
    run(machine, name, |calls| {
        sort_sequence(calls, sequence, before, key)
    })
}

/// Sorts a sequence, which is changed; use the result.
///
/// `(sort (list 3 1 2) #'<)` => `(1 2 3)`
/// `(sort (list "b" "a") #'string<)` => `("a" "b")`
#[builtin]
fn sort(
    machine: &mut Machine<'_>,
    sequence: Sequence,
    predicate: &Value,
    #[key] key: Option<Value>,
) -> Result<Step, Box<Raise>> {
    sort_named(machine, "SORT", sequence, predicate, key)
}

/// Like `sort`; elements that are equal keep their order.
///
/// `(stable-sort (list '(1 a) '(0 b) '(1 c)) #'< :key #'first)` => `((0 B) (1 A) (1 C))`
#[builtin]
fn stable_sort(
    machine: &mut Machine<'_>,
    sequence: Sequence,
    predicate: &Value,
    #[key] key: Option<Value>,
) -> Result<Step, Box<Raise>> {
    sort_named(machine, "STABLE-SORT", sequence, predicate, key)
}

/// Merges two sorted sequences into one.
///
/// `(merge 'list (list 1 3 5) (list 2 4) #'<)` => `(1 2 3 4 5)`
#[builtin]
fn merge(
    machine: &mut Machine<'_>,
    result_type: Value,
    sequence_1: Sequence,
    sequence_2: Sequence,
    predicate: Value,
    #[key] key: Option<Value>,
) -> Result<Step, Box<Raise>> {
    let result = sequence_type(machine.image, &result_type)?;
    let image = &machine.image;
    let left = sequence_1.all()?;
    let right = sequence_2.all()?;
    let before = callable(image, &predicate)?;
    let key = Key::new(image, key)?;
    run(machine, "MERGE", |calls| async move {
        let left = left.into_iter().map(|v| (v.clone(), v)).collect();
        let right = right.into_iter().map(|v| (v.clone(), v)).collect();
        let left = keyed(&calls, &key, left).await;
        let right = keyed(&calls, &key, right).await;
        let mut merged = Vec::with_capacity(left.len() + right.len());
        merge_runs(&calls, &before, &left, &right, &mut merged).await;
        result.make(merged.into_iter().map(|k| k.item).collect())
    })
}

/// Sorting.
pub(crate) static TABLE: &[Builtin] = builtins![sort, stable_sort, merge,];
