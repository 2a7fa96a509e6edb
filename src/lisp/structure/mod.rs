//! Structures: `defstruct`.
//!
//! A definition is expanded into calls of builtins that define the class and the functions
//! that need no compiled code (accessors, predicate, copier), and into plain functions for
//! the constructors.

pub(crate) mod accessors;
pub(crate) mod constructors;
pub mod define;
pub mod expand;
pub mod options;
pub mod typed;

#[cfg(test)]
mod tests;
