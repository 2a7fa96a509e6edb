//! The result of comparing an entry with its output.

use super::align::{Row, align};
use super::diff::unified;
use super::parse::{Entry, without_blank_end};

/// Whether an entry's output is as expected.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Verdict {
    /// The output is as expected.
    Passed,
    /// The output differs.
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
    /// The output, without trailing blanks and trailing blank lines.
    pub(crate) actual: Vec<String>,
    pub(crate) expected: Vec<String>,
    pub(crate) rows: Vec<Row>,
    /// Line of the first expected line in the file, from one.
    pub(crate) first_line: usize,
}

/// What the prompt prints for a form that returns no value.
const NO_VALUE: &str = "; No value";

impl Verdict {
    /// Compares an entry's expected output with the actual one.
    pub(crate) fn of(entry: &Entry, output: &str) -> Self {
        let mut actual = without_blank_end(output.lines());
        // The remark that a form has no value is optional.
        if !entry.expected.iter().any(|line| line == NO_VALUE) {
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

    /// Whether the output is as expected.
    pub(crate) fn passed(&self) -> bool {
        *self == Verdict::Passed
    }
}

impl Difference {
    /// The difference as a unified diff, with line numbers of the file.
    pub(crate) fn unified(&self) -> Vec<String> {
        unified(self)
    }
}
