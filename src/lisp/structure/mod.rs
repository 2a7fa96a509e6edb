//! Structures: `defstruct`.
//!
//! A definition is expanded into calls of builtins that define the class and the functions
//! that need no compiled code (accessors, predicate, copier), and into plain functions for
//! the constructors.

pub(crate) mod accessors;
pub(crate) mod constructors;
pub(crate) mod define;
pub(crate) mod expand;
pub(crate) mod options;
pub(crate) mod typed;

#[cfg(test)]
mod tests;
