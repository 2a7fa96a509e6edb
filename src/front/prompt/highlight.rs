//! Colours an input while it is typed.

use lisp::reader::{Lexer, Token, TokenKind};

const STRING: &str = "\x1b[32m";
const COMMENT: &str = "\x1b[2m";
const KEYWORD: &str = "\x1b[36m";
const VARIABLE: &str = "\x1b[35m";
const TYPE: &str = "\x1b[1;33m";
const MATCHING: &str = "\x1b[1;34m";
const UNMATCHED: &str = "\x1b[31m";
const RESET: &str = "\x1b[0m";

/// The text with escape sequences; the parentheses at the cursor are highlighted.
///
/// `is_type` knows the names of types of designators, which are coloured after `(type`.
pub(crate) fn highlighted(
    text: &str,
    cursor: Option<usize>,
    is_type: impl Fn(&str) -> bool,
) -> String {
    let tokens: Vec<Token> = Lexer::new(text).collect();
    let parentheses = Parentheses::of(&tokens, cursor);
    let mut colored = String::with_capacity(text.len() * 2);
    let mut at = 0;
    let mut before = "";
    for token in &tokens {
        colored.push_str(text.get(at..token.start).unwrap_or(""));
        let part = text.get(token.start..token.end).unwrap_or("");
        match parentheses
            .color(token)
            .or_else(|| type_color(before, part, &is_type))
            .or_else(|| color(token.kind, part))
        {
            Some(color) => {
                colored.push_str(color);
                colored.push_str(part);
                colored.push_str(RESET);
            }
            None => colored.push_str(part),
        }
        at = token.end;
        before = part;
    }
    colored.push_str(text.get(at..).unwrap_or(""));
    colored
}

/// The colour of a name after `type`.
fn type_color(before: &str, text: &str, is_type: impl Fn(&str) -> bool) -> Option<&'static str> {
    let is_key = before.trim_start_matches(':').eq_ignore_ascii_case("type");
    (is_key && is_type(text.trim_start_matches(':'))).then_some(TYPE)
}

fn color(kind: TokenKind, text: &str) -> Option<&'static str> {
    match kind {
        TokenKind::String | TokenKind::Character => Some(STRING),
        TokenKind::LineComment | TokenKind::BlockComment => Some(COMMENT),
        TokenKind::Atom if text.starts_with(':') => Some(KEYWORD),
        TokenKind::Atom if text.starts_with('?') => Some(VARIABLE),
        _ => None,
    }
}

/// The highlighted parentheses, by the byte offset at which they end.
struct Parentheses {
    at_cursor: Option<(usize, usize)>,
    unmatched: Vec<usize>,
}

impl Parentheses {
    /// Those at the cursor are the pair that has a parenthesis under the cursor or just before
    /// it.
    fn of(tokens: &[Token], cursor: Option<usize>) -> Self {
        let mut open: Vec<usize> = Vec::new();
        let mut found = Parentheses {
            at_cursor: None,
            unmatched: Vec::new(),
        };
        for token in tokens {
            match token.kind {
                TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => open.push(token.end),
                TokenKind::Close => match open.pop() {
                    Some(start) => {
                        let on = |end: usize| cursor.is_some_and(|cursor| end == cursor + 1);
                        if on(start) || on(token.end) || Some(token.end) == cursor {
                            // A pair just before the cursor is found first; one under the
                            // cursor is found later and takes precedence.
                            found.at_cursor = Some((start, token.end));
                        }
                    }
                    None => found.unmatched.push(token.end),
                },
                _ => {}
            }
        }
        found
    }

    fn color(&self, token: &Token) -> Option<&'static str> {
        if self.unmatched.binary_search(&token.end).is_ok() {
            return Some(UNMATCHED);
        }
        let (open, close) = self.at_cursor?;
        (token.end == open || token.end == close).then_some(MATCHING)
    }
}

#[cfg(test)]
mod tests {
    use crate::prompt::highlight::*;

    /// The text with colours shown as letters in braces.
    fn shown(text: &str, cursor: usize) -> String {
        let mut shown = highlighted(text, Some(cursor), |name| name == "going");
        for (code, name) in [
            (STRING, "{s}"),
            (COMMENT, "{c}"),
            (KEYWORD, "{k}"),
            (VARIABLE, "{v}"),
            (TYPE, "{t}"),
            (MATCHING, "{m}"),
            (UNMATCHED, "{u}"),
            (RESET, "{}"),
        ] {
            shown = shown.replace(code, name);
        }
        shown
    }

    #[test]
    fn pieces_have_their_colours() {
        assert_eq!(
            shown("(f :a ?b \"c\" d) ; e", 99),
            "(f {k}:a{} {v}?b{} {s}\"c\"{} d) {c}; e{}"
        );
    }

    #[test]
    fn types_of_designators_stand_out_where_they_are_types() {
        assert_eq!(
            shown("(type going) (going) (type x)", 99),
            "(type {t}going{}) (going) (type x)"
        );
    }

    #[test]
    fn the_pair_at_the_cursor_stands_out() {
        assert_eq!(shown("(a (b))", 0), "{m}({}a (b){m}){}");
        assert_eq!(shown("(a (b))", 6), "{m}({}a (b){m}){}");
        assert_eq!(shown("(a (b)", 6), "(a {m}({}b{m}){}");
        assert_eq!(shown("(\")\")", 5), "{m}({}{s}\")\"{}{m}){}");
    }

    #[test]
    fn without_a_cursor_no_pair_stands_out() {
        assert_eq!(highlighted("(a)", None, |_| false), "(a)");
    }

    #[test]
    fn a_parenthesis_that_closes_nothing_is_marked() {
        assert_eq!(shown("(a))", 1), "(a){u}){}");
    }
}
