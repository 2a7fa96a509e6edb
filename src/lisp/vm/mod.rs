//! The machine that runs compiled code: explicit frames, no recursion on the Rust stack.

pub(crate) mod aside;
pub(crate) mod backtrace;
pub(crate) mod callable;
mod calling;
pub(crate) mod calls;
pub(crate) mod computation;
mod dynamic;
pub(crate) mod fiber;
pub(crate) mod machine;
pub(crate) mod nested;
mod open_calls;
mod primitives;
pub(crate) mod restart;
mod run;
pub(crate) mod signal;
pub(crate) mod step;
#[cfg(test)]
mod tests;
mod unwind;
mod variables;
