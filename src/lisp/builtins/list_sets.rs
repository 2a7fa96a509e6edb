//! Lists as sets: `adjoin`, `union`, `intersection`, `set-difference`,
//! `set-exclusive-or`, `subsetp`.
//!
//! Large lists of items that compare by a hashable equality are looked up in a table, so
//! that the work grows with the sum, not the product, of the lengths.

use std::collections::HashSet;

use super::criterion::{Key, Test};
use super::keywords;
use crate::lisp::builtin::{Builtin, control};
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::hash_table::{HashKey, HashTest};
use crate::lisp::value::known;
use crate::lisp::value::raise::Raise;
use crate::lisp::value::sequence::list_items;
use crate::lisp::vm::calls::{Calls, run};
use crate::lisp::vm::machine::Machine;
use crate::lisp::vm::step::Step;

type Outcome = Result<Value, Box<Raise>>;

/// Lists with fewer elements are searched from front to back.
const WORTH_HASHING: usize = 32;

struct Comparison {
    test: Test,
    key: Key,
}

impl Comparison {
    fn new(image: &Image, args: &[Value]) -> Result<Comparison, Box<Raise>> {
        let [key, test, test_not] = keywords::parse(
            image,
            args,
            [known::K_KEY, known::K_TEST, known::K_TEST_NOT],
        )?;
        Ok(Comparison {
            test: Test::new(image, test, test_not)?,
            key: Key::new(image, key)?,
        })
    }
}

/// The keys of one list, to be searched for those of another.
struct Members {
    keys: Vec<Value>,
    table: Option<(HashTest, HashSet<HashKey>)>,
}

impl Members {
    async fn new(calls: &Calls, comparison: &Comparison, items: &[Value]) -> Members {
        let mut keys = Vec::with_capacity(items.len());
        for item in items {
            keys.push(comparison.key.of(calls, item.clone()).await);
        }
        let test = match comparison.test {
            Test::Eq => Some(HashTest::Eq),
            Test::Eql => Some(HashTest::Eql),
            Test::Equal => Some(HashTest::Equal),
            _ => None,
        };
        let table = test
            .filter(|_| keys.len() >= WORTH_HASHING)
            .map(|test| (test, keys.iter().map(|k| hash_key(k, test)).collect()));
        Members { keys, table }
    }

    /// Is there a member that matches a key? With `swapped`, the member is the test's
    /// first argument.
    async fn contain(&self, calls: &Calls, test: &Test, key: &Value, swapped: bool) -> bool {
        if let Some((test, table)) = &self.table {
            return table.contains(&hash_key(key, *test));
        }
        for member in &self.keys {
            let (a, b) = if swapped {
                (member, key)
            } else {
                (key, member)
            };
            if test.matches(calls, a, b).await {
                return true;
            }
        }
        false
    }
}

fn hash_key(value: &Value, test: HashTest) -> HashKey {
    HashKey {
        value: value.clone(),
        test,
    }
}

/// Items whose presence among the other list's members is `wanted`.
async fn filtered(
    calls: &Calls,
    comparison: &Comparison,
    items: &[Value],
    members: &Members,
    wanted: bool,
    swapped: bool,
) -> Vec<Value> {
    let mut result = Vec::new();
    for item in items {
        let key = comparison.key.of(calls, item.clone()).await;
        if members
            .contain(calls, &comparison.test, &key, swapped)
            .await
            == wanted
        {
            result.push(item.clone());
        }
    }
    result
}

async fn adjoin_item(calls: Calls, comparison: Comparison, item: Value, list: Value) -> Outcome {
    let key = comparison.key.of(&calls, item.clone()).await;
    let mut walk = crate::lisp::value::sequence::ListWalk::new(list.clone());
    while let Some(element) = walk.next()? {
        let other = comparison.key.of(&calls, element).await;
        if comparison.test.matches(&calls, &key, &other).await {
            return Ok(list);
        }
    }
    Ok(Value::cons(item, list))
}

fn adjoin(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    let comparison = Comparison::new(machine.image, &args[2..])?;
    let (item, list) = (args[0].clone(), args[1].clone());
    run(machine, "ADJOIN", |calls| {
        adjoin_item(calls, comparison, item, list)
    })
}

#[derive(Clone, Copy)]
enum Operation {
    Union,
    Intersection,
    Difference,
    ExclusiveOr,
    Subset,
}

async fn combine(
    calls: Calls,
    comparison: Comparison,
    first: Vec<Value>,
    second: Value,
    operation: Operation,
) -> Outcome {
    let items = list_items(&second)?;
    // The shorter list is kept, the other one's new elements are put in front of it.
    if matches!(operation, Operation::Union) && first.len() < items.len() {
        let members = Members::new(&calls, &comparison, &first).await;
        let new = filtered(&calls, &comparison, &items, &members, false, true).await;
        return Ok(Value::list(new.into_iter().rev().chain(first)));
    }
    let members = Members::new(&calls, &comparison, &items).await;
    match operation {
        Operation::Union => {
            let new = filtered(&calls, &comparison, &first, &members, false, false).await;
            Ok(Value::list_with_tail(new.into_iter().rev(), second))
        }
        Operation::Intersection => {
            let common = filtered(&calls, &comparison, &first, &members, true, false).await;
            Ok(Value::list(common.into_iter().rev()))
        }
        Operation::Difference => {
            if items.is_empty() {
                return Ok(Value::list(first));
            }
            let rest = filtered(&calls, &comparison, &first, &members, false, false).await;
            Ok(Value::list(rest.into_iter().rev()))
        }
        Operation::ExclusiveOr => {
            let only_first = filtered(&calls, &comparison, &first, &members, false, false).await;
            let others = Members::new(&calls, &comparison, &first).await;
            let only_second = filtered(&calls, &comparison, &items, &others, false, true).await;
            Ok(Value::list(
                only_second
                    .into_iter()
                    .rev()
                    .chain(only_first.into_iter().rev()),
            ))
        }
        Operation::Subset => {
            for item in &first {
                let key = comparison.key.of(&calls, item.clone()).await;
                if !members.contain(&calls, &comparison.test, &key, false).await {
                    return Ok(Value::NIL);
                }
            }
            Ok(Value::T)
        }
    }
}

fn set_operation(
    machine: &mut Machine<'_>,
    args: &[Value],
    name: &'static str,
    operation: Operation,
) -> Result<Step, Box<Raise>> {
    let comparison = Comparison::new(machine.image, &args[2..])?;
    let first = list_items(&args[0])?;
    let second = args[1].clone();
    run(machine, name, |calls| {
        combine(calls, comparison, first, second, operation)
    })
}

fn union(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    set_operation(machine, &args, "UNION", Operation::Union)
}

fn intersection(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    set_operation(machine, &args, "INTERSECTION", Operation::Intersection)
}

fn difference(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    set_operation(machine, &args, "SET-DIFFERENCE", Operation::Difference)
}

fn exclusive_or(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    set_operation(machine, &args, "SET-EXCLUSIVE-OR", Operation::ExclusiveOr)
}

fn subsetp(machine: &mut Machine<'_>, args: Vec<Value>) -> Result<Step, Box<Raise>> {
    set_operation(machine, &args, "SUBSETP", Operation::Subset)
}

const LAMBDA_LIST: &str = "list-1 list-2 &key key test test-not";

/// Lists as sets. The names that begin with `n` may reuse their arguments but do not.
pub(crate) static TABLE: &[Builtin] = &[
    control(
        "ADJOIN",
        "item list &key key test test-not",
        "The list with an item in front, unless an element matches it.",
        &["(adjoin 3 '(1 2)) => (3 1 2)", "(adjoin 2 '(1 2)) => (1 2)"],
        adjoin,
    ),
    control(
        "UNION",
        LAMBDA_LIST,
        "The elements that are in one of two lists.",
        &["(union '(1 2) '(2 3)) => (1 2 3)"],
        union,
    ),
    control(
        "NUNION",
        LAMBDA_LIST,
        "Like `union`.",
        &["(nunion (list 1 2) (list 2 3)) => (1 2 3)"],
        union,
    ),
    control(
        "INTERSECTION",
        LAMBDA_LIST,
        "The elements that are in both lists.",
        &["(intersection '(1 2) '(2 3)) => (2)"],
        intersection,
    ),
    control(
        "NINTERSECTION",
        LAMBDA_LIST,
        "Like `intersection`.",
        &["(nintersection (list 1 2) (list 2 3)) => (2)"],
        intersection,
    ),
    control(
        "SET-DIFFERENCE",
        LAMBDA_LIST,
        "The elements of the first list that are not in the second.",
        &["(set-difference '(1 2) '(2 3)) => (1)"],
        difference,
    ),
    control(
        "NSET-DIFFERENCE",
        LAMBDA_LIST,
        "Like `set-difference`.",
        &["(nset-difference (list 1 2) (list 2 3)) => (1)"],
        difference,
    ),
    control(
        "SET-EXCLUSIVE-OR",
        LAMBDA_LIST,
        "The elements that are in exactly one of two lists.",
        &["(set-exclusive-or '(1 2) '(2 3)) => (3 1)"],
        exclusive_or,
    ),
    control(
        "NSET-EXCLUSIVE-OR",
        LAMBDA_LIST,
        "Like `set-exclusive-or`.",
        &["(nset-exclusive-or (list 1 2) (list 2 3)) => (3 1)"],
        exclusive_or,
    ),
    control(
        "SUBSETP",
        LAMBDA_LIST,
        "Is every element of the first list in the second?",
        &["(subsetp '(1 2) '(1 2 3)) => T"],
        subsetp,
    ),
];
