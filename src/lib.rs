//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.

pub mod motion;
pub mod spatial;
