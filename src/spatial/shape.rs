//! Shapes that robots, furniture and objects are made of.

use std::sync::Arc;

use super::{Polyhedron, Pose};

/// A shape in its own frame. All but [`Mesh`](Shape::Mesh) are convex solids.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A box centred on the origin; full edge lengths (m) along x, y, z.
    Box {
        /// Edge lengths (m).
        size: [f64; 3],
    },
    /// A cylinder centred on the origin, its axis along z.
    Cylinder {
        /// Radius (m).
        radius: f64,
        /// Length along z (m).
        length: f64,
    },
    /// A sphere centred on the origin.
    Sphere {
        /// Radius (m).
        radius: f64,
    },
    /// A convex body, which a triangle mesh was taken apart into.
    Hull(Arc<Polyhedron>),
    /// A surface for the eye only: it need be neither convex nor closed.
    Mesh(Arc<Polyhedron>),
}

impl Shape {
    /// Radius (m) of the ball around the origin that holds the solid.
    pub fn bounding_radius(&self) -> f64 {
        match self {
            Self::Box { size: [x, y, z] } => libm::hypot(libm::hypot(*x, *y), *z) / 2.0,
            Self::Cylinder { radius, length } => libm::hypot(*radius, length / 2.0),
            Self::Sphere { radius } => *radius,
            Self::Hull(body) | Self::Mesh(body) => body.bounding_radius(),
        }
    }
}

/// A shape with its pose in the frame of the link or object that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedShape {
    /// The solid.
    pub shape: Shape,
    /// Pose of the solid's frame in the frame of its owner.
    pub pose: Pose,
    /// Linear colour, red green blue alpha in 0..1, if the source gives one.
    pub color: Option<[f32; 4]>,
}
