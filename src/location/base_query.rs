//! The description of a place for the robot.

use super::furniture::Container;
use crate::motion::HeldGrip;
use crate::robot::Side;
use crate::spatial::Pose;

/// What is to be reached or seen.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Item {
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
pub(crate) struct Target {
    /// What.
    pub(crate) item: Item,
    /// Where, in the map frame.
    pub(crate) pose: Pose,
    /// The target as reports name it.
    pub(crate) name: String,
}

/// How far (m) the base may be from the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Distances {
    /// Least and greatest distance of something to be reached.
    pub(crate) reach: [f64; 2],
    /// Greatest distance of something to be seen.
    pub(crate) sight: f64,
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
pub(crate) struct BaseQuery {
    /// The target.
    pub(crate) target: Target,
    /// The arms one of which must reach it; `None` if it need not be reached.
    pub(crate) arms: Option<Vec<Side>>,
    /// The grasps by which it may be held; `None` for all that are known.
    pub(crate) grasps: Option<Vec<String>>,
    /// How a hand holds it, if it is to be put down at the target.
    pub(crate) held: Option<Box<HeldGrip>>,
    /// Whether the camera must see it.
    pub(crate) sees: bool,
    /// How far away it may be.
    pub(crate) distances: Distances,
    /// Where the robot is (m, map frame): places near there are tried first.
    pub(crate) from: [f64; 2],
}
