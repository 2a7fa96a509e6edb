//! What is visible: the surfaces of kitchen, robot and objects at their current poses, the
//! floor, and the coordinate axes that the user wants to see.
//!
//! All renderers draw this one description: a body is a surface in its own frame, a pose, a
//! colour and a name. Surfaces are shared, so a renderer that keeps them needs only the poses
//! of the next scene.

use std::sync::Arc;

use nalgebra::Vector3;

use super::surface::Surface;
use spatial::{PlacedShape, Pose, Shape};

/// Thickness of coordinate axes as a share of their length.
const AXIS_THICKNESS: f64 = 0.04;

/// How a surface reflects light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Scatters light evenly.
    Matt,
    /// With a faint reflection of the lamp.
    Satin,
    /// With a clear reflection of the lamp.
    Gloss,
    /// Floor boards: cast no shadow and fade into the background with distance.
    Boards,
}

/// The kind of thing that a body is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// The floor.
    Floor,
    /// The kitchen; the name is a link's.
    Furniture,
    /// The robot; the name is a link's.
    Robot,
    /// An object; the name is the one with which it was spawned.
    Object,
    /// Something that only users see, such as coordinate axes.
    Sign,
}

/// The thing that a body is part of.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Owner {
    /// Its kind.
    pub kind: Kind,
    /// Its name, unique among things of the same kind.
    pub name: Arc<str>,
}

impl Owner {
    /// The thing of this kind and name.
    pub fn new(kind: Kind, name: &str) -> Self {
        let name = name.into();
        Self { kind, name }
    }
}

/// A surface with its pose and colour.
#[derive(Clone, Debug)]
pub struct Body {
    /// The thing that it is part of. A thing may have several bodies.
    pub owner: Owner,
    /// The surface in its own frame; the same allocation for as long as it does not change.
    pub surface: Arc<Surface>,
    /// Pose of that frame in the map frame.
    pub pose: Pose,
    /// Linear colour, red green blue alpha in 0..1.
    pub color: [f32; 4],
    /// How it reflects light.
    pub finish: Finish,
}

/// Everything to be drawn.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The bodies; the order matters only between surfaces at exactly the same place.
    pub bodies: Vec<Body>,
}

impl Scene {
    /// Adds coordinate axes with bars of the length (m): x red, y green, z blue.
    pub fn add_axes(&mut self, pose: &Pose, length: f64) {
        let thickness = length * AXIS_THICKNESS;
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let mut size = [thickness; 3];
            size[axis] = length;
            let mut color = [0.02, 0.02, 0.02, 1.0];
            color[axis] = 0.7;
            let mut middle = Vector3::zeros();
            middle[axis] = length / 2.0;
            let placed = PlacedShape {
                shape: Shape::Box { size },
                pose: Pose::translation(middle.x, middle.y, middle.z),
                color: None,
            };
            self.bodies.push(Body {
                owner: Owner::new(Kind::Sign, name),
                surface: Arc::new(Surface::of(&placed.shape, 0.0)),
                pose: pose * placed.pose,
                color,
                finish: Finish::Matt,
            });
        }
    }
}
