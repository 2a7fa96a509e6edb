//! The machine that runs compiled code: explicit frames, no recursion on the Rust stack.

pub mod aside;
pub mod backtrace;
pub mod call;
pub mod code;
pub mod fiber;
pub mod machine;
pub mod restart;
pub mod signal;
pub mod step;
#[cfg(test)]
mod tests;
mod unwind;
