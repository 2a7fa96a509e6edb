//! Does a text consist of whole forms? The prompt asks this to know whether to read on.

use super::lexer::{Lexer, TokenKind};

/// How far a text goes towards whole forms.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Completeness {
    /// Every form is closed (there may be none).
    Complete,
    /// More text is needed.
    Incomplete {
        /// Byte where the innermost unfinished list, string, comment or quote begins.
        opened_at: usize,
        /// How many lists are open.
        depth: usize,
    },
    /// A `)` closes nothing.
    Unmatched {
        /// Byte of that parenthesis.
        at: usize,
    },
}

/// What is not finished yet.
enum Open {
    List {
        at: usize,
    },
    /// A quote or dispatch macro that waits for this many data.
    Prefix {
        at: usize,
        missing: u8,
    },
}

/// Tells whether a text consists of whole forms.
pub fn is_complete(text: &str) -> Completeness {
    let mut open: Vec<Open> = Vec::new();
    for token in Lexer::new(text) {
        if !token.is_closed {
            return incomplete(&open, token.start);
        }
        let at = token.start;
        match token.kind {
            TokenKind::LineComment | TokenKind::BlockComment => {}
            TokenKind::Open => open.push(Open::List { at }),
            TokenKind::Dispatch { letter: '(', .. } => open.push(Open::List { at }),
            TokenKind::Close => {
                // A quote right before the parenthesis is an error, which the parser reports.
                while matches!(open.last(), Some(Open::Prefix { .. })) {
                    open.pop();
                }
                if open.pop().is_none() {
                    return Completeness::Unmatched { at };
                }
                finish_datum(&mut open);
            }
            TokenKind::Quote
            | TokenKind::Backquote
            | TokenKind::Comma
            | TokenKind::CommaAt
            | TokenKind::CommaDot => open.push(Open::Prefix { at, missing: 1 }),
            TokenKind::Dispatch { letter, .. } => {
                let missing = if matches!(letter, '+' | '-') { 2 } else { 1 };
                open.push(Open::Prefix { at, missing });
            }
            TokenKind::String
            | TokenKind::Character
            | TokenKind::Atom
            | TokenKind::Prefixed { .. } => finish_datum(&mut open),
        }
    }
    match open.last() {
        None => Completeness::Complete,
        Some(Open::List { at } | Open::Prefix { at, .. }) => incomplete(&open, *at),
    }
}

fn finish_datum(open: &mut Vec<Open>) {
    while let Some(Open::Prefix { missing, .. }) = open.last_mut() {
        *missing -= 1;
        if *missing > 0 {
            return;
        }
        open.pop();
    }
}

fn incomplete(open: &[Open], opened_at: usize) -> Completeness {
    Completeness::Incomplete {
        opened_at,
        depth: open
            .iter()
            .filter(|o| matches!(o, Open::List { .. }))
            .count(),
    }
}

#[cfg(test)]
mod tests {
    use crate::reader::completeness::*;

    #[test]
    fn whole_forms_are_complete() {
        for text in [
            "", "  ; x", "a", "(a (b))", "#\\(", "\"(\"", "'a", "#+x y", "#'f 1",
        ] {
            assert_eq!(is_complete(text), Completeness::Complete, "{text}");
        }
    }

    #[test]
    fn the_innermost_opening_is_told() {
        assert_eq!(
            is_complete("(a (b"),
            Completeness::Incomplete {
                opened_at: 3,
                depth: 2
            }
        );
        assert_eq!(
            is_complete("(a \"b"),
            Completeness::Incomplete {
                opened_at: 3,
                depth: 1
            }
        );
        assert_eq!(
            is_complete("'"),
            Completeness::Incomplete {
                opened_at: 0,
                depth: 0
            }
        );
        assert_eq!(is_complete("a) b"), Completeness::Unmatched { at: 1 });
    }
}
