//! What there is to be seen: the surfaces of kitchen, robot and objects where they are now,
//! the floor, and coordinate axes that somebody wants to see.
//!
//! This is the one description that every renderer draws: a body is a surface in its own
//! frame, a pose, a colour and a name. Surfaces are shared, so that a renderer that keeps
//! them needs only the poses of the next scene.

use std::sync::Arc;

use nalgebra::Vector3;

use super::looks;
use super::looks::Looks;
use super::surface::Surface;
use crate::robot::{KinematicTree, LinkId};
use crate::spatial::{PlacedShape, Pose, Shape};
use crate::world::{Object, World};

/// Thickness of coordinate axes as a share of their length.
const AXIS_THICKNESS: f64 = 0.04;

/// How a surface takes the light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Finish {
    /// Scatters light evenly.
    Matt,
    /// With a faint reflection of the lamp.
    Satin,
    /// With a clear reflection of the lamp.
    Gloss,
    /// Floor boards; casts no shadow and fades into the background far away.
    Boards,
}

/// What kind of thing a body is a part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Kind {
    /// The floor.
    Floor,
    /// The kitchen; the name is that of a link.
    Furniture,
    /// The robot; the name is that of a link.
    Robot,
    /// An object; the name is that under which it was spawned.
    Object,
    /// Something that only people see, such as coordinate axes.
    Sign,
}

/// Whose part a body is.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Owner {
    /// What kind of thing.
    pub(crate) kind: Kind,
    /// Its name, which is unique among those of the same kind.
    pub(crate) name: Arc<str>,
}

impl Owner {
    /// A thing of the kind with the name.
    pub(crate) fn new(kind: Kind, name: &str) -> Self {
        let name = name.into();
        Self { kind, name }
    }
}

/// A surface with its place and colour.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    /// Whose part it is. A thing may have several bodies.
    pub(crate) owner: Owner,
    /// The surface in its own frame; the same allocation as long as it does not change.
    pub(crate) surface: Arc<Surface>,
    /// Pose of that frame in the map frame.
    pub(crate) pose: Pose,
    /// Linear colour, red green blue alpha in 0..1.
    pub(crate) color: [f32; 4],
    /// How it takes the light.
    pub(crate) finish: Finish,
}

/// Everything that is to be drawn.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scene {
    /// The bodies; the order decides only between surfaces at exactly the same place.
    pub(crate) bodies: Vec<Body>,
}

impl Scene {
    /// The world as it is now. Whoever draws it again and again keeps the [`Looks`].
    pub(crate) fn of(world: &World) -> Self {
        Looks::of(world.models()).scene(world)
    }

    /// What is seen of a link, in the link's frame.
    pub(crate) fn of_link(tree: &KinematicTree, link: LinkId, is_robot: bool) -> Self {
        let kind = if is_robot {
            Kind::Robot
        } else {
            Kind::Furniture
        };
        looks::link_scene(tree, link, kind)
    }

    /// What is seen of an object, in its own frame.
    pub(crate) fn of_object(object: &Object) -> Self {
        looks::object_scene(object)
    }

    /// Adds coordinate axes with bars of the length (m): x red, y green, z blue.
    pub(crate) fn add_axes(&mut self, pose: &Pose, length: f64) {
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
