//! A small Prolog over Lisp values: fact groups, and proofs that may call Lisp functions. It does
//! not know about designators: the layers above add their own functors to the table.
//!
//! Variables are symbols that begin with `?`. Functors of the language itself are recognised by
//! name, in whatever package; those of fact groups by identity. Proofs run depth first, in the
//! order of the facts, and backtrack without recursion, so that a function called by a goal may
//! wait.

pub mod builtins;
mod choice_point;
pub mod engine;
mod engine_copy;
mod engine_references;
pub mod facts;
pub mod functor;
pub mod functors;
pub mod goal;
mod goal_chain;
pub mod search;
pub(crate) mod term;
pub(crate) mod tracing;
pub mod warnings;
