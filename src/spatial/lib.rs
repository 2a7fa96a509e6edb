//! Geometry shared by all layers: poses, shapes, and trigonometry with the same results on
//! every platform.
//!
//! Lengths are in metres, angles in radians; quaternions are x y z w. Nothing here knows of
//! robots, worlds or the plan language.

pub mod number;
pub mod polyhedron;
pub mod pose;
pub mod shape;
pub mod trig;

// What dependencies call of the C library's mathematics is linked from there.
use portable_math as _;

pub use number::Shortest;
pub use polyhedron::Polyhedron;
pub use pose::Pose;
pub use shape::{PlacedShape, Shape};
