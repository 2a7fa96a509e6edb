//! Conditions: the standard classes, making objects of them, and their texts.

pub(crate) mod classes;
pub(crate) mod make;
pub(crate) use make::{draft, make, make_condition};
