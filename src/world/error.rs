//! Why the world refuses an order.

use thiserror::Error;

/// An order that cannot be carried out; nothing was changed.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum WorldError {
    /// There is no object of that name.
    #[error("there is no object named {name}{}", suggestion(.closest))]
    UnknownObject {
        /// The name that was asked for.
        name: String,
        /// The name that comes nearest.
        closest: Option<String>,
    },
    /// There is no type of that name in the object library.
    #[error("there is no object type {name}{}", suggestion(.closest))]
    UnknownType {
        /// The type that was asked for.
        name: String,
        /// The type that comes nearest.
        closest: Option<String>,
    },
    /// The kitchen has no joint of that name that can move.
    #[error("the kitchen has no moving joint {name}{}", suggestion(.closest))]
    UnknownKitchenJoint {
        /// The joint that was asked for.
        name: String,
        /// The joint that comes nearest.
        closest: Option<String>,
    },
    /// The object has no solid part, so that it cannot be put anywhere.
    #[error("an object of type {type_name} has no solid part")]
    NoSolid {
        /// Type of the object.
        type_name: String,
    },
    /// A number is infinite or not a number, or a mass is not positive.
    #[error("{quantity} of {name} is {value}, which cannot be")]
    ImpossibleNumber {
        /// What the number measures.
        quantity: &'static str,
        /// Whose number it is.
        name: String,
        /// The number.
        value: f64,
    },
}

fn suggestion(closest: &Option<String>) -> String {
    match closest {
        Some(name) => format!("; did you mean {name}?"),
        None => String::new(),
    }
}
