//! Runs compiled code: explicit frames, no recursion on the Rust stack.

pub(crate) mod aside;
pub(crate) mod backtrace;
mod callees;
mod calling;
mod dynamic;
mod entry;
mod exits;
pub(crate) mod matching;
pub(crate) mod nested;
mod open_calls;
mod primitives;
pub(crate) mod restart;
mod run;
pub(crate) mod signal;
mod small_integers;
#[cfg(test)]
mod tests;
mod unwind;
mod variables;
