//! Common Lisp tokens with their byte spans.
//!
//! The one place that knows where a token begins and ends: the parser, the highlighter
//! and the test for complete input all use it. Every text can be lexed to its end.

/// What a token is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum TokenKind {
    /// `; …` up to the end of the line.
    LineComment,
    /// `#| … |#`, nested.
    BlockComment,
    /// `(`
    Open,
    /// `)`
    Close,
    /// `'`
    Quote,
    /// `` ` ``
    Backquote,
    /// `,`
    Comma,
    /// `,@`
    CommaAt,
    /// `,.`
    CommaDot,
    /// `"…"`
    String,
    /// `#\x`, with the whole name.
    Character,
    /// A symbol or a number.
    Atom,
    /// `#` with digits and a letter, before the datum that it takes (`#'`, `#(`, `#2A`, `#+`).
    Dispatch {
        /// The digits.
        argument: Option<u32>,
        /// The letter, in upper case.
        letter: char,
    },
    /// `#` with digits, a letter and the token that belongs to it (`#xFF`, `#:g`, `#*101`,
    /// `#1#`).
    Prefixed {
        /// The digits.
        argument: Option<u32>,
        /// The letter, in upper case.
        letter: char,
        /// Where the text after the letter begins.
        body: usize,
    },
}

/// A token: the bytes `start..end` of the text.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// First byte.
    pub start: usize,
    /// Byte after the last one.
    pub end: usize,
    /// Is it complete? False for a string, a comment or a `|name` that the end of the text cuts
    /// off.
    pub is_closed: bool,
}

impl Token {
    /// Whether the token ends with a line break that an escape has made part of it, so that the next line may belong
    /// to it, too.
    pub(super) fn takes_line_break(&self, text: &str) -> bool {
        let is_name = matches!(
            self.kind,
            TokenKind::Atom | TokenKind::Character | TokenKind::Prefixed { .. }
        );
        is_name
            && text
                .get(..self.end)
                .is_some_and(|text| text.ends_with('\n'))
    }

    /// If the token begins with the dispatching macro character `#`: the digits after it, the
    /// letter in upper case, and where the text after that begins.
    pub(crate) fn dispatching(&self, text: &str) -> Option<(Option<u32>, char, usize)> {
        let letter = match self.kind {
            TokenKind::Dispatch { argument, letter } => return Some((argument, letter, self.end)),
            TokenKind::Prefixed {
                argument,
                letter,
                body,
            } => return Some((argument, letter, body)),
            TokenKind::Character => '\\',
            TokenKind::BlockComment => '|',
            _ => return None,
        };
        let digits = text.get(self.start + 1..self.end)?;
        let digits = digits.split(letter).next().unwrap_or("");
        let body = self.start + 1 + digits.len() + letter.len_utf8();
        Some((digits.parse().ok(), letter, body))
    }
}

/// Splits a text into tokens.
#[derive(Clone)]
pub struct Lexer<'t> {
    text: &'t str,
    position: usize,
    /// Further characters that end a token.
    terminators: &'t [char],
    /// Characters that are parts of symbols like letters.
    constituents: &'t [char],
}

/// Is the character blank space between tokens? Pasted text may contain exotic ones.
#[inline]
pub(crate) fn is_blank(c: char) -> bool {
    c.is_whitespace() || matches!(c, '\u{200B}' | '\u{FEFF}')
}

/// Does the character end a token before it?
pub(crate) fn is_terminating(c: char) -> bool {
    matches!(c, '"' | '\'' | '(' | ')' | ',' | ';' | '`') || is_blank(c)
}

impl<'t> Lexer<'t> {
    /// A lexer at the start of a text.
    pub fn new(text: &'t str) -> Lexer<'t> {
        Lexer::at(text, 0)
    }

    /// A lexer at a byte of a text; at the end if that is not a character boundary.
    pub fn at(text: &'t str, position: usize) -> Lexer<'t> {
        let position = if text.is_char_boundary(position) {
            position
        } else {
            text.len()
        };
        Lexer {
            text,
            position,
            terminators: &[],
            constituents: &[],
        }
    }

    /// Lets further characters end a token.
    pub(crate) fn with_terminators(self, terminators: &'t [char]) -> Lexer<'t> {
        Lexer {
            terminators,
            ..self
        }
    }

    /// Lets characters be parts of symbols that would mean something else.
    pub(crate) fn with_constituents(self, constituents: &'t [char]) -> Lexer<'t> {
        Lexer {
            constituents,
            ..self
        }
    }

    /// The byte at which the search for the next token starts.
    pub fn position(&self) -> usize {
        self.position
    }

    /// Moves past blank space.
    #[inline]
    pub(crate) fn skip_blanks(&mut self) {
        while let Some(c) = self.peek() {
            if !is_blank(c) || self.constituents.contains(&c) {
                return;
            }
            self.position += c.len_utf8();
        }
    }

    /// The next character.
    #[inline]
    pub fn peek(&self) -> Option<char> {
        // Almost all text is ASCII; that needs no decoding.
        match self.text.as_bytes().get(self.position) {
            Some(b) if b.is_ascii() => Some(char::from(*b)),
            Some(_) => self.text.get(self.position..)?.chars().next(),
            None => None,
        }
    }

    #[inline]
    fn bump(&mut self) -> Option<char> {
        let c = self.peek()?;
        self.position += c.len_utf8();
        Some(c)
    }

    fn eat(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.position += wanted.len_utf8();
        }
        found
    }

    /// Moves over a symbol or number; true if its last escape is closed.
    fn skip_atom(&mut self) -> bool {
        while let Some(c) = self.peek() {
            match c {
                c if self.constituents.contains(&c) && !self.terminators.contains(&c) => {
                    self.position += c.len_utf8();
                }
                '\\' => {
                    self.position += 1;
                    if self.bump().is_none() {
                        return false;
                    }
                }
                '|' => {
                    self.position += 1;
                    if !self.skip_to('|') {
                        return false;
                    }
                }
                c if is_terminating(c) || self.terminators.contains(&c) => return true,
                c => self.position += c.len_utf8(),
            }
        }
        true
    }

    /// Moves past the next `end` that no backslash precedes; false if there is none.
    fn skip_to(&mut self, end: char) -> bool {
        while let Some(c) = self.bump() {
            if c == '\\' {
                if self.bump().is_none() {
                    return false;
                }
            } else if c == end {
                return true;
            }
        }
        false
    }

    fn skip_block_comment(&mut self) -> bool {
        let mut depth = 1_usize;
        while let Some(c) = self.bump() {
            if c == '|' && self.eat('#') {
                depth -= 1;
                if depth == 0 {
                    return true;
                }
            } else if c == '#' && self.eat('|') {
                depth += 1;
            }
        }
        false
    }

    fn dispatch(&mut self) -> (TokenKind, bool) {
        let mut argument: Option<u32> = None;
        while let Some(digit) = self.peek().and_then(|c| c.to_digit(10)) {
            self.position += 1;
            argument = Some(
                argument
                    .unwrap_or(0)
                    .saturating_mul(10)
                    .saturating_add(digit),
            );
        }
        let Some(letter) = self.bump() else {
            return (
                TokenKind::Dispatch {
                    argument,
                    letter: ' ',
                },
                false,
            );
        };
        let letter = letter.to_ascii_uppercase();
        let body = self.position;
        match letter {
            '|' => (TokenKind::BlockComment, self.skip_block_comment()),
            '\\' => {
                // The first character counts even if it would end a token.
                let is_closed = self.bump().is_some() && self.skip_atom();
                (TokenKind::Character, is_closed)
            }
            'X' | 'B' | 'O' | 'R' | '*' | ':' => {
                let is_closed = self.skip_atom();
                let kind = TokenKind::Prefixed {
                    argument,
                    letter,
                    body,
                };
                (kind, is_closed)
            }
            '#' => (
                TokenKind::Prefixed {
                    argument,
                    letter,
                    body,
                },
                true,
            ),
            _ => (TokenKind::Dispatch { argument, letter }, true),
        }
    }
}

impl Iterator for Lexer<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        self.skip_blanks();
        let start = self.position;
        let first = self.bump()?;
        let (kind, is_closed) = match first {
            first if self.constituents.contains(&first) => {
                self.position = start;
                (TokenKind::Atom, self.skip_atom())
            }
            '(' => (TokenKind::Open, true),
            ')' => (TokenKind::Close, true),
            '\'' => (TokenKind::Quote, true),
            '`' => (TokenKind::Backquote, true),
            ',' if self.eat('@') => (TokenKind::CommaAt, true),
            ',' if self.eat('.') => (TokenKind::CommaDot, true),
            ',' => (TokenKind::Comma, true),
            '"' => (TokenKind::String, self.skip_to('"')),
            ';' => {
                let rest = self.text.get(self.position..).unwrap_or("");
                self.position += rest.find('\n').unwrap_or(rest.len());
                (TokenKind::LineComment, true)
            }
            '#' => self.dispatch(),
            _ => {
                self.position = start;
                (TokenKind::Atom, self.skip_atom())
            }
        };
        Some(Token {
            kind,
            start,
            end: self.position,
            is_closed,
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::reader::lexer::*;

    fn kinds(text: &str) -> Vec<(TokenKind, &str)> {
        Lexer::new(text)
            .map(|t| (t.kind, &text[t.start..t.end]))
            .collect()
    }

    #[test]
    fn spans_cover_the_tokens() {
        assert_eq!(
            kinds("(f-1 \"a\\\"b\") ; c\n'|x y|"),
            vec![
                (TokenKind::Open, "("),
                (TokenKind::Atom, "f-1"),
                (TokenKind::String, "\"a\\\"b\""),
                (TokenKind::Close, ")"),
                (TokenKind::LineComment, "; c"),
                (TokenKind::Quote, "'"),
                (TokenKind::Atom, "|x y|"),
            ]
        );
    }

    #[test]
    fn block_comments_nest() {
        let text = "#| a #| b |# c |# d";
        assert_eq!(
            kinds(text),
            vec![
                (TokenKind::BlockComment, "#| a #| b |# c |#"),
                (TokenKind::Atom, "d"),
            ]
        );
    }

    #[test]
    fn a_character_may_be_a_parenthesis() {
        assert_eq!(
            kinds("#\\( #\\Space)"),
            vec![
                (TokenKind::Character, "#\\("),
                (TokenKind::Character, "#\\Space"),
                (TokenKind::Close, ")"),
            ]
        );
    }

    #[test]
    fn broken_off_tokens_are_not_closed() {
        for text in ["\"abc", "#| x", "|ab", "a\\", "#\\", "#"] {
            let last = Lexer::new(text).last().unwrap();
            assert!(!last.is_closed, "{text}");
            assert_eq!(last.end, text.len());
        }
    }
}
