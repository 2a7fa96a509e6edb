//! The language without robots: values, symbols, the compiler, the machine and the
//! builtin functions. Depends on nothing but the reader.

pub(crate) mod builtin;
pub(crate) mod builtins;
pub(crate) mod compile;
pub(crate) mod condition;
pub(crate) mod evaluator;
pub(crate) mod guard;
pub(crate) mod image;
pub(crate) mod library;
pub(crate) mod loop_macro;
pub(crate) mod native;
pub(crate) mod object;
pub(crate) mod print;
pub(crate) mod reader;
mod setup;
pub(crate) mod source;
pub(crate) mod stream;
pub(crate) mod structure;
pub(crate) mod types;
pub(crate) mod value;
pub(crate) mod vm;

#[cfg(test)]
pub(crate) use image::Image;
pub(crate) use planwright_lisp_macros::{builtin, builtins};
pub(crate) use value::raise::Raise;
pub(crate) use value::symbol::Sym;
