//! How the world looks at one time.

use std::sync::Arc;

use crate::spatial::Pose;

/// How the world looks at one time. Everything is in the map frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moment {
    /// Simulated time (s) since the session began.
    pub time: f64,
    /// Where the nodes are that can move, in order of their numbers. Objects that are not
    /// here are not in the world.
    pub placed: Vec<Placed>,
    /// Objects in the robot's hands.
    pub holds: Vec<Hold>,
    /// Nodes that press on one another, a link of the robot and an object.
    pub touching: Vec<[u32; 2]>,
    /// What lately stopped a motion.
    pub hits: Vec<Hit>,
    /// Coordinate axes that somebody wants to see, and their length (m).
    pub axes: Option<(Placed, f32)>,
    /// Ways of motions under way.
    pub paths: Arc<[Path]>,
    /// Positions (rad or m) of the robot's actuated joints, in the order of its tree.
    pub joints: Arc<[f64]>,
}

/// Where a node is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed {
    /// Number of the node.
    pub node: u32,
    /// Origin (m).
    pub at: [f32; 3],
    /// Unit quaternion x y z w.
    pub turn: [f32; 4],
}

impl Placed {
    /// The node at the pose.
    pub fn new(node: u32, pose: &Pose) -> Self {
        let q = pose.rotation.coords;
        let t = pose.translation.vector;
        Self {
            node,
            // Display needs no more than single precision.
            at: [t.x as f32, t.y as f32, t.z as f32],
            turn: [q.x as f32, q.y as f32, q.z as f32, q.w as f32],
        }
    }
}

/// An object in a hand.
#[derive(Clone, Debug, PartialEq)]
pub struct Hold {
    /// Node of the object.
    pub object: u32,
    /// Name of the link that holds it.
    pub link: Arc<str>,
}

/// What stopped a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// Nodes of the two bodies, as far as they have one.
    pub nodes: Vec<u32>,
    /// A point (m) between them.
    pub at: [f32; 3],
}

/// A way as a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// What moves: `base`, `left` or `right`.
    pub what: &'static str,
    /// The node in whose frame the points are; none for the map.
    pub frame: Option<u32>,
    /// Points (m).
    pub points: Vec<[f32; 3]>,
}

impl Path {
    /// What can have a way.
    pub const WHAT: [&'static str; 3] = ["base", "left", "right"];
}

impl Moment {
    /// About how many bytes it takes.
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.placed.len() * size_of::<Placed>()
            + self.joints.len() * size_of::<f64>()
            + self.holds.len() * size_of::<Hold>()
            + self.hits.len() * size_of::<Hit>()
    }
}
