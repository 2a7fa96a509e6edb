//! Removing and replacing elements: `remove`, `delete`, `substitute`, `nsubstitute` and
//! their `-if` forms.

use super::criterion::{Criterion, Key, Test};
use crate::builtin::Builtin;
use crate::image::Image;
use crate::typed::keywords;
use crate::typed::{self, builtin, builtins};
use crate::value::Value;
use crate::value::known;
use crate::value::raise::Raise;
use crate::value::sequence::{Bounds, Sequence, conses, relink, text_of};
use crate::vm::calls::{Calls, run};
use crate::vm::machine::Machine;
use crate::vm::step::Step;

/// What happens to the elements that satisfy a condition.
enum Change {
    /// They are removed: from the sequence itself if `in_place`.
    Remove { in_place: bool },
    /// They are replaced: in the sequence itself if `in_place`.
    Replace { new: Value, in_place: bool },
}

/// How the elements to change are chosen.
enum By {
    /// They match an item.
    Item(Value),
    /// They satisfy a predicate, or not.
    Predicate { predicate: Value, expected: bool },
}

struct Changing {
    sequence: Sequence,
    bounds: Bounds,
    from_end: bool,
    limit: usize,
    criterion: Criterion,
    change: Change,
}

impl Changing {
    fn new(
        image: &Image,
        by: By,
        sequence: Sequence,
        keywords: &[Value],
        change: Change,
    ) -> Result<Changing, Box<Raise>> {
        let bounding = [
            known::K_KEY,
            known::K_START,
            known::K_END,
            known::K_FROM_END,
            known::K_COUNT,
        ];
        let ([key, start, end, from_end, count], test) = match &by {
            By::Predicate { .. } => (keywords::parse(image, keywords, bounding)?, None),
            By::Item(_) => {
                let [key, start, end, from_end, count] = bounding;
                let names = [
                    key,
                    start,
                    end,
                    from_end,
                    count,
                    known::K_TEST,
                    known::K_TEST_NOT,
                ];
                let [key, start, end, from_end, count, test, test_not] =
                    keywords::parse(image, keywords, names)?;
                (
                    [key, start, end, from_end, count],
                    Some(Test::new(image, test, test_not)?),
                )
            }
        };
        let key = Key::new(image, key)?;
        let criterion = match (by, test) {
            (
                By::Predicate {
                    predicate,
                    expected,
                },
                _,
            ) => Criterion::predicate(image, &predicate, expected, key)?,
            (By::Item(item), test) => Criterion::item(item, test.unwrap_or(Test::Eql), key),
        };
        Ok(Changing {
            bounds: Bounds::new(&sequence, start.as_ref(), end.as_ref())?,
            from_end: from_end.is_some_and(|v| v.is_true()),
            limit: limit(count.as_ref())?,
            sequence,
            criterion,
            change,
        })
    }

    async fn run(self, calls: Calls) -> Result<Value, Box<Raise>> {
        let mut items = self.sequence.all()?;
        let end = self.bounds.end_of(items.len());
        let mut chosen = vec![false; items.len()];
        let mut left = self.limit;
        let mut indices = self.bounds.start..end;
        while left > 0
            && let Some(i) = if self.from_end {
                indices.next_back()
            } else {
                indices.next()
            }
        {
            // The items are a copy that no callback can shorten.
            let Some(item) = items.get(i) else { break };
            if self.criterion.accepts(&calls, item).await
                && let Some(mark) = chosen.get_mut(i)
            {
                *mark = true;
                left -= 1;
            }
        }
        match self.change {
            Change::Remove { in_place } => removed(&self.sequence, items, &chosen, in_place),
            Change::Replace { new, in_place } => {
                for (item, chosen) in items.iter_mut().zip(&chosen) {
                    if *chosen {
                        *item = new.clone();
                    }
                }
                if in_place {
                    self.sequence.set_all(&items)?;
                    return Ok(self.sequence.value());
                }
                self.sequence.kind().make(items)
            }
        }
    }
}

/// How many elements may change: the value of a `:count` argument.
fn limit(count: Option<&Value>) -> Result<usize, Box<Raise>> {
    match count {
        None | Some(Value::Symbol(known::NIL, ..)) => Ok(usize::MAX),
        Some(Value::Int(n)) => Ok(usize::try_from(*n).unwrap_or(0)),
        Some(Value::Big(n)) => Ok(match n.sign() {
            num_bigint::Sign::Minus => 0,
            _ => usize::MAX,
        }),
        Some(other) => Err(Raise::type_error(other, known::INTEGER)),
    }
}

/// The sequence without the chosen elements.
pub(crate) fn removed(
    sequence: &Sequence,
    items: Vec<Value>,
    chosen: &[bool],
    in_place: bool,
) -> Result<Value, Box<Raise>> {
    if in_place && let Sequence::List(list) = sequence {
        let mut kept = conses(list)?;
        let mut marks = chosen.iter();
        kept.retain(|_| marks.next() != Some(&true));
        return Ok(relink(&kept, Value::NIL));
    }
    let mut marks = chosen.iter();
    let mut kept = items;
    kept.retain(|_| marks.next() != Some(&true));
    match sequence {
        Sequence::Vector(vector) if in_place && vector.fill_pointer.get().is_some() => {
            vector.fill_pointer.set(Some(kept.len()));
            sequence.set_all(&kept)?;
            Ok(sequence.value())
        }
        Sequence::Str(string) if in_place && string.has_fill_pointer.get() => {
            string.set_text(text_of(&kept)?);
            Ok(sequence.value())
        }
        _ => sequence.kind().make(kept),
    }
}

fn change(
    machine: &mut Machine<'_>,
    name: &'static str,
    by: By,
    sequence: Sequence,
    keywords: &[Value],
    change: Change,
) -> Result<Step, Box<Raise>> {
    let changing = Changing::new(machine.image, by, sequence, keywords, change)?;
    run(machine, name, |calls| changing.run(calls))
}

/// A sequence without the elements that match an item.
///
/// `(remove 2 '(1 2 3 2))` => `(1 3)`
/// `(remove #\a "banana")` => `"bnn"`
#[builtin(_, "item sequence &key key start end from-end count test test-not")]
fn remove(
    machine: &mut Machine<'_>,
    item: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Item(item);
    change(
        machine,
        "REMOVE",
        by,
        sequence,
        keywords,
        Change::Remove { in_place: false },
    )
}

/// A sequence without the elements that satisfy a predicate.
///
/// `(remove-if #'evenp '(1 2 3 4))` => `(1 3)`
#[builtin(_, "predicate sequence &key key start end from-end count")]
fn remove_if(
    machine: &mut Machine<'_>,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: true,
    };
    change(
        machine,
        "REMOVE-IF",
        by,
        sequence,
        keywords,
        Change::Remove { in_place: false },
    )
}

/// A sequence of the elements that satisfy a predicate.
///
/// `(remove-if-not #'evenp '(1 2 3 4))` => `(2 4)`
#[builtin(_, "predicate sequence &key key start end from-end count")]
fn remove_if_not(
    machine: &mut Machine<'_>,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: false,
    };
    change(
        machine,
        "REMOVE-IF-NOT",
        by,
        sequence,
        keywords,
        Change::Remove { in_place: false },
    )
}

/// Like `remove`, but may change the sequence; use the result.
///
/// `(delete 2 (list 1 2 3))` => `(1 3)`
#[builtin(_, "item sequence &key key start end from-end count test test-not")]
fn delete(
    machine: &mut Machine<'_>,
    item: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Item(item);
    change(
        machine,
        "DELETE",
        by,
        sequence,
        keywords,
        Change::Remove { in_place: true },
    )
}

/// Like `remove-if`, but may change the sequence; use the result.
///
/// `(delete-if #'evenp (list 1 2 3))` => `(1 3)`
#[builtin(_, "predicate sequence &key key start end from-end count")]
fn delete_if(
    machine: &mut Machine<'_>,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: true,
    };
    change(
        machine,
        "DELETE-IF",
        by,
        sequence,
        keywords,
        Change::Remove { in_place: true },
    )
}

/// Like `remove-if-not`, but may change the sequence; use the result.
///
/// `(delete-if-not #'evenp (list 1 2 3))` => `(2)`
#[builtin(_, "predicate sequence &key key start end from-end count")]
fn delete_if_not(
    machine: &mut Machine<'_>,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: false,
    };
    change(
        machine,
        "DELETE-IF-NOT",
        by,
        sequence,
        keywords,
        Change::Remove { in_place: true },
    )
}

/// A sequence with the elements that match `old` replaced by `new`.
///
/// `(substitute 9 2 '(1 2 3 2) :count 1)` => `(1 9 3 2)`
#[builtin(_, "new old sequence &key key start end from-end count test test-not")]
fn substitute(
    machine: &mut Machine<'_>,
    new: Value,
    old: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Item(old);
    change(
        machine,
        "SUBSTITUTE",
        by,
        sequence,
        keywords,
        Change::Replace {
            new,
            in_place: false,
        },
    )
}

/// A sequence with the elements that satisfy a predicate replaced by `new`.
///
/// `(substitute-if 0 #'evenp '(1 2 3 4))` => `(1 0 3 0)`
#[builtin(_, "new predicate sequence &key key start end from-end count")]
fn substitute_if(
    machine: &mut Machine<'_>,
    new: Value,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: true,
    };
    change(
        machine,
        "SUBSTITUTE-IF",
        by,
        sequence,
        keywords,
        Change::Replace {
            new,
            in_place: false,
        },
    )
}

/// A sequence with the elements that do not satisfy a predicate replaced by `new`.
///
/// `(substitute-if-not 0 #'evenp '(1 2 3 4))` => `(0 2 0 4)`
#[builtin(_, "new predicate sequence &key key start end from-end count")]
fn substitute_if_not(
    machine: &mut Machine<'_>,
    new: Value,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: false,
    };
    change(
        machine,
        "SUBSTITUTE-IF-NOT",
        by,
        sequence,
        keywords,
        Change::Replace {
            new,
            in_place: false,
        },
    )
}

/// Like `substitute`, but changes the sequence.
///
/// `(nsubstitute 9 2 (list 1 2 3))` => `(1 9 3)`
#[builtin(_, "new old sequence &key key start end from-end count test test-not")]
fn nsubstitute(
    machine: &mut Machine<'_>,
    new: Value,
    old: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Item(old);
    change(
        machine,
        "NSUBSTITUTE",
        by,
        sequence,
        keywords,
        Change::Replace {
            new,
            in_place: true,
        },
    )
}

/// Like `substitute-if`, but changes the sequence.
///
/// `(nsubstitute-if 0 #'evenp (list 1 2))` => `(1 0)`
#[builtin(_, "new predicate sequence &key key start end from-end count")]
fn nsubstitute_if(
    machine: &mut Machine<'_>,
    new: Value,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: true,
    };
    change(
        machine,
        "NSUBSTITUTE-IF",
        by,
        sequence,
        keywords,
        Change::Replace {
            new,
            in_place: true,
        },
    )
}

/// Like `substitute-if-not`, but changes the sequence.
///
/// `(nsubstitute-if-not 0 #'evenp (list 1 2))` => `(0 2)`
#[builtin(_, "new predicate sequence &key key start end from-end count")]
fn nsubstitute_if_not(
    machine: &mut Machine<'_>,
    new: Value,
    predicate: Value,
    sequence: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let by = By::Predicate {
        predicate,
        expected: false,
    };
    change(
        machine,
        "NSUBSTITUTE-IF-NOT",
        by,
        sequence,
        keywords,
        Change::Replace {
            new,
            in_place: true,
        },
    )
}

/// Removing and replacing elements.
pub(crate) static TABLE: &[Builtin] = builtins![
    remove,
    remove_if,
    remove_if_not,
    delete,
    delete_if,
    delete_if_not,
    substitute,
    substitute_if,
    substitute_if_not,
    nsubstitute,
    nsubstitute_if,
    nsubstitute_if_not,
];
