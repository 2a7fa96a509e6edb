//! Strips the prompts from text copied from a session.

use std::borrow::Cow;

use crate::front::transcript::Transcript;
use crate::session::dialogue::is_whole;
use crate::session::dialogue::prompt_line::prompt_line;

/// The inputs found in text typed or pasted at the prompt.
#[derive(PartialEq, Eq, Debug)]
pub(crate) struct Inputs<'a> {
    /// To be evaluated one after the other.
    pub(crate) inputs: Vec<Cow<'a, str>>,
    /// Number of lines of output that were copied along with the inputs.
    pub(crate) output_lines: usize,
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
                output_lines: 0,
            };
        };
        let (before, session) = text.split_at(at);
        let mut inputs = Inputs::of(before);
        for entry in Transcript::parse("", session).entries {
            inputs.output_lines += entry.expected.len();
            if entry.is_stopped {
                // An answer to the debugger: without a condition it means nothing.
                inputs.output_lines += entry.input.lines().count().max(1);
            } else if !entry.input.trim().is_empty() {
                inputs.inputs.push(Cow::Owned(entry.input));
            }
        }
        inputs
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

#[cfg(test)]
mod tests {
    use crate::front::prompt::pasted::*;

    fn inputs(text: &str) -> (Vec<String>, usize) {
        let found = Inputs::of(text);
        let inputs = found.inputs.into_iter().map(Cow::into_owned).collect();
        (inputs, found.output_lines)
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
            (vec!["(print 1)".to_owned(), "2".to_owned()], 3)
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
    fn the_last_input_has_to_be_whole() {
        assert!(Inputs::of("A> (a)\nA> (b)").are_whole());
        assert!(!Inputs::of("A> (a)\nA> (b").are_whole());
        assert!(Inputs::of("").are_whole());
    }
}
