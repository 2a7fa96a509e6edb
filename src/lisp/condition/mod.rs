//! Conditions: the standard classes, making objects of them, and their texts.

pub mod classes;
pub mod make;
pub mod matching;

pub use make::{Draft, draft, make, make_condition, report};
pub use matching::is_of_type;
