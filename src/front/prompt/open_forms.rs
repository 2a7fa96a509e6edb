//! What is still open at the end of an input that is being typed.

use lisp::reader::{Lexer, TokenKind};

/// How many of the open forms are named, the innermost last.
const NAMED: usize = 4;

/// What is open at the end of a text, in words; `None` if nothing is.
pub(super) fn still_open(text: &str) -> Option<String> {
    let mut lists: Vec<Option<&str>> = Vec::new();
    for token in Lexer::new(text) {
        let part = text.get(token.start..token.end).unwrap_or_default();
        if !token.is_closed {
            let what = match part.chars().next() {
                Some('"') => "a string",
                Some('#') => "a comment",
                _ => "a symbol in bars",
            };
            return Some(format!("open: {what}"));
        }
        match token.kind {
            TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => lists.push(None),
            TokenKind::Close => {
                lists.pop();
            }
            TokenKind::Atom => {
                if let Some(operator @ None) = lists.last_mut() {
                    *operator = Some(part);
                }
            }
            _ => {}
        }
    }
    let names: Vec<String> = lists
        .iter()
        .map(|operator| format!("({}", operator.unwrap_or_default()))
        .collect();
    let left_out = names.len().saturating_sub(NAMED);
    let shown = names.get(left_out..).unwrap_or_default().join(" ");
    match (names.len(), left_out) {
        (0, _) => None,
        (_, 0) => Some(format!("open: {shown}")),
        _ => Some(format!("open: … {shown}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn open_lists_are_named_by_their_operators() {
        let open = |text| still_open(text).unwrap_or_default();
        assert_eq!(open("(defun f ()\n"), "open: (defun");
        assert_eq!(open("(a (b) (let ((x 1)\n"), "open: (a (let (");
        assert_eq!(open("(a (b (c (d (e\n"), "open: … (b (c (d (e");
        assert_eq!(open("(f \"abc\n"), "open: a string");
        assert_eq!(open("(f #| c\n"), "open: a comment");
        assert_eq!(open("(f |c\n"), "open: a symbol in bars");
        assert_eq!(open("(f)\n"), "");
    }
}
