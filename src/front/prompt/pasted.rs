//! Finds the inputs in text copied from a session or a tutorial: strips prompts, and tells
//! forms from output.

use std::borrow::Cow;

use crate::transcript::Transcript;
use lisp::reader::{Lexer, TokenKind};
use session::dialogue::is_whole;
use session::dialogue::prompt_line::prompt_line;

/// The inputs found in text typed or pasted at the prompt.
#[derive(PartialEq, Eq, Debug)]
pub(crate) struct Inputs<'a> {
    /// To be evaluated one after the other.
    pub(crate) inputs: Vec<Cow<'a, str>>,
    /// Lines that look like output, and answers to a debugger.
    pub(crate) left_out: Vec<String>,
}

impl<'a> Inputs<'a> {
    /// Splits a text at its prompts; without prompts it is one input.
    pub(crate) fn of(text: &'a str) -> Self {
        let Some(at) = first_prompt(text) else {
            let inputs = if text.trim().is_empty() {
                Vec::new()
            } else {
                vec![Cow::Borrowed(text)]
            };
            return Inputs {
                inputs,
                left_out: Vec::new(),
            };
        };
        let (before, session) = text.split_at(at);
        let mut found = Inputs::of(before);
        for entry in Transcript::parse("", session).entries {
            let mut inputs = split_at_prompts(&entry.input);
            let (forms, output) = forms_among(&entry.expected);
            if entry.is_stopped {
                // An answer to the debugger: without a condition it means nothing.
                found
                    .left_out
                    .extend(entry.input.lines().map(str::to_owned));
                inputs.clear();
            }
            let last = inputs
                .pop()
                .into_iter()
                .filter(|input| !input.trim().is_empty());
            inputs.push(last.chain(forms).collect::<Vec<_>>().join("\n"));
            found.left_out.extend(output);
            let inputs = inputs.into_iter().filter(|input| !input.trim().is_empty());
            found.inputs.extend(inputs.map(Cow::Owned));
        }
        found
    }

    /// Whether the inputs are complete.
    pub(crate) fn are_whole(&self) -> bool {
        self.inputs.last().is_none_or(|input| is_whole(input))
    }
}

/// Offset of the first line with a prompt outside a form.
fn first_prompt(text: &str) -> Option<usize> {
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let prompt = prompt_line(line.trim_end_matches(['\r', '\n']));
        if prompt.is_some_and(|prompt| prompt.state.is_empty()) {
            let before = text.get(..start)?;
            return is_whole(before).then_some(start);
        }
        start += line.len();
    }
    None
}

/// The inputs of an entry: text whose line breaks were lost has prompts in the middle of lines,
/// after complete forms.
fn split_at_prompts(input: &str) -> Vec<String> {
    let mut inputs = Vec::new();
    let mut rest = input;
    let mut from = 0;
    while let Some(found) = rest
        .get(from..)
        .and_then(|text| text.find(char::is_whitespace))
    {
        let at = from + found;
        let (before, after) = (rest.get(..at).unwrap_or_default(), rest.get(at..));
        let after = after.unwrap_or_default().trim_start();
        let line = after.lines().next().unwrap_or_default();
        let next = prompt_line(line).filter(|prompt| prompt.state.is_empty());
        // A name such as `A>` at the very beginning may be meant.
        if let Some(next) = next
            && before.trim_end().ends_with(')')
            && is_whole(before)
        {
            inputs.push(before.to_owned());
            rest = after
                .get(line.len() - next.input.len()..)
                .unwrap_or_default();
            from = 0;
        } else {
            from = rest.len() - after.len();
            if after.is_empty() {
                break;
            }
        }
    }
    inputs.push(rest.to_owned());
    inputs
}

/// Tells the forms that somebody has written from lines of output; comments are neither.
fn forms_among(lines: &[String]) -> (Vec<String>, Vec<String>) {
    let (mut forms, mut output) = (Vec::new(), Vec::new());
    let mut at = 0;
    while let Some(line) = lines.get(at) {
        let rest = lines.get(at..).unwrap_or_default();
        let ends = (1..=rest.len()).find(|count| is_whole(&rest[..*count].join("\n")));
        let text = ends.map(|count| rest[..count].join("\n"));
        match text.filter(|text| line.starts_with('(') && is_written(text)) {
            Some(text) => {
                at += text.lines().count();
                forms.push(text);
            }
            None => {
                at += 1;
                if !line.is_empty() && !line.starts_with(';') {
                    output.push(line.clone());
                }
            }
        }
    }
    (forms, output)
}

/// Whether a text consists of lists that may be forms, at least the first written by somebody: what
/// is printed has its symbols in upper case.
fn is_written(text: &str) -> bool {
    let mut depth = 0usize;
    let mut operators = Vec::new();
    let mut opens = false;
    for token in Lexer::new(text) {
        let is_comment = matches!(token.kind, TokenKind::LineComment | TokenKind::BlockComment);
        if is_comment {
            continue;
        }
        if opens {
            let operator = text.get(token.start..token.end).unwrap_or_default();
            operators.push((token.kind, operator));
        }
        opens = token.kind == TokenKind::Open && depth == 0;
        match token.kind {
            TokenKind::Open => depth += 1,
            TokenKind::Close => depth = depth.saturating_sub(1),
            _ if depth == 0 => return false,
            _ => {}
        }
    }
    let is_operator = |(kind, name): &(TokenKind, &str)| {
        *kind == TokenKind::Atom && name.contains(char::is_lowercase)
    };
    !operators.is_empty() && operators.iter().all(is_operator)
}

#[cfg(test)]
mod tests {
    use crate::prompt::pasted::*;

    fn inputs(text: &str) -> (Vec<String>, usize) {
        let found = Inputs::of(text);
        let inputs = found.inputs.into_iter().map(Cow::into_owned).collect();
        (inputs, found.left_out.len())
    }

    fn of(inputs: &[&str], left_out: usize) -> (Vec<String>, usize) {
        (inputs.iter().map(|&i| i.to_owned()).collect(), left_out)
    }

    #[test]
    fn a_text_without_prompts_is_one_input() {
        assert_eq!(inputs("(a)\n(b)"), (vec!["(a)\n(b)".to_owned()], 0));
        assert_eq!(inputs(" \n"), (vec![], 0));
    }

    #[test]
    fn prompts_are_taken_off() {
        assert_eq!(inputs("PP-TUT> (a\n b)"), (vec!["(a\n b)".to_owned()], 0));
        assert_eq!(
            inputs("CL-USER> (a)\nPP-TUT> (b)\nPP-TUT> "),
            (vec!["(a)".to_owned(), "(b)".to_owned()], 0)
        );
    }

    #[test]
    fn copied_output_is_left_out() {
        assert_eq!(
            inputs("A> (print 1)\n\n1 \n1\nA> 2"),
            (vec!["(print 1)".to_owned(), "2".to_owned()], 2)
        );
    }

    #[test]
    fn text_before_the_prompts_is_an_input() {
        assert_eq!(
            inputs("(a)\nA> 2"),
            (vec!["(a)\n".to_owned(), "2".to_owned()], 0)
        );
    }

    #[test]
    fn a_prompt_within_a_string_stays() {
        assert_eq!(
            inputs("(print \"\nA> \")"),
            (vec!["(print \"\nA> \")".to_owned()], 0)
        );
    }

    #[test]
    fn forms_on_the_lines_after_a_prompt_are_evaluated_too() {
        assert_eq!(
            inputs("A> (a\n 1)\n;; A comment.\n\n(with-b\n  (c)) ; d\nA> 2"),
            of(&["(a\n 1)\n(with-b\n  (c)) ; d", "2"], 0)
        );
        assert_eq!(inputs("A> (a)\n1\n(b)"), of(&["(a)\n(b)"], 1));
        assert_eq!(inputs("A>\n(b)"), of(&["(b)"], 0));
    }

    #[test]
    fn printed_lists_are_no_forms() {
        for output in [
            "(3)",
            "(LIST 1 2)",
            "(:KEY \"a\")",
            "((1.0 2.0) (0 0 0 1))",
            "(help) lists what you can do; (tour) begins.",
            "(\"a\" b)",
            "NIL",
        ] {
            assert_eq!(inputs(&format!("A> (a)\n{output}")), of(&["(a)"], 1));
        }
    }

    #[test]
    fn prompts_in_the_middle_of_a_line_begin_an_input() {
        assert_eq!(
            inputs("A> (a \"B> c\" :d) CL-USER> (b) C> (c\n d)"),
            of(&["(a \"B> c\" :d)", "(b)", "(c\n d)"], 0)
        );
        assert_eq!(inputs("A> (f X> 1)"), of(&["(f X> 1)"], 0));
        assert_eq!(inputs("A> x B> 1"), of(&["x B> 1"], 0));
    }

    #[test]
    fn answers_to_a_debugger_are_left_out() {
        assert_eq!(
            inputs("A> (car 1)\nno\nA 1]> q\nA> 2"),
            of(&["(car 1)", "2"], 2)
        );
    }

    #[test]
    fn the_last_input_has_to_be_whole() {
        assert!(Inputs::of("A> (a)\nA> (b)").are_whole());
        assert!(!Inputs::of("A> (a)\nA> (b").are_whole());
        assert!(Inputs::of("").are_whole());
    }
}
