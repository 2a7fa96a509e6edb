//! The language without robots: values, symbols, the compiler, the machine and the
//! builtin functions. Depends on nothing but the reader.

pub mod builtin;
pub mod builtins;
pub mod compile;
pub mod condition;
pub mod image;
pub mod loop_macro;
pub mod object;
pub mod polls;
pub mod print;
pub mod reader;
mod setup;
pub mod source;
pub mod stream;
pub mod structure;
pub mod types;
pub mod value;
pub mod vm;

pub use image::Image;
pub use value::Value;
pub use value::raise::Raise;
pub use value::symbol::Sym;
