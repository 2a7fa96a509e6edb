//! The description of a place for the robot.

use super::furniture::Container;
use crate::motion::HeldGrip;
use crate::robot::Side;
use spatial::Pose;

/// What is to be reached or seen.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// An object where it is, by its name in the world.
    Object(String),
    /// An object of the world, imagined at the target's pose.
    Moved(String),
    /// Something of a type, imagined at the target's pose.
    Kind(String),
    /// The handle of a drawer or door, which is to be opened or closed.
    Handle {
        /// What is to be opened or closed.
        container: Container,
        /// The wanted position (m or rad) of its joint.
        position: f64,
    },
    /// Only the place.
    Point,
}

/// What is to be reached or seen, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// What.
    pub item: Item,
    /// Where, in the map frame.
    pub pose: Pose,
    /// The target as reports name it.
    pub name: String,
}

/// How far (m) the base may be from the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distances {
    /// Least and greatest distance of something to be reached.
    pub reach: [f64; 2],
    /// Maximum distance of something to be seen.
    pub sight: f64,
}

impl Default for Distances {
    fn default() -> Self {
        Self {
            reach: [0.2, 1.05],
            sight: 2.0,
        }
    }
}

/// A base pose from which something is within reach or in sight.
#[derive(Clone, Debug, PartialEq)]
pub struct BaseQuery {
    /// The target.
    pub target: Target,
    /// The arms one of which must reach it; `None` if it need not be reached.
    pub arms: Option<Vec<Side>>,
    /// The grasps by which it may be held; `None` for all that are known.
    pub grasps: Option<Vec<String>>,
    /// How a hand holds it, if it is to be put down at the target.
    pub held: Option<Box<HeldGrip>>,
    /// Whether the camera must see it.
    pub sees: bool,
    /// How far away it may be.
    pub distances: Distances,
    /// Where the robot is (m, map frame): places near there are tried first.
    pub from: [f64; 2],
}
