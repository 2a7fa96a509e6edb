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
pub mod flattened;
mod label;
pub(crate) mod lexer;
mod literal;
pub(crate) mod numeric;
mod parser;
pub mod readtable;
mod suggest;
mod symbol;
mod typed_array;

pub use completeness::{Completeness, Scanner, is_complete};
pub use error::{ReadError, ReadErrorKind};
pub use lexer::{Lexer, Token, TokenKind};
#[cfg(test)]
pub use parser::read_all;
pub use parser::{Outcome, Reader};
pub use readtable::LetterCase;
pub use suggest::nearest;
pub use symbol::downcase;
pub(crate) use symbol::{inverting, meant_by_quotation_mark, upcase};

#[cfg(test)]
mod tests;
