//! From text to forms: source texts with positions, the lexer of Common Lisp tokens, and
//! the parser.
//!
//! Reading is linear in the length of the text and uses no Rust stack for nesting. The
//! reader interns symbols and registers places; it never evaluates: `#.` hands its form to
//! the caller and goes on with the value.

pub mod char_name;
mod completeness;
mod error;
mod feature;
mod label;
pub mod lexer;
mod literal;
pub mod numeric;
mod parser;
pub mod readtable;
mod suggest;
mod symbol;

pub use completeness::{Completeness, is_complete};
pub use error::{ReadError, ReadErrorKind};
pub use lexer::{Lexer, Token, TokenKind};
pub use parser::{Outcome, Reader, read_all};
pub use suggest::nearest;
pub(crate) use symbol::upcase;

#[cfg(test)]
mod tests;
