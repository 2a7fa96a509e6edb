//! Does a text consist of whole forms? The prompt asks this to know whether to read on.

use super::flattened::unbalanced_depth;
use super::lexer::{Lexer, Token, TokenKind};

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

/// Tells whether a text consists of whole forms.
pub fn is_complete(text: &str) -> Completeness {
    Scanner::default().scan(text)
}

/// Tells of a text that grows by whole lines, again and again, whether it consists of whole forms. All
/// answers together take time that grows with the text alone.
#[derive(Clone, Default, Debug)]
pub struct Scanner {
    /// The byte up to which the text has been read.
    read: usize,
    open: Vec<Open>,
    /// How many lists are open.
    depth: usize,
    /// The string, block comment or symbol in bars that was open at the end.
    cut_off: Option<CutOff>,
    unmatched: Option<usize>,
    lost: Lost,
}

/// What is not finished yet.
#[derive(Clone, Debug)]
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

/// A token that the end of the text cuts off.
#[derive(Clone, Debug)]
struct CutOff {
    at: usize,
    /// It stays so as long as this does not come.
    closing: &'static str,
    /// The byte up to which the text has been searched for that.
    searched: usize,
}

/// The parentheses in comments that do not balance there, so that they may be lost code.
#[derive(Clone, Default, Debug)]
struct Lost {
    is_any: bool,
    /// How many more of them open than close.
    depth: i64,
    /// Whether quotes among them may change the meaning of all that follows.
    has_quotes: bool,
}

impl Scanner {
    /// Tells whether the text consists of whole forms. It is the text of the last time, and further lines: a line
    /// break stands where that ended.
    pub fn scan(&mut self, text: &str) -> Completeness {
        if let Some(cut_off) = &mut self.cut_off {
            let more = text.get(cut_off.searched..).unwrap_or_default();
            if !more.contains(cut_off.closing) {
                cut_off.searched = text.len();
                return self.state();
            }
            self.cut_off = None;
        }
        for token in Lexer::at(text, self.read) {
            if self.unmatched.is_some() {
                break;
            }
            if !token.is_closed {
                self.cut_off = CutOff::of(&token, text);
                return self.incomplete(token.start);
            }
            if token.end == text.len() && token.takes_line_break(text) {
                let mut ended = self.clone();
                ended.take(&token, text);
                return ended.state();
            }
            self.read = token.end;
            self.take(&token, text);
        }
        self.state()
    }

    /// Whether the text of the last time, which was incomplete, may be whole with the lists that its comments have
    /// perhaps swallowed. If not, it is certainly not.
    pub fn may_have_lost_code(&self) -> bool {
        let balances = self.cut_off.is_none() && self.lost.depth + self.depth as i64 == 0;
        self.lost.is_any && (self.lost.has_quotes || balances)
    }

    /// What is known without a token at the end that is cut off but for its place.
    fn state(&self) -> Completeness {
        if let Some(at) = self.unmatched {
            return Completeness::Unmatched { at };
        }
        let cut_off = self.cut_off.as_ref().map(|cut_off| cut_off.at);
        let innermost = self.open.last().map(|open| match open {
            Open::List { at } | Open::Prefix { at, .. } => *at,
        });
        match cut_off.or(innermost) {
            Some(opened_at) => self.incomplete(opened_at),
            None => Completeness::Complete,
        }
    }

    fn incomplete(&self, opened_at: usize) -> Completeness {
        Completeness::Incomplete {
            opened_at,
            depth: self.depth,
        }
    }

    /// Takes a token that is closed.
    fn take(&mut self, token: &Token, text: &str) {
        let at = token.start;
        match token.kind {
            TokenKind::LineComment => {
                let comment = text.get(at..token.end).unwrap_or_default();
                if let Some(depth) = unbalanced_depth(comment) {
                    self.lost.is_any = true;
                    self.lost.depth += depth;
                    self.lost.has_quotes |= comment.contains(['"', '|', '\\']);
                }
            }
            TokenKind::BlockComment => {}
            TokenKind::Open | TokenKind::Dispatch { letter: '(', .. } => {
                self.open.push(Open::List { at });
                self.depth += 1;
            }
            TokenKind::Close => {
                // A quote right before the parenthesis is an error, which the parser reports.
                while matches!(self.open.last(), Some(Open::Prefix { .. })) {
                    self.open.pop();
                }
                if self.open.pop().is_none() {
                    self.unmatched = Some(at);
                    return;
                }
                self.depth -= 1;
                self.finish_datum();
            }
            TokenKind::Quote
            | TokenKind::Backquote
            | TokenKind::Comma
            | TokenKind::CommaAt
            | TokenKind::CommaDot => self.open.push(Open::Prefix { at, missing: 1 }),
            TokenKind::Dispatch { letter, .. } => {
                let missing = if matches!(letter, '+' | '-') { 2 } else { 1 };
                self.open.push(Open::Prefix { at, missing });
            }
            TokenKind::String
            | TokenKind::Character
            | TokenKind::Atom
            | TokenKind::Prefixed { .. } => self.finish_datum(),
        }
    }

    fn finish_datum(&mut self) {
        while let Some(Open::Prefix { missing, .. }) = self.open.last_mut() {
            *missing -= 1;
            if *missing > 0 {
                return;
            }
            self.open.pop();
        }
    }
}

impl CutOff {
    /// What the end of a text has cut off of a token; `None` if that ends with the line.
    fn of(token: &Token, text: &str) -> Option<CutOff> {
        let closing = match token.kind {
            TokenKind::String => "\"",
            TokenKind::BlockComment => "|#",
            // A symbol in bars goes on; a `\` takes the line break, and so does a `#`.
            TokenKind::Dispatch { .. } => return None,
            _ if text.ends_with('\\') => return None,
            _ => "|",
        };
        Some(CutOff {
            at: token.start,
            closing,
            searched: text.len(),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::reader::completeness::*;
    use crate::reader::flattened::unflattened;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

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

    #[test]
    fn a_text_that_grows_is_seen_as_if_it_were_new() {
        let parts = [
            "(",
            ")",
            "a",
            "'",
            "\"",
            "|",
            "#|",
            "|#",
            "\\",
            "#\\",
            "#",
            "#+",
            "#(",
            ";",
            ";; see (b",
            ";; x (b) ;; y )",
            ";; \"(",
            "\n",
            " ",
            "1",
            "#1",
            ",",
            ",@",
            "é",
        ];
        let mut random = Pcg64::seed_from_u64(1);
        let mut below = |limit: usize| (random.next_u64() % limit as u64) as usize;
        let mut lost = 0;
        for _ in 0..20_000 {
            let mut text = String::new();
            let mut scanners = [Scanner::default(), Scanner::default()];
            for _ in 0..24 {
                text.push_str(parts[below(parts.len())]);
                if below(4) > 0 {
                    continue;
                }
                // One sees lines as they are typed, the other with their ends.
                for (scanner, end) in scanners.iter_mut().zip(["", "\n"]) {
                    text.push_str(end);
                    let found = scanner.scan(&text);
                    assert_eq!(found, is_complete(&text), "{text:?}");
                    let is_open = matches!(found, Completeness::Incomplete { .. });
                    if is_open && unflattened(&text).is_some() {
                        assert!(scanner.may_have_lost_code(), "{text:?}");
                        lost += 1;
                    }
                }
            }
        }
        assert!(lost > 100, "{lost}");
    }
}
