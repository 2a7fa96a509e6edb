//! How far continuation lines of an input are indented.

use lisp::reader::{Lexer, TokenKind};

/// Number of blanks at the start of the line after `before`, whose own first line starts at
/// column `first_column`, after the prompt.
///
/// Follows Lisp editors: arguments align with the first argument, bodies are indented by two
/// blanks, data align with the first element. Inside strings and comments nothing is indented.
pub(crate) fn indentation(before: &str, first_column: usize) -> usize {
    let mut lists: Vec<List<'_>> = Vec::new();
    let mut prefixed = None;
    let mut cursor = Cursor::new(before, first_column);
    for token in Lexer::new(before) {
        if !token.is_closed {
            return 0;
        }
        let (line, column) = cursor.advance(token.start);
        let start = prefixed.unwrap_or((line, column));
        match token.kind {
            TokenKind::LineComment | TokenKind::BlockComment => continue,
            TokenKind::Close => {
                lists.pop();
            }
            TokenKind::Open
            | TokenKind::String
            | TokenKind::Character
            | TokenKind::Atom
            | TokenKind::Prefixed { .. } => {
                let is_name = token.kind == TokenKind::Atom && prefixed.is_none();
                let name = before.get(token.start..token.end).filter(|_| is_name);
                if let Some(list) = lists.last_mut() {
                    list.element(name, start);
                }
                if token.kind == TokenKind::Open {
                    lists.push(List::new(line, column, prefixed.is_some()));
                }
            }
            TokenKind::Dispatch { letter: '(', .. } => {
                if let Some(list) = lists.last_mut() {
                    list.element(None, start);
                }
                let length = token.end - token.start;
                lists.push(List::new(line, column + length - 1, true));
            }
            TokenKind::Quote
            | TokenKind::Backquote
            | TokenKind::Comma
            | TokenKind::CommaAt
            | TokenKind::CommaDot
            | TokenKind::Dispatch { .. } => {
                prefixed = Some(start);
                continue;
            }
        }
        prefixed = None;
    }
    lists.last().map_or(0, List::indentation)
}

/// A list that is still open.
struct List<'a> {
    line: usize,
    /// Column of the parenthesis.
    column: usize,
    is_data: bool,
    elements: usize,
    operator: Option<&'a str>,
    /// Column of the first argument, if it is on the same line as the parenthesis.
    argument_column: Option<usize>,
}

impl<'a> List<'a> {
    fn new(line: usize, column: usize, is_data: bool) -> Self {
        List {
            line,
            column,
            is_data,
            elements: 0,
            operator: None,
            argument_column: None,
        }
    }

    fn element(&mut self, name: Option<&'a str>, (line, column): (usize, usize)) {
        match self.elements {
            0 => self.operator = name,
            1 if line == self.line => self.argument_column = Some(column),
            _ => {}
        }
        self.elements += 1;
    }

    fn indentation(&self) -> usize {
        let data = self.column + 1;
        let body = self.column + 2;
        match self.operator {
            Some(operator) if !self.is_data => match Shape::of(operator) {
                Shape::Body => body,
                Shape::Forms => self.argument_column.unwrap_or(body),
                Shape::Call => self.argument_column.unwrap_or(data),
            },
            _ => data,
        }
    }
}

/// What follows an operator.
enum Shape {
    /// Special arguments, then a body.
    Body,
    /// A body.
    Forms,
    /// Arguments.
    Call,
}

impl Shape {
    fn of(operator: &str) -> Self {
        let operator = operator.rsplit(':').next().unwrap_or(operator);
        let operator = operator.to_ascii_lowercase();
        if operator.starts_with("with-")
            || operator.starts_with("def")
            || BODIES.contains(&operator.as_str())
        {
            Shape::Body
        } else if FORMS.contains(&operator.as_str()) {
            Shape::Forms
        } else {
            Shape::Call
        }
    }
}

const BODIES: [&str; 27] = [
    "block",
    "case",
    "catch",
    "ccase",
    "destructuring-bind",
    "do",
    "do*",
    "dolist",
    "dotimes",
    "ecase",
    "etypecase",
    "eval-when",
    "flet",
    "handle-failure",
    "handler-bind",
    "handler-case",
    "labels",
    "lambda",
    "let",
    "let*",
    "macrolet",
    "multiple-value-bind",
    "prog1",
    "typecase",
    "unless",
    "whenever",
    "when",
];

const FORMS: [&str; 9] = [
    "locally",
    "par",
    "progn",
    "pursue",
    "seq",
    "top-level",
    "try-all",
    "try-in-order",
    "unwind-protect",
];

/// Tracks line and column along a text.
struct Cursor<'a> {
    rest: &'a str,
    at: usize,
    line: usize,
    column: usize,
}

impl<'a> Cursor<'a> {
    fn new(text: &'a str, first_column: usize) -> Self {
        Cursor {
            rest: text,
            at: 0,
            line: 0,
            column: first_column,
        }
    }

    /// Line and column of byte `to`, which must not be before the previous one.
    fn advance(&mut self, to: usize) -> (usize, usize) {
        let (passed, rest) = self
            .rest
            .split_at_checked(to - self.at)
            .unwrap_or((self.rest, ""));
        for c in passed.chars() {
            if c == '\n' {
                self.line += 1;
                self.column = 0;
            } else {
                self.column += 1;
            }
        }
        (self.rest, self.at) = (rest, to);
        (self.line, self.column)
    }
}

#[cfg(test)]
mod tests {
    use crate::prompt::indent::*;

    fn indented(before: &str) -> usize {
        indentation(before, 0)
    }

    #[test]
    fn arguments_stand_below_the_first_one() {
        assert_eq!(indented("(list 1"), 6);
        assert_eq!(indented("(list\n 1"), 1);
        assert_eq!(indented("(perform (an action"), 13);
        assert_eq!(indented("(f (g 1) 'a"), 3);
        assert_eq!(indented("(f 'a"), 3);
    }

    #[test]
    fn bodies_stand_two_blanks_right_of_their_form() {
        assert_eq!(indented("(defun f ()"), 2);
        assert_eq!(indented("(f (let ((a 1))"), 5);
        assert_eq!(indented("(cpl:with-failure-handling"), 2);
        assert_eq!(indented("(progn"), 2);
        assert_eq!(indented("(cpl:par (a)"), 9);
    }

    #[test]
    fn data_stands_below_the_first_element() {
        assert_eq!(indented("(let ((a 1)"), 6);
        assert_eq!(indented("'(when b"), 2);
        assert_eq!(indented("#(1 2"), 2);
        assert_eq!(indented("("), 1);
    }

    #[test]
    fn the_prompt_shifts_the_first_line_only() {
        assert_eq!(indentation("(list 1", 8), 14);
        assert_eq!(indentation("(progn\n  (list 1", 8), 8);
    }

    #[test]
    fn strings_and_closed_forms_are_not_indented() {
        assert_eq!(indented("(f \"a"), 0);
        assert_eq!(indented("(f) ; (g"), 0);
        assert_eq!(indented("(f))"), 0);
    }
}
