//! Finds a name in the text of a form.

use std::ops::Range;

use lisp::reader::{Lexer, TokenKind};

/// The byte range of the first token with that name (ignoring case and package prefix):
/// preferably an element of the form itself, else any token inside it, or else a string. A name with a quote
/// before it is found with that.
pub(super) fn find(form: &str, name: &str) -> Option<Range<usize>> {
    if let Some(name) = name.strip_prefix('\'') {
        let is_quoted =
            |range: &Range<usize>| form.get(..range.start)?.ends_with('\'').then_some(());
        let found = symbols(form, name).find(|(range, _)| is_quoted(range).is_some());
        return found.map(|(range, _)| range.start - 1..range.end);
    }
    let found = symbols(form, name).find(|(_, depth)| *depth == 1);
    let found = found.or_else(|| symbols(form, name).next());
    found.map(|(range, _)| range).or_else(|| string(form, name))
}

/// The symbols with a name, and how deep they stand.
fn symbols<'a>(form: &'a str, name: &'a str) -> impl Iterator<Item = (Range<usize>, usize)> + 'a {
    Tokens::new(form).filter(move |(range, _)| {
        let token = form.get(range.clone()).unwrap_or_default();
        let bare = token.rsplit(':').next().unwrap_or(token);
        bare.to_uppercase() == name
    })
}

/// The first string with a content, in any case.
fn string(form: &str, name: &str) -> Option<Range<usize>> {
    let strings =
        Lexer::new(form).filter(|token| token.kind == TokenKind::String && token.is_closed);
    let mut ranges = strings.map(|token| token.start..token.end);
    ranges.find(|range| {
        let content = form.get(range.start + 1..range.end - 1);
        content.is_some_and(|content| content.to_uppercase() == name)
    })
}

/// The tokens of a text with their nesting depths, without strings and comments.
struct Tokens<'a> {
    text: &'a str,
    at: usize,
    depth: usize,
}

impl<'a> Tokens<'a> {
    fn new(text: &'a str) -> Self {
        Tokens {
            text,
            at: 0,
            depth: 0,
        }
    }

    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// Skips past the first of the ends found at or after `from`, or to the end of the text.
    fn skip_to(&mut self, from: usize, end: &str) {
        let rest = self.rest().get(from..).unwrap_or_default();
        self.at += from + rest.find(end).map_or(rest.len(), |i| i + end.len());
    }

    fn skip_string(&mut self) {
        let mut is_escaped = false;
        let closing = self.rest().char_indices().skip(1).find(|(_, c)| {
            let closes = *c == '"' && !is_escaped;
            is_escaped = *c == '\\' && !is_escaped;
            closes
        });
        self.at = closing.map_or(self.text.len(), |(i, _)| self.at + i + 1);
    }
}

impl Iterator for Tokens<'_> {
    type Item = (Range<usize>, usize);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let rest = self.rest();
            let first = rest.chars().next()?;
            match first {
                '(' => {
                    self.depth += 1;
                    self.at += 1;
                }
                ')' => {
                    self.depth = self.depth.saturating_sub(1);
                    self.at += 1;
                }
                '"' => self.skip_string(),
                ';' => self.skip_to(0, "\n"),
                '#' if rest.starts_with("#|") => self.skip_to(2, "|#"),
                '#' if rest.starts_with("#'") => self.at += 2,
                _ if is_delimiter(first) => self.at += first.len_utf8(),
                _ => {
                    let length = rest.find(is_delimiter).unwrap_or(rest.len());
                    let start = self.at;
                    self.at += length;
                    return Some((start..self.at, self.depth));
                }
            }
        }
    }
}

fn is_delimiter(c: char) -> bool {
    c.is_whitespace() || matches!(c, '(' | ')' | '"' | '\'' | '`' | ',' | ';')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_found_at_the_outermost_level_first() {
        let form = "(f (g ?x) \"?x\" ; ?x\n pkg:?x)";
        let range = find(form, "?X").unwrap();
        assert_eq!(&form[range.clone()], "pkg:?x");
        assert_eq!(range.start, 21);
    }

    #[test]
    fn a_name_further_in_is_found_too() {
        assert_eq!(find("(f (g #'h \"\\\" h\") #|h|#)", "H"), Some(8..9));
        assert_eq!(find("(f (g x))", "H"), None);
        assert_eq!(find("(f \"H\" '(h))", "H"), Some(9..10));
        assert_eq!(find("(f \"x\" \"left_arm\")", "LEFT_ARM"), Some(7..17));
        assert_eq!(find("(f h 'h)", "'H"), Some(5..7));
    }
}
