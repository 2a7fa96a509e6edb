//! What those who follow a session get to see and hear: frames of the world, and what
//! happens beside it.
//!
//! A [`Follower`] is told of every step. A [`FrameBuilder`] makes of that a [`Frame`], small and
//! free of the world's own types, with [`Node`]s for what is at places in it. Nothing here
//! changes the world, and no result depends on whether anybody follows.

mod frame;
mod frame_builder;
pub(crate) mod live;
mod node;
pub(crate) mod recording;
mod trajectory_lines;
mod watch_event;

pub(crate) use frame::{Frame, Hit, Hold, Path, Placed};
pub(crate) use frame_builder::FrameBuilder;
pub(crate) use node::{Kind, Node, Vertex, VisualMesh};
pub(crate) use watch_event::{TaskId, TaskNews, TaskState, WatchEvent};

use crate::motion::PlannedTrajectory;
use crate::spatial::Pose;
use crate::world::{CollisionHit, World};

/// The world as it is now, with what is shown beside it.
#[derive(Clone, Copy)]
pub(crate) struct Observation<'a> {
    /// Simulated time (s) since the session began.
    pub(crate) time: f64,
    /// The world.
    pub(crate) world: &'a World,
    /// Coordinate axes that somebody wants to see: where, and how long (m).
    pub(crate) axes: Option<(Pose, f64)>,
    /// The trajectories of motions under way, each with a number that tells it from others.
    pub(crate) trajectories: &'a [(u64, PlannedTrajectory<'a>)],
}

/// Why somebody is told of the world.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Cause {
    /// A step of the world has passed.
    Step,
    /// Time passes while nothing moves, as slowly as somebody wants to see it.
    Wait,
    /// A function may have changed the world while no time passed.
    Edit,
    /// The evaluation of a form has ended.
    Rest,
}

/// Somebody who follows a session. Must return soon: the session waits.
pub(crate) trait Follower {
    /// The world has changed, or may have.
    fn see(&mut self, observation: &Observation<'_>, cause: Cause);

    /// Something happened at a simulated time (s).
    fn hear(&mut self, time: f64, event: &WatchEvent);

    /// A motion failed at a simulated time (s) because these would touch.
    fn collide(&mut self, time: f64, hit: &CollisionHit);
}
