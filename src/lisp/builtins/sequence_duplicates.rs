//! `remove-duplicates` and `delete-duplicates`.

use std::collections::HashSet;

use super::criterion::{Key, Test};
use super::sequence_change::removed;
use crate::builtin::Builtin;
use crate::typed::keywords;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::hash_table::{HashKey, HashTest};
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::vm::calls::{Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

struct Duplicates {
    sequence: Sequence,
    bounds: Bounds,
    from_end: bool,
    test: Test,
    key: Key,
    in_place: bool,
}

impl Duplicates {
    async fn run(self, calls: Calls) -> Result<Value> {
        let items = self.sequence.all()?;
        let end = self.bounds.end_of(items.len());
        let part = items.get(self.bounds.start..end).unwrap_or(&[]);
        let mut keys = Vec::with_capacity(part.len());
        for item in part {
            keys.push(self.key.of(&calls, item.clone()).await);
        }
        let duplicates = match &self.test {
            Test::Eq => hashed_duplicates(&keys, HashTest::Eq, self.from_end),
            Test::Eql => hashed_duplicates(&keys, HashTest::Eql, self.from_end),
            Test::Equal => hashed_duplicates(&keys, HashTest::Equal, self.from_end),
            test => tested_duplicates(&calls, &keys, test, self.from_end).await,
        };
        let mut chosen = vec![false; items.len()];
        for (mark, duplicate) in chosen.iter_mut().skip(self.bounds.start).zip(duplicates) {
            *mark = duplicate;
        }
        removed(&self.sequence, items, &chosen, self.in_place)
    }
}

/// Which keys occur again later or, from the end, have occurred before.
fn hashed_duplicates(keys: &[Value], test: HashTest, from_end: bool) -> Vec<bool> {
    #[expect(
        clippy::mutable_key_type,
        reason = "no key changes while the set is alive"
    )]
    let mut seen = HashSet::with_capacity(keys.len());
    let mut is_new = |value: &Value| {
        seen.insert(HashKey {
            value: value.clone(),
            test,
        })
    };
    if from_end {
        return keys.iter().map(|key| !is_new(key)).collect();
    }
    let mut marks: Vec<bool> = keys.iter().rev().map(|key| !is_new(key)).collect();
    marks.reverse();
    marks
}

async fn tested_duplicates(
    calls: &Calls,
    keys: &[Value],
    test: &Test,
    from_end: bool,
) -> Vec<bool> {
    let mut marks = vec![false; keys.len()];
    for (i, a) in keys.iter().enumerate() {
        for (j, b) in keys.iter().enumerate().skip(i + 1) {
            let dropped = if from_end { j } else { i };
            if marks.get(dropped) != Some(&true) && test.matches(calls, a, b).await {
                if let Some(mark) = marks.get_mut(dropped) {
                    *mark = true;
                }
                if !from_end {
                    break;
                }
            }
        }
    }
    marks
}

fn duplicates(
    machine: &mut Machine<'_>,
    sequence: Sequence,
    options: &[Value],
    name: &'static str,
    in_place: bool,
) -> Result<Step> {
    let image = &machine.image;
    let [key, start, end, from_end, test, test_not] = keywords::parse(
        image,
        options,
        [
            known::K_KEY,
            known::K_START,
            known::K_END,
            known::K_FROM_END,
            known::K_TEST,
            known::K_TEST_NOT,
        ],
    )?;
    let duplicates = Duplicates {
        bounds: Bounds::new(&sequence, start.as_ref(), end.as_ref())?,
        from_end: from_end.is_some_and(|v| v.is_true()),
        test: Test::new(image, test, test_not)?,
        key: Key::new(image, key)?,
        sequence,
        in_place,
    };
    run(machine, name, |calls| duplicates.run(calls))
}

/// A sequence without the elements that come again later (or, from the end, came before).
///
/// `(remove-duplicates '(1 2 1 3 2))` => `(1 3 2)`
#[builtin(_, "sequence &key key start end from-end test test-not")]
fn remove_duplicates(
    machine: &mut Machine<'_>,
    sequence: Sequence,
    options: &[Value],
) -> Result<Step> {
    duplicates(machine, sequence, options, "REMOVE-DUPLICATES", false)
}

/// Like `remove-duplicates`, but may change the sequence; use the result.
///
/// `(delete-duplicates (list 1 2 1))` => `(2 1)`
#[builtin(_, "sequence &key key start end from-end test test-not")]
fn delete_duplicates(
    machine: &mut Machine<'_>,
    sequence: Sequence,
    options: &[Value],
) -> Result<Step> {
    duplicates(machine, sequence, options, "DELETE-DUPLICATES", true)
}

/// Removing duplicates.
pub(crate) static TABLE: &[Builtin] = builtins![remove_duplicates, delete_duplicates,];
