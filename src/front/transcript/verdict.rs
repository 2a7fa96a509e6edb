//! What the comparison of an entry came to.

use super::align::{Row, align};
use super::diff::unified;
use super::parse::{Entry, without_blank_end};

/// Whether an entry's output is as expected.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Verdict {
    /// As expected.
    Passed,
    /// Not as expected.
    Failed(Difference),
}

/// How an output differs from the expected one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Difference {
    /// Line of the entry's prompt in its file, from one.
    pub(crate) entry_line: usize,
    /// Line of the first difference in its file, from one.
    pub(crate) line: usize,
    /// The first line of the input.
    pub(crate) input: String,
    /// What was put out, without blanks at the ends of lines and blank last lines.
    pub(crate) actual: Vec<String>,
    pub(crate) expected: Vec<String>,
    pub(crate) rows: Vec<Row>,
    /// The line of the first expected line, from one.
    pub(crate) first_line: usize,
}

/// What the prompt prints for a form without a value.
const NO_VALUE: &str = "; No value";

impl Verdict {
    /// Compares the output of an entry with what it expects.
    pub(crate) fn of(entry: &Entry, output: &str) -> Self {
        let mut actual = without_blank_end(output.lines());
        // That a form has no value may be said or left out.
        if entry.expected.last().map(String::as_str) != Some(NO_VALUE) {
            actual.retain(|line| line != NO_VALUE);
        }
        let rows = align(&entry.expected, &actual);
        let Some(at) = rows.iter().position(|row| !row.agrees()) else {
            return Verdict::Passed;
        };
        let expected_before = rows
            .iter()
            .take(at)
            .filter(|row| !matches!(row, Row::Extra { .. }))
            .count();
        let first_line = entry.expected_at.start + 1;
        Verdict::Failed(Difference {
            entry_line: entry.line,
            line: first_line + expected_before,
            input: entry.input.lines().next().unwrap_or_default().to_owned(),
            actual,
            expected: entry.expected.clone(),
            rows,
            first_line,
        })
    }

    /// The output is as expected.
    pub(crate) fn passed(&self) -> bool {
        *self == Verdict::Passed
    }
}

impl Difference {
    /// The difference as a unified diff, whose line numbers are those of the file.
    pub(crate) fn unified(&self) -> Vec<String> {
        unified(self)
    }
}
