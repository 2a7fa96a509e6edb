//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.

pub mod closest_name;
pub mod motion;
pub mod perception;
pub mod robot;
pub mod sexp;
pub mod spatial;
pub mod world;
