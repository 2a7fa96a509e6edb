//! Type specifiers: reading them, testing values, comparing types, converting.
//!
//! `satisfies` and `deftype` call Lisp functions. Rust code never does: an operation that needs the
//! value of a call stops with the call (`Stop::Call`) and is started again with the answer; answers
//! are kept in order, so nothing is called twice.

pub mod asking;
pub mod coerce;
mod complex_numbers;
pub(crate) mod emptiness;
pub mod parse;
pub(crate) mod sequence_types;
pub(crate) mod specifier;
pub(crate) mod standard_variables;
pub(crate) mod subtype;
pub mod test;
pub mod type_of;

#[cfg(test)]
mod tests;

pub(crate) use test::typep_with;
pub use test::{TypeCheck, typep};
pub use type_of::type_of;

use std::cmp::Ordering;

use super::value::Value;

/// Compares two values; `None` unless both are real numbers, and neither is a NaN.
pub fn compare(a: &Value, b: &Value) -> Option<Ordering> {
    crate::value::number::compare(a, b).ok().flatten()
}
