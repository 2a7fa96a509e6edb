//! Where a text defines something.

use crate::dialogue::Definition;
use lisp::reader::{Lexer, Token, TokenKind};
use lisp::source::Location;

/// The definitions at top level of a text, with the names that they define in upper case.
///
/// A form is one if its operator begins with `def` and is followed by a name, by a list that
/// begins with one, as in `(defstruct (name …) …)`, or by `(setf name)`.
pub(super) fn find(source: &str, text: &str) -> Vec<(String, Definition)> {
    let mut found = Vec::new();
    let mut depth = 0_usize;
    // The form at top level: where it begins, and its first atoms.
    let mut start = 0;
    let mut atoms: Vec<&str> = Vec::new();
    let mut lines = Lines::of(text);
    for token in Lexer::new(text) {
        match token.kind {
            TokenKind::LineComment | TokenKind::BlockComment => continue,
            TokenKind::Open => {
                if depth == 0 {
                    start = token.start;
                    atoms.clear();
                }
                depth += 1;
            }
            TokenKind::Dispatch { letter: '(', .. } => depth += 1,
            TokenKind::Close => {
                depth = depth.saturating_sub(1);
                if depth > 0 {
                    continue;
                }
                if let Some((name, label)) = defined(&atoms) {
                    let (line, column) = lines.at(start);
                    let form = text.get(start..token.end).unwrap_or_default();
                    let definition = Definition {
                        label,
                        source: source.to_owned(),
                        line,
                        column,
                        text: form.to_owned(),
                    };
                    found.push((name, definition));
                }
                atoms.clear();
            }
            TokenKind::Atom if depth > 0 && atoms.len() < 3 => {
                atoms.extend(text.get(token.start..token.end));
            }
            _ => {}
        }
    }
    found
}

/// The name that a form with these first atoms defines, in upper case, and what is shown for it.
fn defined(atoms: &[&str]) -> Option<(String, String)> {
    let operator = bare(atoms.first()?);
    if !operator.starts_with("DEF") || operator == "DEFAULT" {
        return None;
    }
    let mut name = bare(atoms.get(1)?);
    let mut label = format!("({operator} {name})");
    if name == "SETF" {
        name = bare(atoms.get(2)?);
        label = format!("({operator} (SETF {name}))");
    }
    Some((name, label))
}

/// The places in a definition of the lists that begin with these names, in upper case.
pub(super) fn occurrences(definition: &Definition, beginning: &[&str]) -> Vec<Location> {
    let text = definition.text.as_str();
    let tokens: Vec<_> = Lexer::new(text).collect();
    let mut lines = Lines::of(text);
    let begins = |after: &[Token]| {
        let mut names = after.iter();
        beginning.iter().all(|wanted| {
            let name = names.find(|token| {
                !matches!(token.kind, TokenKind::LineComment | TokenKind::BlockComment)
            });
            name.is_some_and(|token| {
                let name = text.get(token.start..token.end).unwrap_or_default();
                token.kind == TokenKind::Atom && bare(name) == *wanted
            })
        })
    };
    let lists = tokens.iter().enumerate().filter(|(at, token)| {
        token.kind == TokenKind::Open && begins(tokens.get(at + 1..).unwrap_or_default())
    });
    let places = lists.map(|(_, token)| {
        let (line, column) = lines.at(token.start);
        let is_first = line == 1;
        Location {
            name: definition.source.as_str().into(),
            line: definition.line + line - 1,
            column: if is_first {
                definition.column + column - 1
            } else {
                column
            },
            line_text: text.lines().nth(line - 1).unwrap_or_default().to_owned(),
            width: 1,
        }
    });
    places.collect()
}

/// A name without its package, in upper case.
fn bare(name: &str) -> String {
    let name = name.trim_start_matches("#:").rsplit(':').next();
    name.unwrap_or_default().to_uppercase()
}

/// Lines and columns of ascending offsets.
struct Lines<'t> {
    text: &'t str,
    line: usize,
    line_start: usize,
    read: usize,
}

impl<'t> Lines<'t> {
    fn of(text: &'t str) -> Lines<'t> {
        Lines {
            text,
            line: 1,
            line_start: 0,
            read: 0,
        }
    }

    /// Line and column of a byte, both from one.
    fn at(&mut self, byte: usize) -> (usize, usize) {
        let passed = self.text.get(self.read..byte).unwrap_or_default();
        for (at, _) in passed.match_indices('\n') {
            self.line += 1;
            self.line_start = self.read + at + 1;
        }
        self.read = byte;
        let before = self.text.get(self.line_start..byte).unwrap_or_default();
        (self.line, before.chars().count() + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_are_found_with_their_places() {
        let text = "(in-package :x)\n; (defun no ())\n (defun f (x) (defvar inner))\n\
                    (cpl:def-cram-function pp::g ())\n(defstruct (h (:type list)) a)\n\
                    (defun (setf k) (v) v)\n(list 'defun 'a)\n\"(defun z ())\"";
        let found: Vec<(String, String, usize, usize)> = find("t", text)
            .into_iter()
            .map(|(name, d)| (name, d.label, d.line, d.column))
            .collect();
        let expected = [
            ("F", "(DEFUN F)", 3, 2),
            ("G", "(DEF-CRAM-FUNCTION G)", 4, 1),
            ("H", "(DEFSTRUCT H)", 5, 1),
            ("K", "(DEFUN (SETF K))", 6, 1),
        ];
        let expected = expected
            .map(|(name, label, line, column)| (name.to_owned(), label.to_owned(), line, column));
        assert_eq!(found, expected);
    }
}
