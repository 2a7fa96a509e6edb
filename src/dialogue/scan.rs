//! Cuts Lisp text into the few kinds of pieces that an editor needs: parentheses,
//! strings, comments and the rest.
//!
//! Linear in the length of the text; never fails: a text that ends within a piece gives
//! a piece that is not [`closed`](Piece::closed). What the pieces mean is the reader's
//! business.

/// What a piece of text is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// `(`
    Open,
    /// `)`
    Close,
    /// `"…"`
    String,
    /// `; …` up to the end of the line, or `#| … |#`
    Comment,
    /// `#\a`
    Character,
    /// `'`, `` ` ``, `,`, `,@`, `#'`: something has to follow.
    Prefix,
    /// A symbol, a number, or what else stands between the other pieces.
    Atom,
}

/// A piece of a text; blanks lie between the pieces.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Piece {
    /// What it is.
    pub kind: Kind,
    /// First byte.
    pub start: usize,
    /// Byte after the last one.
    pub end: usize,
    /// The text did not end within it.
    pub closed: bool,
}

/// Is the text a whole input: parentheses balance, and no string, symbol or comment is
/// still open? An input with too many closing parentheses is whole (and wrong).
pub fn is_complete(text: &str) -> bool {
    let mut depth = 0_usize;
    let mut expects_form = false;
    for piece in pieces(text) {
        if !piece.closed {
            return false;
        }
        match piece.kind {
            Kind::Open => depth += 1,
            Kind::Close if depth == 0 => return true,
            Kind::Close => depth -= 1,
            _ => {}
        }
        if piece.kind != Kind::Comment {
            expects_form = piece.kind == Kind::Prefix;
        }
    }
    depth == 0 && !expects_form
}

/// The pieces of a text, in order.
pub fn pieces(text: &str) -> Pieces<'_> {
    Pieces { text, at: 0 }
}

/// Iterator over the pieces of a text.
pub struct Pieces<'a> {
    text: &'a str,
    at: usize,
}

impl Iterator for Pieces<'_> {
    type Item = Piece;

    fn next(&mut self) -> Option<Piece> {
        let rest = self.rest();
        self.at += rest.len() - rest.trim_start().len();
        let start = self.at;
        let first = self.take()?;
        let (kind, closed) = match first {
            '(' => (Kind::Open, true),
            ')' => (Kind::Close, true),
            '"' => (Kind::String, self.delimited('"')),
            ';' => {
                self.line();
                (Kind::Comment, true)
            }
            '\'' | '`' => (Kind::Prefix, true),
            ',' => {
                self.take_if('@');
                (Kind::Prefix, true)
            }
            '#' if self.take_if('|') => (Kind::Comment, self.block_comment()),
            '#' if self.take_if('\\') => (Kind::Character, self.character()),
            '#' if self.take_if('\'') => (Kind::Prefix, true),
            // `#(` and the like: a parenthesis follows at once.
            '#' if self.rest().starts_with('(') => {
                self.take();
                (Kind::Open, true)
            }
            first => (Kind::Atom, self.atom(first)),
        };
        Some(Piece {
            kind,
            start,
            end: self.at,
            closed,
        })
    }
}

impl<'a> Pieces<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or("")
    }

    fn take(&mut self) -> Option<char> {
        let c = self.rest().chars().next()?;
        self.at += c.len_utf8();
        Some(c)
    }

    fn take_if(&mut self, wanted: char) -> bool {
        let found = self.rest().starts_with(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    fn line(&mut self) {
        let rest = self.rest();
        self.at += rest.find('\n').unwrap_or(rest.len());
    }

    /// After the opening delimiter; tells whether the closing one was found.
    fn delimited(&mut self, delimiter: char) -> bool {
        while let Some(c) = self.take() {
            if c == delimiter {
                return true;
            }
            if c == '\\' {
                self.take();
            }
        }
        false
    }

    /// After `#|`; such comments nest.
    fn block_comment(&mut self) -> bool {
        let mut depth = 1_usize;
        while let Some(c) = self.take() {
            if c == '|' && self.take_if('#') {
                depth -= 1;
                if depth == 0 {
                    return true;
                }
            } else if c == '#' && self.take_if('|') {
                depth += 1;
            }
        }
        false
    }

    /// After `#\`: one character of any kind, then the rest of a name.
    fn character(&mut self) -> bool {
        let found = self.take().is_some();
        while self.rest().starts_with(is_constituent) {
            self.take();
        }
        found
    }

    fn atom(&mut self, first: char) -> bool {
        let mut next = Some(first);
        while let Some(c) = next {
            let whole = match c {
                '|' => self.delimited('|'),
                '\\' => self.take().is_some(),
                _ => true,
            };
            if !whole {
                return false;
            }
            let goes_on = self
                .rest()
                .starts_with(|c| is_constituent(c) || c == '|' || c == '\\' || c == '#');
            next = if goes_on { self.take() } else { None };
        }
        true
    }
}

fn is_constituent(c: char) -> bool {
    !c.is_whitespace() && !"()\"';`,|\\#".contains(c)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(text: &str) -> Vec<(Kind, &str)> {
        pieces(text)
            .map(|piece| (piece.kind, &text[piece.start..piece.end]))
            .collect()
    }

    #[test]
    fn a_form_is_cut_into_pieces() {
        assert_eq!(
            cut("(f 'a \"b)\" #\\) ; c)\n#|(|# |(|)"),
            [
                (Kind::Open, "("),
                (Kind::Atom, "f"),
                (Kind::Prefix, "'"),
                (Kind::Atom, "a"),
                (Kind::String, "\"b)\""),
                (Kind::Character, "#\\)"),
                (Kind::Comment, "; c)"),
                (Kind::Comment, "#|(|#"),
                (Kind::Atom, "|(|"),
                (Kind::Close, ")"),
            ]
        );
    }

    #[test]
    fn balanced_texts_are_complete() {
        for text in [
            "",
            "a",
            "1 2",
            "(a)",
            "(a) (b)",
            "\"(\"",
            "#\\(",
            "#\\\"",
            "; (",
            "#| ( |# a",
            "|(|",
            "a\\(",
            "(a ; )\n)",
            ")",
            "(a))",
            "#(1 2)",
            "#c(1 2)",
            "'(a)",
            "`(a ,@b)",
            "#\\Space",
            "#| #| ( |# ( |# a",
            "\"\\\"(\"",
            "#'car",
            "#+sbcl 1",
            "äöü",
        ] {
            assert!(is_complete(text), "{text}");
        }
    }

    #[test]
    fn unbalanced_texts_are_incomplete() {
        for text in [
            "(",
            "(a",
            "(a (b)",
            "\"",
            "\"a\\\"",
            "#|",
            "#| |",
            "|a",
            "#\\",
            "'",
            "#'",
            ",@",
            "a\\",
            "(a ; )",
            "#(",
            "' ; quoted\n",
        ] {
            assert!(!is_complete(text), "{text}");
        }
    }
}
