//! The object system: classes, instances, generic functions and their methods.
//!
//! Holds true: a class keeps its identity over redefinitions; an instance is brought up to
//! date before anything reads it; a call of a generic function never calls Lisp from Rust.

pub mod builtin_classes;
pub mod class_of;
pub mod define;
pub mod precedence;

pub use class_of::class_of;

#[cfg(test)]
pub(crate) mod testing;
