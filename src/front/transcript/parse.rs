//! Reads transcripts.

use std::ops::Range;

use super::markdown::session_blocks;
use session::dialogue::GrowingInput;
use session::dialogue::prompt_line::{PromptLine, prompt_line};

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
        let (input, line) = input(
            lines,
            *number,
            prompt.input,
            &prompts[index + 1..],
            block.end,
        );
        index += prompts[index..].partition_point(|(number, _)| *number < line);
        found.push(entry(
            lines,
            *number,
            *prompt,
            input,
            line..end_before(index),
        ));
    }
    found
}

/// The input whose prompt is on line `number`, up to the line that completes it or before the next prompt or line
/// `end`; and the line after it. An input that is incomplete at the next prompt ends there; reading it then fails.
fn input(
    lines: &[String],
    number: usize,
    first: &str,
    prompts: &[(usize, PromptLine<'_>)],
    end: usize,
) -> (String, usize) {
    let mut growing = GrowingInput::default();
    let mut input = first.to_owned();
    let mut prompts = prompts.iter().map(|(number, _)| *number).peekable();
    // Where the input ends if nothing completes it.
    let mut at_first_prompt = None;
    for next in number + 1.. {
        if growing.is_whole(&input) {
            return (input, next);
        }
        if prompts.next_if_eq(&next).is_some() {
            at_first_prompt.get_or_insert((input.len(), next));
            // A line within a string may look like a prompt.
            if !growing.ends_in_quotes(&input) {
                break;
            }
        }
        let Some(line) = lines.get(next).filter(|_| next < end) else {
            at_first_prompt.get_or_insert((input.len(), next));
            break;
        };
        input.push('\n');
        input.push_str(line);
    }
    let (length, next) = at_first_prompt.unwrap_or((input.len(), end));
    input.truncate(length);
    (input, next)
}

/// The entry whose prompt is on line `number`, with what is expected on further lines.
fn entry(
    lines: &[String],
    number: usize,
    prompt: PromptLine<'_>,
    input: String,
    following: Range<usize>,
) -> Entry {
    let next = following.start;
    let following = lines.get(following).unwrap_or_default();
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
