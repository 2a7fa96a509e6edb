//! Geometry that every layer shares: poses, shapes and trigonometry that is the
//! same on every platform.
//!
//! Lengths are metres, angles radians, quaternions x y z w. Nothing here knows of
//! robots, worlds or the plan language.

pub(crate) mod pose;
pub(crate) mod shape;
pub(crate) mod trig;

pub use pose::Pose;
pub(crate) use shape::{PlacedShape, Shape};
