//! Rewrites the expected output of a transcript.

use super::align::Row;
use super::parse::Transcript;
use super::verdict::{Difference, Verdict};

/// The text of the transcript, with the actual output of failed entries in place of the
/// expected output. Wildcards that still match are kept.
///
/// `verdicts` are those of all entries, in order.
pub(crate) fn blessed(transcript: &Transcript, verdicts: &[Verdict]) -> String {
    let mut lines: Vec<&str> = Vec::new();
    let mut next = 0;
    for (entry, verdict) in transcript.entries.iter().zip(verdicts) {
        let Verdict::Failed(difference) = verdict else {
            continue;
        };
        let range = &entry.expected_at;
        let before = transcript.lines.get(next..range.start);
        lines.extend(before.unwrap_or_default().iter().map(String::as_str));
        lines.extend(new_lines(difference));
        next = range.end;
    }
    let rest = transcript.lines.get(next..).unwrap_or_default();
    lines.extend(rest.iter().map(String::as_str));
    let mut text = lines.join("\n");
    text.push('\n');
    text
}

fn new_lines(difference: &Difference) -> Vec<&str> {
    let mut lines: Vec<&str> = Vec::new();
    let mut rows = difference.rows.iter().peekable();
    let mut before_agrees = true;
    while let Some(row) = rows.next() {
        let line = match row {
            // Beside a difference, a wildcard that matches no line says nothing any more.
            Row::Any { actual, .. }
                if actual.is_empty()
                    && !(before_agrees && rows.peek().is_none_or(|r| r.agrees())) =>
            {
                None
            }
            Row::Same { expected, .. } | Row::Any { expected, .. } => {
                difference.expected.get(*expected)
            }
            Row::Extra { actual } => difference.actual.get(*actual),
            Row::Missing { .. } => None,
        };
        before_agrees = row.agrees();
        lines.extend(line.map(String::as_str));
    }
    lines
}

#[cfg(test)]
mod tests {
    use crate::transcript::bless::*;
    use proptest::prelude::*;

    /// Blesses a transcript with the given outputs of its entries.
    fn bless(text: &str, outputs: &[&str]) -> String {
        let transcript = Transcript::parse("a.transcript", text);
        let verdicts: Vec<Verdict> = transcript
            .entries
            .iter()
            .zip(outputs)
            .map(|(entry, output)| Verdict::of(entry, output))
            .collect();
        blessed(&transcript, &verdicts)
    }

    #[test]
    fn only_what_failed_changes() {
        let text = "about\n\nA> 1\n1  \n\nA> 2\n3\n\n\nA> 4\n4\n";
        assert_eq!(
            bless(text, &["1\n", "2\n", "4\n"]),
            "about\n\nA> 1\n1  \n\nA> 2\n2\n\n\nA> 4\n4\n"
        );
    }

    #[test]
    fn wildcards_that_still_match_are_kept() {
        assert_eq!(
            bless("A> x\n...\nb[..]\n3\n", &["1\n2\nbb\n4\n"]),
            "A> x\n...\nb[..]\n4\n"
        );
        assert_eq!(bless("A> x\n...\nb\n", &["c\n"]), "A> x\nc\n");
    }

    #[test]
    fn output_appears_where_none_was_expected() {
        assert_eq!(
            bless("A> x\n\nA> y\n", &["1\n", "2\n"]),
            "A> x\n1\n\nA> y\n2\n"
        );
    }

    #[test]
    fn blessing_twice_changes_nothing() {
        let once = bless("A> x\n1\n...\n2\n", &["3\n4\n"]);
        assert_eq!(bless(&once, &["3\n4\n"]), once);
    }

    proptest! {
        #[test]
        fn a_blessed_transcript_passes(
            entries in proptest::collection::vec(
                (
                    proptest::collection::vec("a|b|ab||\\.\\.\\.|a\\[\\.\\.\\]", 0..6),
                    proptest::collection::vec("a|b|ab||a b ", 0..6),
                ),
                1..4,
            ),
        ) {
            let text: String = entries
                .iter()
                .map(|(expected, _)| format!("A> x\n{}\n\n", expected.join("\n")))
                .collect();
            let outputs: Vec<String> = entries.iter().map(|(_, lines)| lines.join("\n")).collect();
            let outputs: Vec<&str> = outputs.iter().map(String::as_str).collect();
            let blessed = bless(&text, &outputs);
            prop_assert_eq!(bless(&blessed, &outputs), blessed.clone());
            let transcript = Transcript::parse("a.transcript", &blessed);
            prop_assert_eq!(transcript.entries.len(), outputs.len());
            for (entry, output) in transcript.entries.iter().zip(outputs) {
                prop_assert!(Verdict::of(entry, output).passed());
            }
        }
    }
}
