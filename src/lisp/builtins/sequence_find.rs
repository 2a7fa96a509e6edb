//! Finding and counting elements of sequences: `find`, `position`, `count` and their
//! `-if` forms.

use super::criterion::{Criterion, Key, Test};
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::keywords;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence};
use crate::vm::calls::{Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// What to find out about the elements that satisfy a condition.
#[derive(Clone, Copy)]
enum Goal {
    Element,
    Position,
    Count,
}

/// The arguments of a function that searches a part of a sequence.
struct Search {
    sequence: Sequence,
    bounds: Bounds,
    from_end: bool,
    criterion: Criterion,
}

impl Search {
    fn by_item(
        image: &Image,
        item: Value,
        sequence: Sequence,
        keywords: &[Value],
    ) -> Result<Search, Box<Raise>> {
        let [key, start, end, from_end, test, test_not] = keywords::parse(
            image,
            keywords,
            [
                known::K_KEY,
                known::K_START,
                known::K_END,
                known::K_FROM_END,
                known::K_TEST,
                known::K_TEST_NOT,
            ],
        )?;
        let test = Test::new(image, test, test_not)?;
        Ok(Search {
            bounds: Bounds::new(&sequence, start.as_ref(), end.as_ref())?,
            from_end: from_end.is_some_and(|v| v.is_true()),
            criterion: Criterion::item(item, test, Key::new(image, key)?),
            sequence,
        })
    }

    fn by_predicate(
        image: &Image,
        predicate: &Value,
        expected: bool,
        sequence: Sequence,
        keywords: &[Value],
    ) -> Result<Search, Box<Raise>> {
        let [key, start, end, from_end] = keywords::parse(
            image,
            keywords,
            [
                known::K_KEY,
                known::K_START,
                known::K_END,
                known::K_FROM_END,
            ],
        )?;
        let key = Key::new(image, key)?;
        Ok(Search {
            bounds: Bounds::new(&sequence, start.as_ref(), end.as_ref())?,
            from_end: from_end.is_some_and(|v| v.is_true()),
            criterion: Criterion::predicate(image, predicate, expected, key)?,
            sequence,
        })
    }

    async fn find(self, calls: Calls, goal: Goal) -> Result<Value, Box<Raise>> {
        let mut count = 0_usize;
        if self.from_end {
            let items = self.sequence.items(self.bounds)?;
            for (i, item) in items.into_iter().enumerate().rev() {
                if self.criterion.accepts(&calls, &item).await {
                    match goal {
                        Goal::Element => return Ok(item),
                        Goal::Position => return Ok((self.bounds.start + i).into()),
                        Goal::Count => count += 1,
                    }
                }
            }
        } else {
            let mut walk = self.sequence.walk(self.bounds);
            let mut index = self.bounds.start;
            while let Some(item) = walk.next()? {
                if self.criterion.accepts(&calls, &item).await {
                    match goal {
                        Goal::Element => return Ok(item),
                        Goal::Position => return Ok(index.into()),
                        Goal::Count => count += 1,
                    }
                }
                index += 1;
            }
        }
        Ok(match goal {
            Goal::Element | Goal::Position => Value::NIL,
            Goal::Count => count.into(),
        })
    }
}

/// The first element that matches an item, or `NIL`.
///
/// `(find 2 '((1 a) (2 b)) :key #'first)` => `(2 B)`
#[builtin(_, "item sequence &key key start end from-end test test-not")]
fn find(
    machine: &mut Machine<'_>,
    item: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_item(machine.image, item, sequence, keywords)?;
    run(machine, "FIND", |calls| search.find(calls, Goal::Element))
}

/// The first element that satisfies a predicate, or `NIL`.
///
/// `(find-if #'evenp '(1 2 3 4))` => `2`
/// `(find-if #'evenp '(1 2 3 4) :from-end t)` => `4`
#[builtin(_, "predicate sequence &key key start end from-end")]
fn find_if(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_predicate(machine.image, predicate, true, sequence, keywords)?;
    run(machine, "FIND-IF", |calls| {
        search.find(calls, Goal::Element)
    })
}

/// The first element that does not satisfy a predicate, or `NIL`.
///
/// `(find-if-not #'evenp '(2 4 5))` => `5`
#[builtin(_, "predicate sequence &key key start end from-end")]
fn find_if_not(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_predicate(machine.image, predicate, false, sequence, keywords)?;
    run(machine, "FIND-IF-NOT", |calls| {
        search.find(calls, Goal::Element)
    })
}

/// The index of the first element that matches an item, or `NIL`.
///
/// `(position #\l "hello")` => `2`
#[builtin(_, "item sequence &key key start end from-end test test-not")]
fn position(
    machine: &mut Machine<'_>,
    item: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_item(machine.image, item, sequence, keywords)?;
    run(machine, "POSITION", |calls| {
        search.find(calls, Goal::Position)
    })
}

/// The index of the first element that satisfies a predicate, or `NIL`.
///
/// `(position-if #'evenp #(1 2 3))` => `1`
#[builtin(_, "predicate sequence &key key start end from-end")]
fn position_if(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_predicate(machine.image, predicate, true, sequence, keywords)?;
    run(machine, "POSITION-IF", |calls| {
        search.find(calls, Goal::Position)
    })
}

/// The index of the first element that does not satisfy a predicate, or `NIL`.
///
/// `(position-if-not #'evenp '(2 4 5))` => `2`
#[builtin(_, "predicate sequence &key key start end from-end")]
fn position_if_not(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_predicate(machine.image, predicate, false, sequence, keywords)?;
    run(machine, "POSITION-IF-NOT", |calls| {
        search.find(calls, Goal::Position)
    })
}

/// The number of elements that match an item.
///
/// `(count #\a "banana")` => `3`
#[builtin(_, "item sequence &key key start end from-end test test-not")]
fn count(
    machine: &mut Machine<'_>,
    item: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_item(machine.image, item, sequence, keywords)?;
    run(machine, "COUNT", |calls| search.find(calls, Goal::Count))
}

/// The number of elements that satisfy a predicate.
///
/// `(count-if #'evenp '(1 2 4))` => `2`
#[builtin(_, "predicate sequence &key key start end from-end")]
fn count_if(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_predicate(machine.image, predicate, true, sequence, keywords)?;
    run(machine, "COUNT-IF", |calls| search.find(calls, Goal::Count))
}

/// The number of elements that do not satisfy a predicate.
///
/// `(count-if-not #'evenp '(1 2 4))` => `1`
#[builtin(_, "predicate sequence &key key start end from-end")]
fn count_if_not(
    machine: &mut Machine<'_>,
    predicate: &Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let search = Search::by_predicate(machine.image, predicate, false, sequence, keywords)?;
    run(machine, "COUNT-IF-NOT", |calls| {
        search.find(calls, Goal::Count)
    })
}

/// Finding and counting elements.
pub(crate) static TABLE: &[Builtin] = builtins![
    find,
    find_if,
    find_if_not,
    position,
    position_if,
    position_if_not,
    count,
    count_if,
    count_if_not,
];
