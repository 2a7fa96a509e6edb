//! What those who follow a session get to see and hear: moments of the world, and what
//! happens beside it.
//!
//! A [`Follower`] is told of every step. A [`Witness`] makes of that a [`Moment`], small and
//! free of the world's own types, with [`Node`]s for what is at places in it. Nothing here
//! changes the world, and no result depends on whether anybody follows.

mod happening;
pub(crate) mod live;
mod moment;
mod node;
mod path;
pub(crate) mod recording;
mod witness;

pub(crate) use happening::{Happening, TaskId, TaskNews, TaskState};
pub(crate) use moment::{Hit, Hold, Moment, Path, Placed};
pub(crate) use node::{Kind, Node, Vertex, VisualMesh};
pub(crate) use witness::Witness;

use crate::motion::PlannedWay;
use crate::spatial::Pose;
use crate::world::{CollisionHit, World};

/// The world as it is now, with what is shown beside it.
#[derive(Clone, Copy)]
pub(crate) struct Seen<'a> {
    /// Simulated time (s) since the session began.
    pub(crate) time: f64,
    /// The world.
    pub(crate) world: &'a World,
    /// Coordinate axes that somebody wants to see: where, and how long (m).
    pub(crate) axes: Option<(Pose, f64)>,
    /// The ways of motions under way, each with a number that tells it from others.
    pub(crate) ways: &'a [(u64, PlannedWay<'a>)],
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
    fn see(&mut self, seen: &Seen<'_>, cause: Cause);

    /// Something happened at a simulated time (s).
    fn hear(&mut self, time: f64, happening: &Happening);

    /// A motion failed at a simulated time (s) because these would touch.
    fn collide(&mut self, time: f64, hit: &CollisionHit);
}
