//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.

pub mod closest_name;
pub mod command;
pub mod designator;
pub mod dialogue;
pub mod lisp;
pub mod manual;
pub mod motion;
pub mod perception;
pub mod plan;
pub mod reader;
pub mod repl;
pub mod robot;
pub mod session;
pub mod sexp;
pub mod spatial;
pub mod transcript;
pub mod transform;
pub mod viewer;
pub mod world;
