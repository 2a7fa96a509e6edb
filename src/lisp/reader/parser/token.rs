//! What each token begins, ends or means.

use super::frame::{Dot, Frame, Kind};
use super::{Outcome, Reader};
use crate::image::Image;
use crate::reader::error::ReadErrorKind;
use crate::reader::lexer::{Token, TokenKind};
use crate::reader::literal;
use crate::reader::numeric::parse_number;
use crate::reader::readtable::{LetterCase, escaped};
use crate::reader::symbol;
use crate::value::Value;
use crate::value::known;
use crate::value::symbol::Sym;

impl Reader {
    /// Processes a token; returns an outcome if there is one for the caller.
    pub(super) fn token(
        &mut self,
        image: &mut Image,
        text: &str,
        token: Token,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        if !token.is_closed {
            let what = match token.kind {
                TokenKind::String => "a string",
                TokenKind::BlockComment => "a block comment",
                TokenKind::Character => "a character",
                TokenKind::Dispatch { .. } => "the dispatch macro #",
                _ => "a symbol",
            };
            return Err(self.end_of_file(what, token.start));
        }
        // The lexer's spans lie on character boundaries of the text.
        let slice = |from: usize, to: usize| text.get(from..to).unwrap_or("");
        let start = token.start;
        let value = match token.kind {
            TokenKind::LineComment | TokenKind::BlockComment => return Ok(None),
            TokenKind::Open => return self.push(Kind::List(Dot::None), start),
            TokenKind::Close => return self.close(image, start, token.end),
            TokenKind::Quote => return self.push(Kind::Wrap(known::QUOTE), start),
            TokenKind::Backquote => return self.push(Kind::Backquote, start),
            TokenKind::Comma => return self.comma(known::UNQUOTE, ",", start),
            TokenKind::CommaAt => return self.comma(known::UNQUOTE_SPLICING, ",@", start),
            TokenKind::CommaDot => return self.comma(known::UNQUOTE_SPLICING, ",.", start),
            TokenKind::Dispatch { argument, letter } => {
                return self.dispatch(argument, letter, start);
            }
            _ if self.skips > 0 && self.features == 0 => {
                let is_in_list = matches!(self.frames.last().map(|f| f.kind), Some(Kind::List(_)));
                if is_in_list && slice(start, token.end) == "." {
                    return Ok(None);
                }
                Value::NIL
            }
            TokenKind::String => literal::string(slice(start + 1, token.end - 1)),
            TokenKind::Character => literal::character(slice(start + 2, token.end))?,
            TokenKind::Atom => match self.atom(image, &escaped(image, slice(start, token.end)))? {
                Some(value) => value,
                None => return Ok(None),
            },
            TokenKind::Prefixed {
                argument,
                letter: '#',
                ..
            } => self.labels.reference(argument)?,
            TokenKind::Prefixed {
                argument,
                letter,
                body,
            } => literal::prefixed(image, argument, letter, slice(body, token.end))?,
        };
        self.deliver(image, value, start, token.end)
    }

    pub(super) fn push(
        &mut self,
        kind: Kind,
        start: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        match kind {
            Kind::Backquote => self.backquotes += 1,
            Kind::Comma(_) => self.backquotes = self.backquotes.saturating_sub(1),
            Kind::Skip | Kind::Suppressed => self.skips += 1,
            Kind::Feature(_) => self.features += 1,
            _ => {}
        }
        self.frames.push(Frame {
            kind,
            start,
            base: self.values.len(),
        });
        Ok(None)
    }

    fn comma(
        &mut self,
        operator: Sym,
        prefix: &'static str,
        start: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        if self.backquotes == 0 && self.skips == 0 {
            return Err(
                decimal_comma(&self.text, start).unwrap_or(ReadErrorKind::CommaOutsideBackquote)
            );
        }
        if operator == known::UNQUOTE_SPLICING {
            let before = match self.frames.last().map(|f| f.kind) {
                Some(Kind::Backquote) => Some("backquote"),
                Some(Kind::List(Dot::Expecting)) => Some("dot"),
                _ => None,
            };
            if let Some(before) = before {
                return Err(ReadErrorKind::NothingToSpliceInto { prefix, before });
            }
        }
        self.push(Kind::Comma(operator), start)
    }

    fn dispatch(
        &mut self,
        argument: Option<u32>,
        letter: char,
        start: usize,
    ) -> Result<Option<Outcome>, ReadErrorKind> {
        // What is left out needs no number.
        let skipped = (self.skips > 0).then_some(0);
        let needed = |reason| {
            let error = ReadErrorKind::DispatchArgument { letter, reason };
            argument.or(skipped).ok_or(error)
        };
        let kind = match letter {
            '\'' => Kind::Wrap(known::FUNCTION),
            '(' => Kind::Vector(argument),
            '+' => Kind::Feature(true),
            '-' => Kind::Feature(false),
            '.' => Kind::Evaluate,
            'A' => argument.or(skipped).map_or(Kind::TypedArray, Kind::Array),
            'S' => Kind::Structure,
            'C' => Kind::Complex,
            'P' => Kind::Pathname,
            '=' => {
                let label = needed("the label")?;
                if self.skips == 0 {
                    self.labels.open(label)?;
                }
                Kind::Label(label)
            }
            '<' | ')' => return Err(ReadErrorKind::IllegalDispatch(letter)),
            c if crate::reader::lexer::is_blank(c) => {
                return Err(ReadErrorKind::IllegalDispatch(c));
            }
            c => return Err(ReadErrorKind::UnknownDispatch(c)),
        };
        self.push(kind, start)
    }

    /// The value of a symbol or number; `None` for the dot of a pair.
    fn atom(&mut self, image: &mut Image, token: &str) -> Result<Option<Value>, ReadErrorKind> {
        if token.bytes().all(|b| b == b'.') {
            return self.dot(token.len()).map(|()| None);
        }
        let radix = match image.special(known::V_READ_BASE) {
            Value::Int(n @ 2..=36) => *n as u32,
            _ => 10,
        };
        let float_format = image
            .special(known::V_READ_DEFAULT_FLOAT_FORMAT)
            .as_symbol()
            .unwrap_or(known::SINGLE_FLOAT);
        if let Some(number) = parse_number(token, radix, float_format) {
            return number.map(Some);
        }
        if let Some(error) = number_with_dash(token, radix, float_format) {
            return Err(error);
        }
        let name = symbol::split(token, LetterCase::current(image))?;
        let symbol = if self.features > 0 && name.package.is_none() {
            image.keyword(&name.name).into()
        } else {
            symbol::resolve(image, &name, self.is_for_program)?
        };
        Ok(Some(symbol))
    }

    fn dot(&mut self, length: usize) -> Result<(), ReadErrorKind> {
        if length > 1 {
            return Err(ReadErrorKind::TooManyDots);
        }
        let count = self.values.len();
        match self.frames.last_mut() {
            Some(Frame {
                kind: Kind::List(dot),
                base,
                ..
            }) => match dot {
                Dot::None if *base == count => Err(ReadErrorKind::NothingBeforeDot),
                Dot::None => {
                    *dot = Dot::Expecting;
                    Ok(())
                }
                Dot::Expecting | Dot::Done => Err(ReadErrorKind::DotContext),
            },
            _ => Err(ReadErrorKind::DotContext),
        }
    }
}

/// The error for a comma at a byte of a text, if digits stand directly before and after it.
fn decimal_comma(text: &str, comma: usize) -> Option<ReadErrorKind> {
    let is_part = |c: char| c.is_ascii_digit();
    let before = text.get(..comma)?;
    let after = text.get(comma + 1..)?;
    let whole = before.len() - before.trim_end_matches(is_part).len();
    let digits = after.len() - after.trim_start_matches(is_part).len();
    if whole == 0 || digits == 0 {
        return None;
    }
    let mut start = comma - whole;
    if text.get(..start)?.ends_with(['-', '+']) {
        start -= 1;
    }
    let whole = text.get(start..comma)?;
    let fraction = after.get(..digits)?;
    Some(ReadErrorKind::DecimalComma {
        written: format!("{whole},{fraction}"),
        instead: format!("{whole}.{fraction}"),
    })
}

/// The error for a token that would be a number if its dashes were minus signs.
fn number_with_dash(token: &str, radix: u32, float_format: Sym) -> Option<ReadErrorKind> {
    if token.is_ascii() {
        return None;
    }
    let is_dash = |c: char| {
        matches!(
            c,
            '\u{2010}'..='\u{2015}' | '\u{2212}' | '\u{fe63}' | '\u{ff0d}'
        )
    };
    let dash = token.chars().find(|c| is_dash(*c))?;
    let instead: String = token
        .chars()
        .map(|c| if is_dash(c) { '-' } else { c })
        .collect();
    parse_number(&instead, radix, float_format)?.ok()?;
    Some(ReadErrorKind::Dash {
        written: token.to_owned(),
        dash: format!("{dash} (U+{:04X})", u32::from(dash)),
        instead,
    })
}
