//! From text to forms: source texts with positions, the lexer of Common Lisp tokens, and
//! the parser.
//!
//! Reading is linear in the length of the text and uses no Rust stack for nesting. The reader
//! interns symbols and registers places; it never evaluates: `#.` hands its form to the caller and
//! continues with the value.

pub(crate) mod ascii_name;
pub(crate) mod char_name;
mod completeness;
mod error;
mod feature;
mod label;
pub(crate) mod lexer;
mod literal;
pub(crate) mod numeric;
mod parser;
pub(crate) mod readtable;
mod suggest;
mod symbol;
mod typed_array;

pub(crate) use completeness::{Completeness, is_complete};
pub(crate) use error::ReadError;
pub(crate) use lexer::{Lexer, Token, TokenKind};
#[cfg(test)]
pub(crate) use parser::read_all;
pub(crate) use parser::{Outcome, Reader};
pub(crate) use readtable::LetterCase;
pub(crate) use suggest::nearest;
pub(crate) use symbol::{downcase, inverting, meant_by_quotation_mark, upcase};

#[cfg(test)]
mod tests;
