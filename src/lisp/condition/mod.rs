//! Conditions: the standard classes, making objects of them, and their texts.

pub mod classes;
pub mod make;
pub use make::{draft, make, make_condition};
