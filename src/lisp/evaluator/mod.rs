//! Runs compiled code: explicit frames, no recursion on the Rust stack.

pub mod aside;
pub mod backtrace;
mod callees;
mod calling;
mod dynamic;
mod entry;
mod exits;
pub mod matching;
pub mod nested;
mod open_calls;
mod primitives;
pub mod restart;
mod run;
pub mod signal;
mod small_integers;
#[cfg(test)]
mod tests;
mod unwind;
mod variables;
