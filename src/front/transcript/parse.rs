//! Reads transcripts.

use std::ops::Range;

use super::markdown::session_blocks;
use session::dialogue::prompt_line::{PromptLine, prompt_line};
use session::dialogue::{ends_in_quotes, is_whole};

/// A file of inputs, each with its expected output.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Transcript {
    /// The name of the file as given.
    pub(crate) name: String,
    /// All lines of the file.
    pub(crate) lines: Vec<String>,
    /// The inputs, in order.
    pub(crate) entries: Vec<Entry>,
}

/// An input with its expected output.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Entry {
    /// Line of the prompt, from one.
    pub(crate) line: usize,
    /// Whether an evaluation is stopped when the prompt appears.
    pub(crate) is_stopped: bool,
    /// The text after the prompt, up to and including the line that completes it.
    pub(crate) input: String,
    /// The expected lines, without trailing blanks and trailing blank lines.
    pub(crate) expected: Vec<String>,
    /// Range of the expected lines among the file's lines, from zero.
    pub(crate) expected_at: Range<usize>,
}

impl Transcript {
    /// Reads a transcript, from Markdown if `name` ends in `.md`.
    pub(crate) fn parse(name: &str, text: &str) -> Self {
        let lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let is_markdown = name.to_ascii_lowercase().ends_with(".md");
        let blocks = if is_markdown {
            session_blocks(&lines)
        } else {
            std::iter::once(0..lines.len()).collect()
        };
        let entries = blocks
            .into_iter()
            .flat_map(|block| entries(&lines, block))
            .collect();
        Transcript {
            name: name.to_owned(),
            lines,
            entries,
        }
    }
}

/// The entries in a range of lines.
fn entries(lines: &[String], block: Range<usize>) -> Vec<Entry> {
    let prompts: Vec<(usize, PromptLine<'_>)> = lines
        .iter()
        .enumerate()
        .take(block.end)
        .skip(block.start)
        .filter_map(|(number, line)| Some((number, prompt_line(line)?)))
        .collect();
    let end_before = |index: usize| prompts.get(index).map_or(block.end, |(number, _)| *number);
    let mut found = Vec::new();
    let mut index = 0;
    while let Some((number, prompt)) = prompts.get(index) {
        let input_before = |next| input(lines, *number, prompt.input, end_before(next)).0;
        let mut next = index + 1;
        // A line within a string may look like a prompt.
        while next < prompts.len() && ends_in_quotes(&input_before(next)) {
            next += 1;
        }
        if !is_whole(&input_before(next)) {
            next = index + 1;
        }
        found.push(entry(lines, *number, *prompt, end_before(next)));
        index = next;
    }
    found
}

/// The input whose prompt is on line `number`, up to the line that completes it but before line
/// `end`; and the line after it.
fn input(lines: &[String], number: usize, first: &str, end: usize) -> (String, usize) {
    let mut input = first.to_owned();
    let mut next = number + 1;
    while !is_whole(&input) {
        let Some(line) = lines.get(next).filter(|_| next < end) else {
            break;
        };
        input.push('\n');
        input.push_str(line);
        next += 1;
    }
    (input, next)
}

/// The entry whose prompt is on line `number`; the next prompt is on line `end`.
///
/// An input that is incomplete at the next prompt ends there; reading it then fails.
fn entry(lines: &[String], number: usize, prompt: PromptLine<'_>, end: usize) -> Entry {
    let (input, next) = input(lines, number, prompt.input, end);
    let following = lines.get(next..end).unwrap_or_default();
    let expected = without_blank_end(following.iter().map(String::as_str));
    let expected_at = next..next + expected.len();
    Entry {
        line: number + 1,
        is_stopped: !prompt.state.is_empty(),
        input,
        expected,
        expected_at,
    }
}

/// The lines without trailing blanks and trailing blank lines.
pub(crate) fn without_blank_end<'a>(lines: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut lines: Vec<String> = lines.map(|line| line.trim_end().to_owned()).collect();
    while lines.last().is_some_and(String::is_empty) {
        lines.pop();
    }
    lines
}

#[cfg(test)]
mod tests {
    use crate::transcript::parse::*;

    fn parsed(text: &str) -> Vec<(usize, String, Vec<String>)> {
        Transcript::parse("a.transcript", text)
            .entries
            .into_iter()
            .map(|entry| (entry.line, entry.input, entry.expected))
            .collect()
    }

    fn entry(line: usize, input: &str, expected: &[&str]) -> (usize, String, Vec<String>) {
        let expected = expected.iter().map(|&line| line.to_owned()).collect();
        (line, input.to_owned(), expected)
    }

    #[test]
    fn text_before_the_first_prompt_is_a_comment() {
        assert_eq!(parsed("about this\n\nA> 1\n1\n"), [entry(3, "1", &["1"])]);
        assert_eq!(parsed("about this\n"), []);
    }

    #[test]
    fn output_ends_before_the_next_prompt_and_blank_lines() {
        assert_eq!(
            parsed("A> (terpri)\n\nNIL  \n\n\nB> 2\n2"),
            [entry(1, "(terpri)", &["", "NIL"]), entry(6, "2", &["2"])]
        );
    }

    #[test]
    fn an_input_goes_on_until_it_balances() {
        assert_eq!(
            parsed("A> (list \"(\n\" ; )\n  #\\()\n(\"x\")\n"),
            [entry(1, "(list \"(\n\" ; )\n  #\\()", &["(\"x\")"])]
        );
    }

    #[test]
    fn a_prompt_line_may_hold_several_forms() {
        assert_eq!(
            parsed("A> (defun f () 1) (f)\nF\n1\n"),
            [entry(1, "(defun f () 1) (f)", &["F", "1"])]
        );
    }

    #[test]
    fn an_input_that_never_balances_ends_at_the_next_prompt() {
        assert_eq!(
            parsed("A> (car\n'(1)\nA> 2\n2\n"),
            [entry(1, "(car\n'(1)", &[]), entry(3, "2", &["2"])]
        );
    }

    #[test]
    fn a_line_of_a_string_is_no_prompt() {
        assert_eq!(
            parsed("A> (list \"x\nA> y\nB 1]> z\")\n(\"x\n\nA> 2\n2\n"),
            [
                entry(1, "(list \"x\nA> y\nB 1]> z\")", &["(\"x"]),
                entry(6, "2", &["2"])
            ]
        );
        // A string that nothing ends does not swallow the rest.
        assert_eq!(
            parsed("A> (list \"x\nA> 2\n2\n"),
            [entry(1, "(list \"x", &[]), entry(2, "2", &["2"])]
        );
    }

    #[test]
    fn in_markdown_only_session_blocks_are_read() {
        let text = "A> no\n```session\nA> 1\n1\n```\nA> no\n```session\nB> 2\n2\n\n```\n";
        let entries = Transcript::parse("docs/a.md", text).entries;
        let lines: Vec<usize> = entries.iter().map(|entry| entry.line).collect();
        assert_eq!(lines, [3, 8]);
        assert_eq!(entries[1].expected, ["2"]);
        assert_eq!(entries[1].expected_at, 8..9);
    }
}
