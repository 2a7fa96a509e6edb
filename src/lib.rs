//! planwright: an interactive shell for programming a simulated kitchen robot in a
//! Common-Lisp-like plan language.

pub mod closest_name;
pub mod front;
pub mod lisp;
pub mod motion;
pub mod perception;
pub mod picture;
pub mod plan;
pub mod robot;
pub mod session;
pub mod sexp;
pub mod spatial;
pub mod watch;
pub mod world;
