//! The expressions that Emacs writes and reads.
//!
//! They are those of Emacs Lisp: names are in lower case, and strings escape only `\` and `"`.
//! `:` and `::` in names mean the same here.

use std::fmt;

use thiserror::Error;

/// How deeply lists may nest.
const DEEPEST: usize = 200;

/// An expression.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Sexp {
    /// A whole number.
    Int(i64),
    /// A string.
    Str(String),
    /// A symbol or keyword, in lower case; what cannot be read as anything else, too.
    Symbol(String),
    /// A list; the empty one is `nil`.
    List(Vec<Sexp>),
}

/// Why a text is no expression.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Error)]
pub(super) enum SexpError {
    #[error("the message ends in the middle of an expression")]
    Unfinished,
    #[error("the message has a parenthesis too many, or text after its end")]
    TooMuch,
    #[error("the message is nested too deeply")]
    TooDeep,
}

impl Sexp {
    /// The empty list.
    pub(super) const NIL: Sexp = Sexp::List(Vec::new());

    /// A symbol.
    pub(super) fn symbol(name: &str) -> Sexp {
        Sexp::Symbol(name.to_owned())
    }

    /// `t`.
    pub(super) fn t() -> Sexp {
        Sexp::symbol("t")
    }

    /// `t` or `nil`.
    pub(super) fn boolean(is_true: bool) -> Sexp {
        if is_true { Sexp::t() } else { Sexp::NIL }
    }

    /// A list.
    pub(super) fn list(items: impl IntoIterator<Item = Sexp>) -> Sexp {
        Sexp::List(items.into_iter().collect())
    }

    /// A property list: a list of keywords, given without their colons, and values.
    pub(super) fn properties<const N: usize>(pairs: [(&str, Sexp); N]) -> Sexp {
        let pairs = pairs.into_iter();
        Sexp::list(pairs.flat_map(|(key, value)| [Sexp::Symbol(format!(":{key}")), value]))
    }

    /// Reads the one expression of a text.
    pub(super) fn read(text: &str) -> Result<Sexp, SexpError> {
        let mut rest = text;
        let read = read_at(&mut rest, 0)?;
        match rest.trim().is_empty() {
            true => Ok(read),
            false => Err(SexpError::TooMuch),
        }
    }

    /// The items of a list; none of anything else.
    pub(super) fn items(&self) -> &[Sexp] {
        match self {
            Sexp::List(items) => items,
            _ => &[],
        }
    }

    /// The item with that index.
    pub(super) fn item(&self, index: usize) -> Option<&Sexp> {
        self.items().get(index)
    }

    /// The text of a string.
    pub(super) fn as_str(&self) -> Option<&str> {
        match self {
            Sexp::Str(text) => Some(text),
            _ => None,
        }
    }

    /// The name of a symbol, or the text of a string.
    pub(super) fn as_name(&self) -> Option<&str> {
        match self {
            Sexp::Str(text) | Sexp::Symbol(text) => Some(text),
            _ => None,
        }
    }

    /// A whole number.
    pub(super) fn as_int(&self) -> Option<i64> {
        match self {
            Sexp::Int(number) => Some(*number),
            _ => None,
        }
    }

    /// A whole number that is an index.
    pub(super) fn as_index(&self) -> Option<usize> {
        usize::try_from(self.as_int()?).ok()
    }

    /// Whether it is `nil`.
    pub(super) fn is_nil(&self) -> bool {
        *self == Sexp::NIL
    }

    /// What is quoted; anything else is itself.
    pub(super) fn unquoted(&self) -> &Sexp {
        match self.items() {
            [Sexp::Symbol(quote), quoted] if quote == "quote" => quoted,
            _ => self,
        }
    }
}

impl From<&str> for Sexp {
    fn from(text: &str) -> Sexp {
        Sexp::Str(text.to_owned())
    }
}

impl From<String> for Sexp {
    fn from(text: String) -> Sexp {
        Sexp::Str(text)
    }
}

impl From<usize> for Sexp {
    fn from(number: usize) -> Sexp {
        Sexp::Int(i64::try_from(number).unwrap_or(i64::MAX))
    }
}

impl fmt::Display for Sexp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Sexp::Int(number) => write!(f, "{number}"),
            Sexp::Symbol(name) => f.write_str(name),
            Sexp::Str(text) => {
                f.write_str("\"")?;
                for part in text.split_inclusive(['\\', '"']) {
                    match part.strip_suffix(['\\', '"']) {
                        Some(plain) => {
                            let escaped = part.get(plain.len()..).unwrap_or_default();
                            write!(f, "{plain}\\{escaped}")?;
                        }
                        None => f.write_str(part)?,
                    }
                }
                f.write_str("\"")
            }
            Sexp::List(items) if items.is_empty() => f.write_str("nil"),
            Sexp::List(items) => {
                f.write_str("(")?;
                for (at, item) in items.iter().enumerate() {
                    if at > 0 {
                        f.write_str(" ")?;
                    }
                    item.fmt(f)?;
                }
                f.write_str(")")
            }
        }
    }
}

fn read_at(rest: &mut &str, depth: usize) -> Result<Sexp, SexpError> {
    if depth > DEEPEST {
        return Err(SexpError::TooDeep);
    }
    *rest = rest.trim_start();
    let first = rest.chars().next().ok_or(SexpError::Unfinished)?;
    let after = rest.get(first.len_utf8()..).unwrap_or_default();
    match first {
        '(' => {
            *rest = after;
            let mut items = Vec::new();
            loop {
                *rest = rest.trim_start();
                if let Some(after) = rest.strip_prefix(')') {
                    *rest = after;
                    return Ok(Sexp::List(items));
                }
                items.push(read_at(rest, depth + 1)?);
            }
        }
        ')' => Err(SexpError::TooMuch),
        '\'' => {
            *rest = after;
            let quoted = read_at(rest, depth + 1)?;
            Ok(Sexp::list([Sexp::symbol("quote"), quoted]))
        }
        '"' => read_string(after, rest),
        _ => {
            let is_end = |c: char| c.is_whitespace() || matches!(c, '(' | ')' | '"' | '\'');
            let end = rest.find(is_end).unwrap_or(rest.len());
            let (word, after) = rest.split_at(end);
            *rest = after;
            Ok(match word.parse() {
                Ok(number) => Sexp::Int(number),
                Err(_) => name(word),
            })
        }
    }
}

fn read_string<'t>(text: &'t str, rest: &mut &'t str) -> Result<Sexp, SexpError> {
    let mut read = String::new();
    let mut is_escaped = false;
    for (at, c) in text.char_indices() {
        match c {
            '"' if !is_escaped => {
                *rest = text.get(at + 1..).unwrap_or_default();
                return Ok(Sexp::Str(read));
            }
            '\\' if !is_escaped => is_escaped = true,
            c => {
                read.push(c);
                is_escaped = false;
            }
        }
    }
    Err(SexpError::Unfinished)
}

fn name(word: &str) -> Sexp {
    let lower = word.to_lowercase();
    match lower.as_str() {
        "nil" => Sexp::NIL,
        _ => Sexp::Symbol(match lower.split_once("::") {
            Some((package, name)) => format!("{package}:{name}"),
            None => lower,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_emacs_writes_is_read() {
        let read = |text| Sexp::read(text).map(|sexp| sexp.to_string());
        let same =
            "(:emacs-rex (swank-repl:listener-eval \"(a \\\"b\\\\\\\")\n\") \"CL-USER\" t 12)";
        assert_eq!(read(same), Ok(same.to_owned()));
        assert_eq!(
            read("(SWANK::f 'NIL () '(-1 . \"ü\"))"),
            Ok("(swank:f (quote nil) nil (quote (-1 . \"ü\")))".to_owned())
        );
    }

    #[test]
    fn what_is_no_expression_is_told() {
        for (text, error) in [
            ("", SexpError::Unfinished),
            ("(a", SexpError::Unfinished),
            ("\"a\\\"", SexpError::Unfinished),
            ("'", SexpError::Unfinished),
            (")", SexpError::TooMuch),
            ("a b", SexpError::TooMuch),
        ] {
            assert_eq!(Sexp::read(text), Err(error), "{text}");
        }
        assert_eq!(Sexp::read(&"(".repeat(100_000)), Err(SexpError::TooDeep));
        assert_eq!(Sexp::read(&"'".repeat(100_000)), Err(SexpError::TooDeep));
    }
}
