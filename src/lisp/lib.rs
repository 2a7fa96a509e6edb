//! The language without robots: values, symbols, the compiler, the machine and the
//! builtin functions. Depends on nothing but the reader.

pub mod builtin;
pub mod builtins;
pub mod compile;
pub mod condition;
pub mod evaluator;
pub mod files;
pub mod guard;
pub mod image;
pub mod library;
pub(crate) mod loop_macro;
pub mod native;
pub mod object;
pub mod print;
pub mod reader;
mod setup;
pub mod source;
pub mod stream;
pub mod structure;
pub mod typed;
pub mod types;
pub mod value;
pub mod visible;
pub mod vm;

pub use image::Image;
pub use value::raise::Raise;
pub use value::symbol::Sym;

#[cfg(test)]
mod tests;
