//! The syntactic context of the cursor.

use super::locals::locals;
use lisp::reader::{Lexer, Token, TokenKind};

/// A list that is open at the cursor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Open<'t> {
    /// Its first element, if that is an atom and the cursor is after it.
    pub operator: Option<&'t str>,
    /// Number of elements before the one at the cursor, including the first.
    pub elements: usize,
    /// The atom just before the one at the cursor.
    pub last: Option<&'t str>,
    /// The first two atoms of each list among its elements.
    pub lists: Vec<(&'t str, Option<&'t str>)>,
    /// The second element, if that is an atom.
    pub second: Option<&'t str>,
    /// Whether it is quoted.
    pub(crate) is_quoted: bool,
}

/// The context of a cursor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Context<'t> {
    /// The open lists, innermost last.
    pub lists: Vec<Open<'t>>,
    /// The part of the atom at the cursor that precedes it.
    pub word: &'t str,
    /// Byte at which it begins.
    pub(crate) word_start: usize,
    /// Whether the cursor is in a string; `word` is then its contents so far.
    pub(crate) in_string: bool,
    /// Whether the cursor is in a comment.
    pub(crate) in_comment: bool,
    /// Whether a `'` or `#'` precedes the word.
    pub(crate) is_quoted: bool,
    /// The variables that are bound there by the text itself.
    pub locals: Vec<&'t str>,
}

impl<'t> Context<'t> {
    /// The context of byte `at`.
    pub(super) fn of(text: &'t str, at: usize) -> Context<'t> {
        let before = text.get(..at).unwrap_or(text);
        let mut context = Context {
            lists: Vec::new(),
            word: "",
            word_start: before.len(),
            in_string: false,
            in_comment: false,
            is_quoted: false,
            locals: locals(before),
        };
        let mut quoted = false;
        for token in Lexer::new(before) {
            let part = before.get(token.start..token.end).unwrap_or("");
            let at_cursor = token.end == before.len();
            match token.kind {
                TokenKind::LineComment | TokenKind::BlockComment => {
                    context.in_comment = at_cursor && !(token.is_closed && part.ends_with("|#"));
                    continue;
                }
                TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => {
                    context.lists.push(Open {
                        is_quoted: quoted,
                        ..Open::default()
                    });
                }
                TokenKind::Close => context.close(),
                TokenKind::String if !token.is_closed => {
                    context.in_string = true;
                    context.word_start = token.start + 1;
                    context.word = before.get(token.start + 1..).unwrap_or("");
                    return context;
                }
                TokenKind::Quote | TokenKind::Dispatch { letter: '\'', .. } => {
                    quoted = true;
                    continue;
                }
                TokenKind::Backquote
                | TokenKind::Comma
                | TokenKind::CommaAt
                | TokenKind::CommaDot
                | TokenKind::Dispatch { .. } => continue,
                TokenKind::Atom | TokenKind::Prefixed { .. } if at_cursor => {
                    context.word = part;
                    context.word_start = token.start;
                    context.is_quoted = quoted;
                    return context;
                }
                TokenKind::Atom
                | TokenKind::Prefixed { .. }
                | TokenKind::String
                | TokenKind::Character => context.element(&token, part),
            }
            quoted = false;
        }
        context.is_quoted = quoted;
        context
    }

    fn element(&mut self, token: &Token, part: &'t str) {
        let Some(list) = self.lists.last_mut() else {
            return;
        };
        let atom = matches!(token.kind, TokenKind::Atom).then_some(part);
        match list.elements {
            0 => list.operator = atom,
            1 => list.second = atom,
            _ => {}
        }
        list.last = atom;
        list.elements += 1;
    }

    fn close(&mut self) {
        let Some(closed) = self.lists.pop() else {
            return;
        };
        if let Some(list) = self.lists.last_mut() {
            if let Some(operator) = closed.operator {
                list.lists.push((operator, closed.second));
            }
            list.last = None;
            list.elements += 1;
        }
    }
}

/// A symbol's name as typed, without its package.
pub(super) fn bare(name: &str) -> &str {
    name.rsplit(':').next().unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_end(text: &str) -> Context<'_> {
        Context::of(text, text.len())
    }

    #[test]
    fn the_word_at_the_cursor_is_no_element_yet() {
        let context = at_end("(f 1 (g x) ab");
        assert_eq!((context.word, context.word_start), ("ab", 11));
        let list = &context.lists[0];
        assert_eq!((list.operator, list.elements), (Some("f"), 3));
        assert_eq!(list.lists, [("g", Some("x"))]);
    }

    #[test]
    fn the_operator_may_be_what_is_typed() {
        let context = at_end("(a (b");
        assert_eq!(context.lists.len(), 2);
        assert_eq!(context.lists[1].operator, None);
        assert_eq!(context.word, "b");
    }

    #[test]
    fn strings_and_comments_are_known() {
        assert!(at_end("(load \"a/b").in_string);
        assert_eq!(at_end("(load \"a/b").word, "a/b");
        assert!(at_end("(f ; (g").in_comment);
        assert!(!at_end("(f #| x |# g").in_comment);
    }

    #[test]
    fn quotes_are_known() {
        assert!(at_end("(f 'bo").is_quoted);
        assert!(!at_end("(f 'bo x").is_quoted);
        assert!(at_end("(f #'").is_quoted);
    }
}
