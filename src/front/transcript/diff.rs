//! Writes differences as unified diffs.

use super::align::Row;
use super::verdict::Difference;

/// Number of agreeing lines shown around those that differ.
const CONTEXT: usize = 3;

/// The lines of the diff, each with its mark ` `, `-` or `+`, and `@@` before each hunk.
pub(crate) fn unified(difference: &Difference) -> Vec<String> {
    let rows = &difference.rows;
    let mut shown: Vec<bool> = vec![false; rows.len()];
    for (at, _) in rows.iter().enumerate().filter(|(_, row)| !row.agrees()) {
        for flag in shown
            .iter_mut()
            .take(at + CONTEXT + 1)
            .skip(at.saturating_sub(CONTEXT))
        {
            *flag = true;
        }
    }
    let mut text = Vec::new();
    let mut hunk = Hunk::at(difference.first_line, difference.first_line);
    for (row, shown) in rows.iter().zip(shown) {
        if shown {
            hunk.push(difference, row);
        } else {
            hunk.end(&mut text);
            hunk.skip();
        }
    }
    hunk.end(&mut text);
    text
}

/// A hunk under construction. A line `...` counts as one line on either side.
struct Hunk {
    old_start: usize,
    new_start: usize,
    old: usize,
    new: usize,
    /// Added lines, which follow the removed lines before them.
    added: Vec<String>,
    lines: Vec<String>,
}

impl Hunk {
    fn at(old_start: usize, new_start: usize) -> Self {
        Hunk {
            old_start,
            new_start,
            old: 0,
            new: 0,
            added: Vec::new(),
            lines: Vec::new(),
        }
    }

    fn push(&mut self, difference: &Difference, row: &Row) {
        let expected = |at: usize| difference.expected.get(at).map_or("", String::as_str);
        match row {
            Row::Same { expected: at, .. } | Row::Any { expected: at, .. } => {
                self.lines.append(&mut self.added);
                self.lines.push(format!(" {}", expected(*at)));
                self.old += 1;
                self.new += 1;
            }
            Row::Missing { expected: at } => {
                self.lines.push(format!("-{}", expected(*at)));
                self.old += 1;
            }
            Row::Extra { actual: at } => {
                let line = difference.actual.get(*at).map_or("", String::as_str);
                self.added.push(format!("+{line}"));
                self.new += 1;
            }
        }
    }

    /// Skips a row that agrees and is not shown.
    fn skip(&mut self) {
        self.old_start += 1;
        self.new_start += 1;
    }

    fn end(&mut self, text: &mut Vec<String>) {
        self.lines.append(&mut self.added);
        if self.lines.is_empty() {
            return;
        }
        text.push(format!(
            "@@ -{} +{} @@",
            range(self.old_start, self.old),
            range(self.new_start, self.new)
        ));
        text.append(&mut self.lines);
        *self = Hunk::at(self.old_start + self.old, self.new_start + self.new);
    }
}

/// An empty range is named by the line before it.
fn range(start: usize, length: usize) -> String {
    match length {
        0 => format!("{},0", start.saturating_sub(1)),
        1 => start.to_string(),
        _ => format!("{start},{length}"),
    }
}

#[cfg(test)]
mod tests {
    use crate::transcript::parse::Transcript;
    use crate::transcript::verdict::Verdict;

    /// The diff of a transcript's only entry, against an output.
    fn diff(text: &str, output: &str) -> Vec<String> {
        let transcript = Transcript::parse("a.transcript", text);
        match Verdict::of(&transcript.entries[0], output) {
            Verdict::Passed => Vec::new(),
            Verdict::Failed(difference) => difference.unified(),
        }
    }

    #[test]
    fn a_changed_line_is_removed_and_added() {
        assert_eq!(diff("about\nA> x\n1\n", "2\n"), ["@@ -3 +3 @@", "-1", "+2"]);
    }

    #[test]
    fn removed_lines_come_before_added_ones() {
        assert_eq!(
            diff("A> x\n...\n1\n2\n3\n", "a\n4\n5\n3\n"),
            ["@@ -2,4 +2,4 @@", " ...", "-1", "-2", "+4", "+5", " 3"]
        );
    }

    #[test]
    fn missing_output_names_the_line_before() {
        assert_eq!(diff("A> x\n1\n", ""), ["@@ -2 +1,0 @@", "-1"]);
        assert_eq!(diff("A> x\n", "1\n"), ["@@ -1,0 +2 @@", "+1"]);
    }

    #[test]
    fn far_lines_that_agree_are_left_out() {
        let expected = "A> x\n0\n1\n2\n3\n4\n5\n6\n7\n8\n9\n";
        let output = "a\n1\n2\n3\n4\n5\n6\n7\n8\nb\n";
        assert_eq!(
            diff(expected, output),
            [
                "@@ -2,4 +2,4 @@",
                "-0",
                "+a",
                " 1",
                " 2",
                " 3",
                "@@ -8,4 +8,4 @@",
                " 6",
                " 7",
                " 8",
                "-9",
                "+b"
            ]
        );
    }
}
