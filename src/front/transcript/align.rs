//! Aligns expected lines, which may be wildcards, with actual lines.

use std::ops::Range;

use similar::{Algorithm, DiffOp, capture_diff_slices};

use super::pattern::{is_any_lines, line_matches};

/// A step along both columns; line numbers count from zero.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Row {
    /// The expected line matches the actual one.
    Same { expected: usize, actual: usize },
    /// A wildcard matches these actual lines.
    Any {
        expected: usize,
        actual: Range<usize>,
    },
    /// The expected line is missing.
    Missing { expected: usize },
    /// The actual line is not expected.
    Extra { actual: usize },
}

impl Row {
    /// Whether expected and actual lines agree here.
    pub(crate) fn agrees(&self) -> bool {
        matches!(self, Row::Same { .. } | Row::Any { .. })
    }
}

/// Beyond this many pairs of lines, wildcards are taken literally: such outputs differ so
/// much that the best alignment does not matter.
const MAX_PAIRS: usize = 4_000_000;

/// Aligns the columns with the fewest differences.
pub(crate) fn align(expected: &[String], actual: &[String]) -> Vec<Row> {
    let same = |(e, a): &(&String, &String)| !is_any_lines(e) && line_matches(e, a);
    let head = expected.iter().zip(actual).take_while(same).count();
    let (e_rest, a_rest) = (after(expected, head), after(actual, head));
    let tail = e_rest
        .iter()
        .rev()
        .zip(a_rest.iter().rev())
        .take_while(same)
        .count();
    let e_middle = before_last(e_rest, tail);
    let a_middle = before_last(a_rest, tail);

    let mut rows = Rows::default();
    rows.same(head);
    let has_wildcards = e_middle.iter().any(|line| line.contains(".."));
    let pairs = (e_middle.len() + 1).saturating_mul(a_middle.len() + 1);
    if has_wildcards && pairs <= MAX_PAIRS {
        Costs::of(e_middle, a_middle).walk(&mut rows);
    } else {
        for op in capture_diff_slices(Algorithm::Myers, e_middle, a_middle) {
            match op {
                DiffOp::Equal { len, .. } => rows.same(len),
                _ => {
                    rows.missing(op.old_range().len());
                    rows.extra(op.new_range().len());
                }
            }
        }
    }
    rows.same(tail);
    rows.rows
}

fn after<T>(lines: &[T], count: usize) -> &[T] {
    lines.get(count..).unwrap_or_default()
}

fn before_last<T>(lines: &[T], count: usize) -> &[T] {
    lines
        .get(..lines.len().saturating_sub(count))
        .unwrap_or_default()
}

/// Rows under construction, with the next line of either column.
#[derive(Default)]
struct Rows {
    rows: Vec<Row>,
    expected: usize,
    actual: usize,
}

impl Rows {
    fn same(&mut self, count: usize) {
        for _ in 0..count {
            self.rows.push(Row::Same {
                expected: self.expected,
                actual: self.actual,
            });
            self.expected += 1;
            self.actual += 1;
        }
    }

    fn any(&mut self, count: usize) {
        self.rows.push(Row::Any {
            expected: self.expected,
            actual: self.actual..self.actual + count,
        });
        self.expected += 1;
        self.actual += count;
    }

    fn missing(&mut self, count: usize) {
        for _ in 0..count {
            self.rows.push(Row::Missing {
                expected: self.expected,
            });
            self.expected += 1;
        }
    }

    fn extra(&mut self, count: usize) {
        for _ in 0..count {
            self.rows.push(Row::Extra {
                actual: self.actual,
            });
            self.actual += 1;
        }
    }
}

/// How to continue from a pair of lines.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Move {
    Same,
    Replace,
    Missing,
    Extra,
    /// The wildcard takes this actual line.
    Take,
    /// The wildcard takes no more lines.
    Pass,
}

/// The number of differences from each pair of lines on, and the best move there.
///
/// Replacing a line costs as much as omitting one, so that a wildcard before a changed line
/// does not swallow the line after it.
struct Costs {
    width: usize,
    moves: Vec<Move>,
    expected: usize,
    actual: usize,
}

impl Costs {
    fn of(expected: &[String], actual: &[String]) -> Self {
        let width = actual.len() + 1;
        let mut moves = vec![Move::Extra; (expected.len() + 1) * width];
        // The costs of the row below and of the row being filled, from the right.
        let mut below: Vec<u32> = (0..).take(width).collect();
        below.reverse();
        for (row, e) in expected.iter().enumerate().rev() {
            let any = is_any_lines(e);
            let mut costs = vec![0; width];
            let mut right: Option<(u32, u32)> = None;
            for column in (0..width).rev() {
                let down = below.get(column).copied().unwrap_or(0);
                let a = actual.get(column);
                let (cost, step) = match (right, a) {
                    (Some((right, _)), Some(_)) if any => {
                        if down <= right {
                            (down, Move::Pass)
                        } else {
                            (right, Move::Take)
                        }
                    }
                    _ if any => (down, Move::Pass),
                    (Some((_, diagonal)), Some(a)) if line_matches(e, a) => (diagonal, Move::Same),
                    (Some((right, diagonal)), Some(_)) => [
                        (diagonal + 1, Move::Replace),
                        (down + 1, Move::Missing),
                        (right + 1, Move::Extra),
                    ]
                    .into_iter()
                    .min_by_key(|(cost, _)| *cost)
                    .unwrap_or((0, Move::Replace)),
                    _ => (down + 1, Move::Missing),
                };
                if let Some(place) = costs.get_mut(column) {
                    *place = cost;
                }
                if let Some(place) = moves.get_mut(row * width + column) {
                    *place = step;
                }
                right = Some((cost, down));
            }
            below = costs;
        }
        Costs {
            width,
            moves,
            expected: expected.len(),
            actual: actual.len(),
        }
    }

    fn walk(&self, rows: &mut Rows) {
        let (mut e, mut a, mut taken) = (0, 0, 0);
        while e < self.expected || a < self.actual {
            let step = self.moves.get(e * self.width + a).copied();
            match step.unwrap_or(Move::Extra) {
                Move::Same => {
                    rows.same(1);
                    (e, a) = (e + 1, a + 1);
                }
                Move::Replace => {
                    rows.missing(1);
                    rows.extra(1);
                    (e, a) = (e + 1, a + 1);
                }
                Move::Missing => {
                    rows.missing(1);
                    e += 1;
                }
                Move::Extra => {
                    rows.extra(1);
                    a += 1;
                }
                Move::Take => {
                    taken += 1;
                    a += 1;
                }
                Move::Pass => {
                    rows.any(taken);
                    taken = 0;
                    e += 1;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::transcript::align::*;
    use proptest::prelude::*;

    fn lines(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_owned).collect()
    }

    /// Rows as text: `=` same, `*n` a wildcard for n lines, `-` missing, `+` extra.
    fn aligned(expected: &str, actual: &str) -> String {
        align(&lines(expected), &lines(actual))
            .iter()
            .map(|row| match row {
                Row::Same { .. } => "=".to_owned(),
                Row::Any { actual, .. } => format!("*{}", actual.len()),
                Row::Missing { .. } => "-".to_owned(),
                Row::Extra { .. } => "+".to_owned(),
            })
            .collect()
    }

    #[test]
    fn equal_lines_agree() {
        assert_eq!(aligned("a b", "a b"), "==");
        assert_eq!(aligned("", ""), "");
    }

    #[test]
    fn a_wildcard_takes_any_number_of_lines() {
        assert_eq!(aligned("... c", "a b c"), "*2=");
        assert_eq!(aligned("... c", "c"), "*0=");
        assert_eq!(aligned("a ...", "a b c"), "=*2");
        assert_eq!(aligned("...", ""), "*0");
        assert_eq!(aligned("... b ... b", "a b a b a b"), "*1=*3=");
    }

    #[test]
    fn a_changed_line_after_a_wildcard_is_not_swallowed() {
        assert_eq!(aligned("... c", "a b d"), "*2-+");
        assert_eq!(aligned("... c d", "a b c e"), "*2=-+");
    }

    #[test]
    fn differences_are_as_few_as_can_be() {
        assert_eq!(aligned("a b c", "a c"), "=-=");
        assert_eq!(aligned("a c", "a b c"), "=+=");
        assert_eq!(aligned("x[..] b c", "xy b d"), "==-+");
        assert_eq!(aligned("... b c d", "a b d"), "*1=-=");
    }

    proptest! {
        #[test]
        fn every_line_is_in_exactly_one_row(
            expected in proptest::collection::vec("a|b|[a-b]\\[\\.\\.\\]|\\.\\.\\.", 0..8),
            actual in proptest::collection::vec("a|b|ab|ba", 0..8),
        ) {
            let (mut e, mut a) = (0, 0);
            for row in align(&expected, &actual) {
                match row {
                    Row::Same { expected: i, actual: j } => {
                        prop_assert_eq!((i, j), (e, a));
                        prop_assert!(line_matches(&expected[i], &actual[j]));
                        (e, a) = (e + 1, a + 1);
                    }
                    Row::Any { expected: i, actual: range } => {
                        prop_assert_eq!((i, range.start), (e, a));
                        prop_assert!(is_any_lines(&expected[i]));
                        (e, a) = (e + 1, range.end);
                    }
                    Row::Missing { expected: i } => {
                        prop_assert_eq!(i, e);
                        e += 1;
                    }
                    Row::Extra { actual: j } => {
                        prop_assert_eq!(j, a);
                        a += 1;
                    }
                }
            }
            prop_assert_eq!((e, a), (expected.len(), actual.len()));
        }
    }
}
