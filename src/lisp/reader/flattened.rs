//! Text that has lost its line breaks, as web pages and chats give it: a comment then goes on to
//! the end of the text and swallows the code that stood on the lines below it.
//!
//! Where line breaks were can only be guessed: a comment of a line of its own is words, and code
//! begins with a parenthesis. So a comment ends before the first parenthesis or the next comment
//! after its words. That is a guess worth making only if the text makes no sense as it is and does
//! with it: it is unbalanced and becomes balanced, or a comment holds another comment and then whole
//! forms.

use std::ops::Range;

use super::completeness::{Completeness, is_complete};
use super::lexer::{Lexer, TokenKind, is_blank};

/// A comment that has swallowed code.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Swallowed {
    /// Bytes of the comment's own words, with its semicolons.
    pub comment: Range<usize>,
    /// Bytes of what it has swallowed, up to the end of the line.
    pub code: Range<usize>,
    /// The blank characters that stand where line breaks were.
    breaks: Vec<usize>,
}

/// A text whose comments end again where they did.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Unflattened {
    /// The text with its line breaks.
    pub text: String,
    /// The comments that had swallowed code.
    pub comments: Vec<Swallowed>,
}

/// How many characters of a comment or a form are shown.
const SHOWN: usize = 30;

/// The beginning of a text, if it is long.
fn beginning(text: &str) -> String {
    match text.char_indices().nth(SHOWN) {
        Some((end, _)) => {
            let cut = text.get(..end).unwrap_or(text);
            let cut = cut.rsplit_once(is_blank).map_or(cut, |(words, _)| words);
            format!("{cut} …")
        }
        None => text.to_owned(),
    }
}

impl Swallowed {
    /// What the comment has swallowed, cut if it is long.
    pub fn code_in(&self, text: &str) -> String {
        let code = text.get(self.code.clone()).unwrap_or_default();
        match code.split_once(" ;") {
            Some((before, _)) if before.chars().count() <= SHOWN => format!("{before} …"),
            _ => beginning(code),
        }
    }

    /// In words: where the comment is, what it has swallowed, and what to do.
    pub fn described(&self, text: &str) -> String {
        let before = text.get(..self.comment.start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default();
        let column = column.chars().count() + 1;
        let comment = beginning(text.get(self.comment.clone()).unwrap_or_default());
        format!(
            "The comment \"{comment}\" at line {line}, column {column} has swallowed \"{}\"; \
             break the line before that if it is no comment",
            self.code_in(text)
        )
    }
}

/// What a comment holds besides words.
struct Held {
    swallowed: Swallowed,
    /// Whether parentheses are closed in it that are opened before it, or the reverse.
    is_unbalanced: bool,
    /// How many more parentheses it opens than it closes.
    depth: i64,
    /// Whether it is one of two semicolons, and another one begins in it.
    has_comment: bool,
    /// Whether there is nothing but whole lists between its comments.
    has_only_lists: bool,
    /// Whether there is code before it on the line.
    follows_code: bool,
}

/// The text with the line breaks that it must have had, if its comments have swallowed code.
pub fn unflattened(text: &str) -> Option<Unflattened> {
    let held = held_in(text);
    let is_balanced = is_complete(text) == Completeness::Complete;
    let comments: Vec<Swallowed> = held
        .into_iter()
        .filter(|held| {
            if is_balanced {
                held.is_evident()
            } else {
                held.is_unbalanced
            }
        })
        .map(|held| held.swallowed)
        .collect();
    if comments.is_empty() {
        return None;
    }
    let breaks: Vec<usize> = comments.iter().flat_map(|c| c.breaks.clone()).collect();
    let broken = broken_at(text, &breaks);
    let is_mended = is_complete(&broken) == Completeness::Complete
        && comments
            .iter()
            .all(|c| !has_words_outside(&broken, &c.code));
    is_mended.then_some(Unflattened {
        text: broken,
        comments,
    })
}

/// The first comment at or after a byte whose words are followed by parentheses that do not
/// balance: what a text that is unbalanced may lack.
pub fn swallowing_comment(text: &str, from: usize) -> Option<Swallowed> {
    held_in(text)
        .into_iter()
        .find(|held| held.is_unbalanced && held.swallowed.code.end > from)
        .map(|held| held.swallowed)
}

/// The last such comment of a text.
pub fn last_swallowing_comment(text: &str) -> Option<Swallowed> {
    held_in(text)
        .into_iter()
        .rfind(|held| held.is_unbalanced)
        .map(|held| held.swallowed)
}

/// How many more parentheses a comment opens after its words than it closes, if they do not balance.
pub(super) fn unbalanced_depth(comment: &str) -> Option<i64> {
    let held = Held::of(comment, 0).filter(|held| held.is_unbalanced)?;
    Some(held.depth)
}

/// The comments of a balanced text that hold whole forms and in all likelihood are not meant to.
pub fn hidden_forms(text: &str) -> Vec<Swallowed> {
    let held = held_in(text).into_iter();
    held.filter(Held::is_evident)
        .map(|held| held.swallowed)
        .collect()
}

/// A comment of several words after code, with nothing but whole lists behind them: perhaps they
/// are meant to be evaluated, perhaps not.
pub fn forms_in_comment(text: &str) -> Option<Swallowed> {
    let mut held = held_in(text).into_iter();
    held.find(|held| {
        let words = text.get(held.swallowed.comment.clone()).unwrap_or_default();
        held.is_list_after_words(words)
    })
    .map(|held| held.swallowed)
}

impl Held {
    /// Whether the comment has lost its end though all parentheses balance: it has swallowed
    /// another comment.
    fn is_evident(&self) -> bool {
        self.has_comment && self.has_only_lists && self.follows_code
    }

    fn is_list_after_words(&self, words: &str) -> bool {
        let is_sentence = words.starts_with(";;") && words.trim_end().ends_with(['.', ':', '!']);
        self.has_only_lists && self.follows_code && is_sentence
    }
}

/// The comments of a text that hold parentheses or comments after their words.
fn held_in(text: &str) -> Vec<Held> {
    let mut found = Vec::new();
    let mut code_ends = None;
    for token in Lexer::new(text) {
        if token.kind != TokenKind::LineComment {
            code_ends = Some(token.end);
            continue;
        }
        let comment = text.get(token.start..token.end).unwrap_or_default();
        let between = code_ends.and_then(|end| text.get(end..token.start));
        if let Some(mut held) = Held::of(comment, token.start) {
            held.follows_code = between.is_some_and(|between| !between.contains('\n'));
            found.push(held);
        }
    }
    found
}

impl Held {
    /// What a comment that begins at a byte of its text holds besides words.
    fn of(comment: &str, start: usize) -> Option<Held> {
        let is_double = comment.starts_with(";;");
        let mut breaks = Vec::new();
        let mut at = end_of_words(comment, 0)?;
        let words = at;
        let first_code = loop {
            breaks.push(at);
            let rest = comment.get(at..)?.trim_start_matches(is_blank);
            let next = comment.len() - rest.len();
            if !rest.starts_with(';') {
                break next;
            }
            at = end_of_words(comment, next)?;
        };
        let mut held = Held {
            swallowed: Swallowed {
                comment: start..start + words,
                code: start + first_code..start + comment.trim_end().len(),
                breaks: Vec::new(),
            },
            is_unbalanced: false,
            depth: 0,
            has_comment: is_double && breaks.len() > 1,
            has_only_lists: true,
            follows_code: false,
        };
        held.look_at_code(comment, first_code, &mut breaks);
        held.swallowed.breaks = breaks.into_iter().map(|at| start + at).collect();
        Some(held)
    }

    /// Looks at what stands behind the words of a comment; notes where further comments in it end.
    fn look_at_code(&mut self, comment: &str, from: usize, breaks: &mut Vec<usize>) {
        let mut depth = 0_i64;
        let mut position = from;
        'lines: loop {
            for token in Lexer::at(comment, position) {
                match token.kind {
                    TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => depth += 1,
                    TokenKind::Close => {
                        depth -= 1;
                        self.is_unbalanced |= depth < 0;
                    }
                    TokenKind::LineComment => {
                        self.has_comment |= comment.starts_with(";;");
                        let Some(end) = end_of_words(comment, token.start) else {
                            break 'lines;
                        };
                        breaks.push(end);
                        position = end;
                        continue 'lines;
                    }
                    TokenKind::BlockComment | TokenKind::Quote | TokenKind::Backquote => {}
                    _ => self.has_only_lists &= depth > 0,
                }
            }
            break;
        }
        self.depth = depth;
        self.is_unbalanced |= depth != 0;
        self.has_only_lists &= !self.is_unbalanced;
    }
}

/// Where the words of the comment that begins at a byte end: at the blank before the first
/// parenthesis or the next comment. `None` if there are no words, or nothing but words.
fn end_of_words(comment: &str, start: usize) -> Option<usize> {
    let body = comment.get(start..)?;
    let words = body.trim_start_matches(';');
    let is_double = body.len() - words.len() > 1;
    let offset = comment.len() - words.len();
    let mut blank = Some(0);
    let mut has_words = false;
    for (at, c) in words.char_indices() {
        if is_blank(c) {
            blank = blank.or(Some(at));
            continue;
        }
        let rest = words.get(at..).unwrap_or_default();
        if let Some(blank) = blank
            && ends_words(rest, is_double)
        {
            // Code that somebody has commented out is no comment of words.
            return has_words.then_some(offset + blank);
        }
        has_words |= c.is_alphanumeric();
        blank = None;
    }
    None
}

/// Whether the rest of a comment is code or another comment.
fn ends_words(rest: &str, is_double: bool) -> bool {
    const CODE: [&str; 7] = ["(", "'(", "`(", "#(", "#'(", "`'(", "'#("];
    let comment = if is_double { ";;" } else { ";" };
    let closes = || {
        let closing = rest.trim_end();
        is_double && !closing.is_empty() && closing.chars().all(|c| c == ')')
    };
    CODE.iter().any(|code| rest.starts_with(code)) || rest.starts_with(comment) || closes()
}

/// The text with line breaks in place of the blanks at some bytes.
fn broken_at(text: &str, breaks: &[usize]) -> String {
    text.char_indices()
        .map(|(at, c)| if breaks.contains(&at) { '\n' } else { c })
        .collect()
}

/// Whether anything but lists stands outside all lists in a range of a text.
fn has_words_outside(text: &str, range: &Range<usize>) -> bool {
    let mut depth = 0_i64;
    Lexer::new(text).any(|token| {
        match token.kind {
            TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => depth += 1,
            TokenKind::Close => depth -= 1,
            TokenKind::Atom | TokenKind::String | TokenKind::Character => {
                return depth == 0 && range.contains(&token.start);
            }
            _ => {}
        }
        false
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mended(text: &str) -> Option<String> {
        unflattened(text).map(|found| found.text)
    }

    #[test]
    fn a_comment_ends_before_the_first_list_or_comment() {
        assert_eq!(
            mended("(par ;; Go there. (go 1) ;; Up (see below) (up)) ").as_deref(),
            Some("(par ;; Go there.\n(go 1) ;; Up\n(see below) (up)) ")
        );
        assert_eq!(
            mended("(f ; one 'a ; two '(b))").as_deref(),
            Some("(f ; one 'a\n; two\n'(b))")
        );
        assert_eq!(
            mended("(f ;; one ;; two\n  ;; three (g ;; four `(h)))").as_deref(),
            Some("(f ;; one ;; two\n  ;; three\n(g ;; four\n`(h)))")
        );
        assert_eq!(
            mended("(f (g) ;; done )").as_deref(),
            Some("(f (g) ;; done\n)")
        );
    }

    #[test]
    fn exotic_blanks_are_blanks() {
        let text = "(f ;; one\u{a0}(g))";
        assert_eq!(mended(text).as_deref(), Some("(f ;; one\n(g))"));
    }

    #[test]
    fn a_form_after_comments_is_found_in_a_text_that_balances() {
        assert_eq!(
            mended("(a) ;; This is ;; for that. (b \"x ;; y (\")").as_deref(),
            Some("(a) ;; This is\n;; for that.\n(b \"x ;; y (\")")
        );
    }

    #[test]
    fn what_makes_sense_is_left_as_it_is() {
        for text in [
            "(a) ;; like (b)",
            "(a) ; like (b) ; or (c)",
            "(a) ;; (b) ;; (c)",
            ";; a ;; comment (b)",
            "(a ; )\n)",
            "(a ; )",
            "(a) ;; see ;; (b) there",
            "(a \";; x (b\" c)",
            "(a #\\; (b))",
            "",
        ] {
            assert_eq!(mended(text), None, "{text}");
        }
    }

    #[test]
    fn what_does_not_balance_even_then_is_left_as_it_is() {
        for text in [
            "(a ;; x (b)",
            "(a (b ;; x (c))",
            "(a ;; x (b)))",
            "(a) ;; x (b)) (c)",
        ] {
            assert_eq!(mended(text), None, "{text}");
        }
        assert!(swallowing_comment("(a (b ;; x (c))", 0).is_some());
        assert!(swallowing_comment("(a ;; x (b)\n c", 0).is_none());
    }

    #[test]
    fn only_comments_that_have_swallowed_something_are_broken() {
        assert_eq!(
            mended("(f ; like (g)\n ;; one (h))").as_deref(),
            Some("(f ; like (g)\n ;; one\n(h))")
        );
    }

    #[test]
    fn a_parenthesis_that_a_comment_has_opened_counts() {
        assert_eq!(
            mended("(a ;; x (b\n c))").as_deref(),
            Some("(a ;; x\n(b\n c))")
        );
    }
}
