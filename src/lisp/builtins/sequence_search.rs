//! Comparing sequences: `search` and `mismatch`.

use super::criterion::{Key, Test};
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

/// Two parts of sequences and how their elements are compared.
struct Pair {
    first: Vec<Value>,
    first_start: usize,
    second: Vec<Value>,
    second_start: usize,
    test: Test,
    key: Key,
    from_end: bool,
}

impl Pair {
    fn new(
        image: &Image,
        first: Sequence,
        second: Sequence,
        keywords: &[Value],
    ) -> Result<Pair, Box<Raise>> {
        let [key, from_end, test, test_not, start1, end1, start2, end2] = keywords::parse(
            image,
            keywords,
            [
                known::K_KEY,
                known::K_FROM_END,
                known::K_TEST,
                known::K_TEST_NOT,
                known::K_START1,
                known::K_END1,
                known::K_START2,
                known::K_END2,
            ],
        )?;
        let first_bounds = Bounds::new(&first, start1.as_ref(), end1.as_ref())?;
        let second_bounds = Bounds::new(&second, start2.as_ref(), end2.as_ref())?;
        Ok(Pair {
            first: first.items(first_bounds)?,
            first_start: first_bounds.start,
            second: second.items(second_bounds)?,
            second_start: second_bounds.start,
            test: Test::new(image, test, test_not)?,
            key: Key::new(image, key)?,
            from_end: from_end.is_some_and(|v| v.is_true()),
        })
    }

    async fn same(&self, calls: &Calls, a: &Value, b: &Value) -> bool {
        let a = self.key.of(calls, a.clone()).await;
        let b = self.key.of(calls, b.clone()).await;
        self.test.matches(calls, &a, &b).await
    }

    /// Where the first part occurs in the second.
    async fn search(self, calls: Calls) -> Result<Value, Box<Raise>> {
        let Some(last) = self.second.len().checked_sub(self.first.len()) else {
            return Ok(Value::NIL);
        };
        let mut offsets = 0..=last;
        while let Some(offset) = if self.from_end {
            offsets.next_back()
        } else {
            offsets.next()
        } {
            let mut found = true;
            for (a, b) in self.first.iter().zip(self.second.iter().skip(offset)) {
                if !self.same(&calls, a, b).await {
                    found = false;
                    break;
                }
            }
            if found {
                return Ok((self.second_start + offset).into());
            }
        }
        Ok(Value::NIL)
    }

    /// Where the parts begin to differ; from the end, the index after that place.
    async fn mismatch(self, calls: Calls) -> Result<Value, Box<Raise>> {
        let (n, m) = (self.first.len(), self.second.len());
        let shared = n.min(m);
        for i in 0..shared {
            let (a, b) = if self.from_end {
                (n - 1 - i, m - 1 - i)
            } else {
                (i, i)
            };
            let (Some(x), Some(y)) = (self.first.get(a), self.second.get(b)) else {
                break;
            };
            if !self.same(&calls, x, y).await {
                let at = if self.from_end { a + 1 } else { a };
                return Ok((self.first_start + at).into());
            }
        }
        if n == m {
            return Ok(Value::NIL);
        }
        let at = if self.from_end { n - shared } else { shared };
        Ok((self.first_start + at).into())
    }
}

/// The index at which the first sequence occurs in the second, or `NIL`.
///
/// `(search "ll" "hello")` => `2`
/// `(search '(2 3) '(1 2 3 4))` => `1`
#[builtin(
    _,
    "sequence-1 sequence-2 &key from-end test test-not key start1 end1 start2 end2"
)]
fn search(
    machine: &mut Machine<'_>,
    sequence_1: Sequence,
    sequence_2: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let pair = Pair::new(machine.image, sequence_1, sequence_2, keywords)?;
    run(machine, "SEARCH", |calls| pair.search(calls))
}

/// The index at which two sequences begin to differ, or `NIL`.
///
/// `(mismatch "hello" "help")` => `3`
/// `(mismatch '(1) '(1))` => `NIL`
#[builtin(
    _,
    "sequence-1 sequence-2 &key from-end test test-not key start1 end1 start2 end2"
)]
fn mismatch(
    machine: &mut Machine<'_>,
    sequence_1: Sequence,
    sequence_2: Sequence,
    keywords: &[Value],
) -> Result<Step, Box<Raise>> {
    let pair = Pair::new(machine.image, sequence_1, sequence_2, keywords)?;
    run(machine, "MISMATCH", |calls| pair.mismatch(calls))
}

/// Comparing sequences.
pub(crate) static TABLE: &[Builtin] = builtins![search, mismatch,];
