//! The description of a place for a thing.

use super::constraint::Constraint;
use super::orientation::Orientation;
use super::support::Support;

/// What is to be put down.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum What {
    /// Nothing: a point is wanted.
    Point,
    /// An object, by its name in the world.
    Object(String),
    /// Something of a type, by its name in the library.
    Kind(String),
}

/// A place on a support.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlaceQuery {
    /// What it is on.
    pub(crate) support: Support,
    /// How high (m) above what carries it, if it is not on it.
    pub(crate) above: Option<f64>,
    /// What else is demanded.
    pub(crate) constraints: Vec<Constraint>,
    /// What the place is for.
    pub(crate) what: What,
    /// How that is turned.
    pub(crate) orientation: Orientation,
}
