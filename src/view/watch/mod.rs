//! What the followers of a session receive: frames of the world, and events besides motion.
//!
//! A [`Follower`] is informed of every step. A [`FrameBuilder`] turns what it sees into a
//! [`Frame`], which is small and independent of the world's types, with a [`Node`] for each
//! thing that has a pose. Nothing here changes the world, and no result depends on whether
//! there are followers.

mod base64;
mod frame;
mod frame_builder;
mod halt;
pub mod http;
pub mod live;
mod node;
pub mod recording;
mod trajectory_lines;
mod watch_event;

pub use base64::base64;
pub use frame::{Frame, Hit, Hold, Path, Placed, Press};
pub use frame_builder::FrameBuilder;
pub use halt::{Halt, HaltKind};
pub(crate) use node::{GRAIN, MAP_OF_LOCATION, Vertex};
pub use node::{Kind, Node, VisualMesh};
pub use watch_event::{About, TaskId, TaskNews, TaskState, WatchEvent};

use std::sync::Arc;

use crate::picture::LocationMap;
use robotics::motion::PlannedTrajectory;
use robotics::world::{CollisionHit, World};
use spatial::Pose;

/// Length (m) of the arrow for a force of 1 N.
pub(crate) const FORCE_SCALE: f32 = 0.02;

/// The world as it is now, and what is shown with it.
#[derive(Clone, Copy)]
pub struct Observation<'a> {
    /// Simulated time (s) since the session began.
    pub time: f64,
    /// The world.
    pub world: &'a World,
    /// Coordinate axes that the user wants to see: their pose and length (m).
    pub axes: Option<(Pose, f64)>,
    /// The map of a symbolic location to be seen.
    pub location: Option<&'a Arc<LocationMap>>,
    /// The trajectories of motions under way, each with a number that identifies it.
    pub trajectories: &'a [(u64, PlannedTrajectory<'a>)],
}

/// Why a follower is shown the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// A step of the world has passed.
    Step,
    /// Time passes while nothing moves, no faster than the user wants to see it.
    Wait,
    /// A function may have changed the world while no time passed.
    Edit,
    /// The evaluation of a form has ended.
    Rest,
}

/// A follower of a session. Its methods must return soon, because the session waits.
pub trait Follower {
    /// The world has changed, or may have.
    fn see(&mut self, observation: &Observation<'_>, cause: Cause);

    /// Something happened at a simulated time (s).
    fn hear(&mut self, time: f64, event: &WatchEvent);

    /// A motion failed at a simulated time (s) because of this collision.
    fn collide(&mut self, time: f64, hit: &CollisionHit);
}
