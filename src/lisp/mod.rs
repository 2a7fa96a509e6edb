//! The language without robots: values, symbols, the compiler, the machine and the
//! builtin functions. Depends on nothing but the reader.

pub mod array;
pub mod builtin;
pub mod builtins;
pub mod class;
pub mod compile;
pub mod condition;
pub mod cons;
pub mod equality;
pub mod foreign;
pub mod function;
pub mod generic;
pub mod hash_table;
pub mod image;
pub mod known;
pub mod loop_macro;
pub mod number;
pub mod object;
pub mod package;
pub mod polls;
pub mod print;
pub mod raise;
mod setup;
pub mod slot;
pub mod stream;
pub mod string;
pub mod structure;
pub mod symbol;
pub mod types;
pub mod value;
pub mod vm;

pub use image::Image;
pub use raise::Raise;
pub use symbol::Sym;
pub use value::Value;
