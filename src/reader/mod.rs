//! From text to forms: source texts with positions, the lexer of Common Lisp tokens, and
//! the parser.

pub mod source;
