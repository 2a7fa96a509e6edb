//! Finds the inputs in text copied from a session or a tutorial: strips prompts, and tells
//! forms from output.

use std::borrow::Cow;
use std::mem;

use crate::transcript::Transcript;
use lisp::reader::{Lexer, TokenKind};
use session::dialogue::prompt_line::prompt_line;
use session::dialogue::{GrowingInput, is_whole};

/// The inputs found in text typed or pasted at the prompt.
#[derive(PartialEq, Eq, Debug, Default)]
pub(crate) struct Inputs<'a> {
    /// To be evaluated one after the other.
    pub(crate) inputs: Vec<Cow<'a, str>>,
    /// What looks like output, and answers to a debugger.
    pub(crate) left_out: Vec<String>,
    /// Forms that were not finished when the next prompt began.
    pub(crate) unfinished: Vec<String>,
}

impl<'a> Inputs<'a> {
    /// Splits a text at its prompts; without prompts it is one input.
    pub(crate) fn of(text: &'a str) -> Self {
        let mut found = Inputs::default();
        let Some(at) = first_prompt(text) else {
            found.take_without_prompt(text);
            return found;
        };
        let (before, session) = text.split_at(at);
        if is_whole(before) {
            found.take_without_prompt(before);
        } else {
            found.unfinished.extend(before.lines().map(str::to_owned));
        }
        for entry in Transcript::parse("", session.trim_start()).entries {
            let (forms, output) = forms_among(&entry.expected);
            if entry.is_stopped {
                // An answer to the debugger: without a condition it means nothing.
                let answer = entry.input.lines().map(str::to_owned);
                found.left_out.extend(answer);
                found.take(forms.join("\n"));
            } else {
                let mut pieces = split_at_prompts(&entry.input);
                let last = pieces.pop().unwrap_or_default();
                for piece in pieces {
                    let form = found.without_output(piece);
                    found.take(form);
                }
                let form = found.without_output(last);
                let last = (!form.trim().is_empty()).then_some(form);
                found.take(last.into_iter().chain(forms).collect::<Vec<_>>().join("\n"));
            }
            found.left_out.extend(output);
        }
        found
    }

    /// Takes what stands before the first prompt that begins a line.
    fn take_without_prompt(&mut self, text: &'a str) {
        let pieces = split_at_prompts(text);
        if pieces.len() > 1 {
            for piece in pieces {
                let form = self.without_output(piece);
                self.take(form);
            }
        } else if !text.trim().is_empty() {
            self.inputs.push(Cow::Borrowed(text));
        }
    }

    fn take(&mut self, input: String) {
        if !input.trim().is_empty() {
            self.inputs.push(Cow::Owned(input));
        }
    }

    /// What follows a prompt without the output behind it, which is left out.
    fn without_output(&mut self, piece: String) -> String {
        let at = end_of_forms(&piece);
        let (forms, output) = piece.split_at_checked(at).unwrap_or((&piece, ""));
        if output.trim().is_empty() {
            return piece;
        }
        self.left_out
            .extend(output.trim().lines().map(str::to_owned));
        forms.trim_end().to_owned()
    }

    /// Whether the inputs are complete.
    pub(crate) fn are_whole(&self) -> bool {
        self.inputs.last().is_none_or(|input| is_whole(input))
    }
}

/// Offset of the first line with a prompt outside a form. An unfinished form does not go on with a
/// line that has a prompt and a form.
fn first_prompt(text: &str) -> Option<usize> {
    let mut start = 0;
    let mut input = GrowingInput::default();
    for line in text.split_inclusive('\n') {
        let before = text.get(..start)?;
        let content = line.trim_end_matches(['\r', '\n']);
        let is_prompt = |line| {
            let prompt = prompt_line(line).filter(|prompt| prompt.state.is_empty());
            prompt.map(|prompt| prompt.input.trim_start().starts_with('('))
        };
        if let Some(has_form) = is_prompt(content.trim_start()) {
            let is_indented = content.starts_with([' ', '\t']);
            if input.is_whole(before) && (has_form || !is_indented) {
                return Some(start);
            }
            if has_form && !input.ends_in_quotes(before) {
                return Some(start);
            }
        }
        start += line.len();
    }
    None
}

/// The inputs of an entry: text whose line breaks were lost has prompts in the middle of lines,
/// after complete forms and their output.
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
            && is_list(before)
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

/// Whether a text begins with a whole list, perhaps quoted.
fn is_list(text: &str) -> bool {
    let text = text.trim_start();
    text.trim_start_matches(['\'', '`', '#']).starts_with('(')
        && (end_of_forms(text) < text.len() || is_whole(text))
}

/// Where the output begins in what follows a prompt: behind the first list and the lists after it
/// that somebody has written. At the end if there is none, or if there is no list.
fn end_of_forms(text: &str) -> usize {
    if text.trim_start().starts_with(LOG_LINE) {
        return 0;
    }
    let (mut depth, mut start, mut end) = (0usize, 0, 0);
    for token in Lexer::new(text) {
        match token.kind {
            TokenKind::Open => {
                if depth == 0 {
                    start = token.start;
                }
                depth += 1;
            }
            TokenKind::Close => {
                depth = depth.saturating_sub(1);
                let list = text.get(start..token.end).unwrap_or_default();
                if depth == 0 && end > 0 && !is_written(list) {
                    return end;
                }
                if depth == 0 {
                    end = token.end;
                }
            }
            TokenKind::Dispatch { letter: '(', .. } => depth += 1,
            TokenKind::LineComment | TokenKind::BlockComment if depth == 0 => end = token.end,
            TokenKind::Quote | TokenKind::Backquote | TokenKind::Dispatch { .. } if end == 0 => {}
            _ if depth > 0 => {}
            _ if end == 0 => return text.len(),
            _ => return end,
        }
    }
    if depth > 0 { text.len() } else { end.max(1) }
}

/// How a line of a log begins, as in `[(PICK-UP) INFO] 1.5: Reaching`.
const LOG_LINE: &str = "[(";

/// Tells the forms that somebody has written from lines of output; comments are neither.
fn forms_among(lines: &[String]) -> (Vec<String>, Vec<String>) {
    let (mut forms, mut output) = (Vec::new(), Vec::new());
    let mut at = 0;
    while let Some(line) = lines.get(at) {
        let rest = lines.get(at..).unwrap_or_default();
        let text = line.starts_with('(').then(|| first_input(rest)).flatten();
        match text.filter(|text| is_written(text)) {
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

/// The first complete input of some lines.
fn first_input(lines: &[String]) -> Option<String> {
    let mut text = String::new();
    let mut input = GrowingInput::default();
    lines.iter().find_map(|line| {
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(line);
        input.is_whole(&text).then(|| mem::take(&mut text))
    })
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
    fn what_stands_between_a_form_and_the_next_prompt_is_output() {
        assert_eq!(
            inputs("A> (first '(1 2)) 1 A> (rest '(1 2)) (2)"),
            of(&["(first '(1 2))", "(rest '(1 2))"], 2)
        );
        assert_eq!(
            inputs("(first '(1 2)) 1 A> (b) The variable B is unbound."),
            of(&["(first '(1 2))", "(b)"], 2)
        );
        assert_eq!(inputs("A> (f) (g 1) NIL"), of(&["(f) (g 1)"], 1));
        assert_eq!(inputs("A> (f) ; a comment"), of(&["(f) ; a comment"], 0));
        assert_eq!(inputs("A> '(f) (F)"), of(&["'(f)"], 1));
    }

    #[test]
    fn log_lines_are_output() {
        assert_eq!(
            inputs("A> (go 1) [(PICK UP) INFO] 15.3: #<POSE (1 2)> Reaching [(B) WARN] x"),
            of(&["(go 1)"], 1)
        );
        assert_eq!(inputs("A> [(P) WARN] 12.6: #<AN OBJECT>. ; no"), of(&[], 1));
        assert!(Inputs::of("A> (go 1) [(P) INFO] (x").are_whole());
    }

    #[test]
    fn a_prompt_ends_an_unfinished_form() {
        let found = Inputs::of("(a (b)\n  A> (c)\nA> (d)");
        assert_eq!(found.inputs, ["(c)", "(d)"]);
        assert_eq!(found.unfinished, ["(a (b)"]);
        assert_eq!(inputs("(print \"a\nA> (b)\")").0.len(), 1);
    }

    #[test]
    fn a_comment_that_has_swallowed_code_does_not_keep_the_input_open() {
        assert_eq!(
            inputs("A> (a ;; One. (b) ;; Two. (c))\nA> (d)"),
            of(&["(a ;; One. (b) ;; Two. (c))", "(d)"], 0)
        );
        assert!(Inputs::of("(a ;; One. (b))").are_whole());
        assert!(!Inputs::of("(a ;; One. (b)").are_whole());
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
