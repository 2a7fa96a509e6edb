//! Things that have a pose: links of the robot, pieces of furniture, objects.

use std::sync::Arc;

use nalgebra::Vector3;

use super::frame::Placed;
use crate::picture::scene::{Finish, Scene};
use spatial::PlacedShape;

/// The type of the node that shows the map of a location: no thing in the world.
pub(crate) const MAP_OF_LOCATION: &str = "map of a location";

/// The type of the node that shows one of many grains: no thing in the world.
pub(crate) const GRAIN: &str = "grain";

/// The kind of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A link of the robot.
    Robot,
    /// A link of the kitchen.
    Furniture,
    /// An object.
    Object,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Robot, Self::Furniture, Self::Object];

    /// Name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Robot => "robot",
            Self::Furniture => "furniture",
            Self::Object => "object",
        }
    }
}

/// A thing that has a pose. Never changes once it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its number, counted from zero in the order in which the nodes became known.
    pub id: u32,
    /// Its name; an object's is unique among the objects that are in the world at the same
    /// time.
    pub name: String,
    /// Its kind.
    pub kind: Kind,
    /// Type of an object in the object library; empty for other nodes.
    pub type_name: String,
    /// The node that carries it: the nearest link above it that is a node. `None` for roots and
    /// objects, which are in the map.
    pub parent: Option<u32>,
    /// Its pose, if it cannot move.
    pub still: Option<Placed>,
    /// Its mesh in its own frame; empty for a bare frame. Nodes that look the same share it.
    pub mesh: Arc<VisualMesh>,
    /// The shapes that it consists of, with their colours; none if these are not known.
    pub shapes: Arc<[PlacedShape]>,
}

/// A corner of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Vertex {
    /// Position (m).
    pub at: [f32; 3],
    /// Unit normal.
    pub normal: [f32; 3],
    /// Linear colour, red green blue alpha in 0..1.
    pub color: [f32; 4],
    /// How clearly it reflects the lamp, 0..1.
    pub(crate) gloss: f32,
}

/// A coloured mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct VisualMesh {
    /// Corners.
    pub(crate) vertices: Vec<Vertex>,
    /// Triangles as indices into `vertices`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl VisualMesh {
    /// All bodies of a scene as one mesh.
    pub fn of(scene: &Scene) -> Self {
        let mut mesh = Self::default();
        for body in &scene.bodies {
            // A mesh of four billion corners does not fit into memory.
            let first = u32::try_from(mesh.vertices.len()).unwrap_or(u32::MAX);
            let gloss = match body.finish {
                Finish::Matt | Finish::Boards => 0.0,
                Finish::Satin => 0.4,
                Finish::Gloss => 1.0,
            };
            let single = |v: Vector3<f64>| [v.x as f32, v.y as f32, v.z as f32];
            mesh.vertices
                .extend(body.surface.corners.iter().map(|corner| Vertex {
                    at: single((body.pose * corner.point).coords),
                    normal: single(body.pose.rotation * corner.normal),
                    color: body.color,
                    gloss,
                }));
            let triangles = body.surface.triangles.iter();
            mesh.triangles
                .extend(triangles.map(|t| t.map(|i| i.saturating_add(first))));
        }
        mesh
    }
}
