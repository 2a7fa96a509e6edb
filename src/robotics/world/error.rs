//! Why the world rejects a change.

use thiserror::Error;

use super::map_area::MapArea;
use spatial::Shortest;

/// A change that cannot be made; the world is left as it was.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WorldError {
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
    /// An object of that name is of another type.
    #[error(
        "{name} is a {type_name}, and does not become a {wanted}: remove it first, or choose \
         another name"
    )]
    OtherType {
        /// Name of the object.
        name: String,
        /// Its type.
        type_name: String,
        /// The requested type.
        wanted: String,
    },
    /// Grains are filled into what has no room for so many, or is not upright.
    #[error("{name} is no open vessel that stands upright and has room for so many grains")]
    NoRoomForGrains {
        /// Name of the object.
        name: String,
    },
    /// There would be more grains than there may be.
    #[error("there would be more than {most} grains")]
    TooManyGrains {
        /// The most that there may be.
        most: usize,
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
    #[error("{quantity} of {name} is {}, which cannot be", Shortest(*.value))]
    ImpossibleNumber {
        /// The quantity that the number gives.
        quantity: &'static str,
        /// The thing that it belongs to.
        name: String,
        /// The number.
        value: f64,
    },
    /// A place is too far away.
    #[error(
        "{name} cannot be at ({} {} {}): the world ends {border} m from the map, which covers \
         {map}, and {border} m above and below the floor", Shortest(.place[0]), Shortest(.place[1]), Shortest(.place[2])
    )]
    BeyondTheWorld {
        /// The thing that was to be there.
        name: String,
        /// The place (m), in the map frame.
        place: [f64; 3],
        /// The map.
        map: MapArea,
        /// How far from the map the world extends (m).
        border: f64,
    },
}

fn suggestion(closest: &Option<String>) -> String {
    match closest {
        Some(name) => format!("; did you mean {name}?"),
        None => String::new(),
    }
}
