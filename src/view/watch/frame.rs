//! What the world looks like at one time.

use std::sync::Arc;

use nalgebra::{Quaternion, Translation3, UnitQuaternion};

use spatial::Pose;

/// What the world looks like at one time. Everything is in the map frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Simulated time (s) since the session began.
    pub time: f64,
    /// Poses of the nodes that can move, in order of their numbers. Objects not listed here are
    /// not in the world.
    pub placed: Vec<Placed>,
    /// Objects in the robot's hands.
    pub holds: Vec<Hold>,
    /// What presses on objects, in order of the objects.
    pub presses: Vec<Press>,
    /// What stopped motions lately.
    pub hits: Vec<Hit>,
    /// Coordinate axes that the user wants to see, and their length (m).
    pub axes: Option<(Placed, f32)>,
    /// Planned paths of the motions under way.
    pub paths: Arc<[Path]>,
    /// Positions (rad or m) of the robot's actuated joints, in the order of its tree, then those
    /// of the kitchen's.
    pub joints: Arc<[f64]>,
}

/// The pose of a node.
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
    /// The node with this pose.
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

impl Placed {
    /// The same pose as seen from another one.
    pub(crate) fn seen_from(&self, other: &Placed) -> Placed {
        Placed::new(self.node, &(other.pose().inverse() * self.pose()))
    }

    /// The pose in the map, if this is one as seen from another one.
    pub fn carried_by(&self, other: &Placed) -> Placed {
        Placed::new(self.node, &(other.pose() * self.pose()))
    }

    fn pose(&self) -> Pose {
        let [x, y, z] = self.at.map(f64::from);
        let [i, j, k, w] = self.turn.map(f64::from);
        let turn = UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k));
        Pose::from_parts(Translation3::new(x, y, z), turn)
    }
}

/// An object in one of the robot's hands.
#[derive(Clone, Debug, PartialEq)]
pub struct Hold {
    /// Node of the object.
    pub object: u32,
    /// Name of the link that holds it.
    pub link: Arc<str>,
    /// The force (N) that the grip transmits.
    pub force: f32,
}

/// A place at which a body presses on an object.
#[derive(Clone, Debug, PartialEq)]
pub struct Press {
    /// Node of the body; `None` for the floor.
    pub body: Option<u32>,
    /// Node of the object.
    pub object: u32,
    /// Where (m).
    pub at: [f32; 3],
    /// The normal force on the object (N).
    pub force: [f32; 3],
}

/// What stopped a motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// Nodes of the two bodies, for those that are nodes.
    pub nodes: Vec<u32>,
    /// A point (m) between them.
    pub at: [f32; 3],
}

/// A path as a polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// What moves: `base`, `left` or `right`.
    pub what: &'static str,
    /// The node in whose frame the points are; `None` for the map.
    pub frame: Option<u32>,
    /// Points (m).
    pub points: Vec<[f32; 3]>,
}

impl Path {
    /// What can have a path.
    pub(crate) const WHAT: [&'static str; 3] = ["base", "left", "right"];
}

impl Frame {
    /// Approximate size in bytes.
    pub fn bytes(&self) -> usize {
        size_of::<Self>()
            + self.placed.len() * size_of::<Placed>()
            + self.joints.len() * size_of::<f64>()
            + self.holds.len() * size_of::<Hold>()
            + self.hits.len() * size_of::<Hit>()
            + self.presses.len() * size_of::<Press>()
    }
}
