//! Where things and the robot could be: poses that fulfil a symbolic description, found in the
//! world as it is.
//!
//! A [`Query`] says what is wanted, a [`Stream`] gives one pose after another that fulfils it. A
//! map of the floor or of a surface, a product of functions of x and y, says where to try; what is
//! offered has passed exact tests: an object stands where it is put and touches nothing, a base
//! pose is free of collisions, the hands reach the target, the camera sees it. When nothing is
//! left, the stream can tell why. Nothing here knows of the plan language.

mod base_query;
mod base_search;
mod base_walk;
mod behind;
mod constraint;
mod costmap;
mod draw;
mod furniture;
mod offered;
mod orientation;
mod out_of_reach;
mod place_query;
mod place_search;
mod reach;
mod sight;
mod stream;
mod support;
mod tally;

pub use base_query::{BaseQuery, Distances, Item, Target};
pub use behind::container_before;
pub use constraint::{Beside, Constraint, Direction, Relation};
pub use furniture::{Container, UnknownFurniture, container_of, containers, link_named, surfaces};
pub use orientation::Orientation;
pub use out_of_reach::OutOfReach;
pub use place_query::{Level, PlaceQuery, Position, What};
pub use stream::{Query, Scene, Stream};
pub use support::Support;
