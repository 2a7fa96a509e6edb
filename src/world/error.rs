//! Why the world rejects a change.

use thiserror::Error;

/// A change that cannot be made; the world is left as it was.
#[derive(Clone, Debug, PartialEq, Error)]
pub(crate) enum WorldError {
    /// There is no object with that name.
    #[error("there is no object named {name}{}", suggestion(.closest))]
    UnknownObject {
        /// The requested name.
        name: String,
        /// The most similar name.
        closest: Option<String>,
    },
    /// There is no type with that name in the object library.
    #[error("there is no object type {name}{}", suggestion(.closest))]
    UnknownType {
        /// The requested type.
        name: String,
        /// The most similar type.
        closest: Option<String>,
    },
    /// The kitchen has no movable joint with that name.
    #[error("the kitchen has no moving joint {name}{}", suggestion(.closest))]
    UnknownKitchenJoint {
        /// The requested joint.
        name: String,
        /// The most similar joint.
        closest: Option<String>,
    },
    /// The object has no solid part, so it cannot be placed anywhere.
    #[error("an object of type {type_name} has no solid part")]
    NoSolid {
        /// Type of the object.
        type_name: String,
    },
    /// A number is infinite or not a number, or a mass is not positive.
    #[error("{quantity} of {name} is {value}, which cannot be")]
    ImpossibleNumber {
        /// The quantity that the number gives.
        quantity: &'static str,
        /// The thing that it belongs to.
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
