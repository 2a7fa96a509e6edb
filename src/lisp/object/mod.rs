//! The object system: classes, instances, generic functions and their methods.
//!
//! Holds true: a class keeps its identity over redefinitions; an instance is brought up to
//! date before anything reads it; a call of a generic function never calls Lisp from Rust.

pub(crate) mod access;
pub(crate) mod builtin_classes;
pub(crate) mod class_of;
pub(crate) mod combination;
pub(crate) mod combine;
pub(crate) mod defclass;
pub(crate) mod define;
pub(crate) mod defmethod;
pub(crate) mod dispatch;
pub(crate) mod effective;
pub(crate) mod fill;
pub(crate) mod instance;
pub(crate) mod method;
pub(crate) mod parameters;
pub(crate) mod precedence;
pub(crate) mod slot_options;
pub(crate) mod update;

pub(crate) use class_of::class_of;

use super::image::Image;
use super::value::Value;

/// A value as `prin1` prints it, for messages.
pub(crate) fn text(image: &Image, value: &Value) -> String {
    super::print::to_string(image, value, true)
}

/// A function name with the package of its symbol, as the printer shows generic functions.
pub(crate) fn qualified(image: &Image, name: &Value) -> String {
    match name {
        Value::Symbol(sym) => match image.symbol(*sym).package {
            Some(package) => {
                let colons = match image.home_access(*sym) {
                    Some(crate::lisp::value::package::Access::External) => ":",
                    _ => "::",
                };
                let home = &image.packages.get(package).name;
                format!("{home}{colons}{}", image.name(*sym))
            }
            None => format!("#:{}", image.name(*sym)),
        },
        list => {
            let parts: Vec<String> = list
                .iter_list()
                .map(|part| match part {
                    Value::Symbol(crate::lisp::value::known::SETF) => "SETF".to_owned(),
                    other => qualified(image, &other),
                })
                .collect();
            format!("({})", parts.join(" "))
        }
    }
}

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
