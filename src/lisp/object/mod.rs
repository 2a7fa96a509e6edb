//! The object system: classes, instances, generic functions and their methods.
//!
//! Invariants: a class keeps its identity over redefinitions; an instance is brought up to date
//! before anything reads it; a call of a generic function never calls Lisp from Rust.

pub mod access;
pub(crate) mod builtin_classes;
pub mod class_of;
pub(crate) mod combination;
pub mod combine;
pub mod defclass;
pub mod define;
pub mod defmethod;
pub mod dispatch;
pub mod effective;
pub mod fill;
pub mod instance;
pub(crate) mod library_classes;
pub mod method;
pub(crate) mod near_class;
pub mod parameters;
pub(crate) mod precedence;
pub(crate) mod slot_options;
pub mod update;

pub use class_of::class_of;

use super::image::Image;
use super::value::Value;
use super::value::form::style_warning;

/// A value as `prin1` prints it, for messages.
pub fn text(image: &Image, value: &Value) -> String {
    super::print::to_string(image, value, true)
}

/// The form that warns of an option of a definition that has no effect.
fn warning_of_ignored(image: &Image, option: &Value) -> Value {
    style_warning(format!(
        "The option {} has no effect: there are only the standard metaclasses.",
        text(image, option)
    ))
}

#[cfg(test)]
pub mod testing;
#[cfg(test)]
mod tests;
