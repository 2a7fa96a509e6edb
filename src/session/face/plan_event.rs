//! What observers of a session are told.

use std::sync::Arc;

use robotics::robot::Side;
use view::watch::{About, TaskId, TaskState};

/// Something that has happened in a session.
#[derive(Clone, PartialEq, Debug)]
pub struct PlanEvent {
    /// Simulated time (s) since the session began.
    pub time: f64,
    /// What has happened.
    pub kind: PlanEventKind,
}

/// What has happened.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum PlanEventKind {
    /// The program has printed text, or a log line; not necessarily whole lines.
    Printed(String),
    /// A task, an action or a motion has begun.
    Began(TaskBegin),
    /// A task has been suspended.
    Suspended(TaskId),
    /// A task that was suspended goes on.
    Continued(TaskId),
    /// A task, an action or a motion has ended.
    Ended(TaskEnd),
    /// A hand holds an object from now on.
    Held {
        /// The object's name.
        object: String,
        /// The hand.
        side: Side,
    },
    /// A hand holds an object no more: it was put down, or has slipped.
    Released {
        /// The object's name.
        object: String,
        /// The hand.
        side: Side,
    },
    /// Two bodies were, or would have been, in each other, so that a motion has failed: their names.
    Collided([String; 2]),
}

/// The begin of a task, an action or a motion.
#[derive(Clone, PartialEq, Debug)]
pub struct TaskBegin {
    /// Which; it also tells whether it is a task, an action or a motion.
    pub id: TaskId,
    /// What has started it; `None` if it was started from outside a plan.
    pub parent: Option<TaskId>,
    /// The name of the task, or the type of the action or motion.
    pub name: String,
    /// What the designator of an action or motion says, and where it is performed.
    pub about: Option<Arc<About>>,
}

/// The end of a task, an action or a motion.
#[derive(Clone, PartialEq, Debug)]
pub struct TaskEnd {
    /// Which.
    pub id: TaskId,
    /// The name of the task, or the type of the action or motion.
    pub name: String,
    /// How it has ended: it has succeeded or failed, or was evaporated.
    pub state: TaskState,
    /// The class of its failure and the report, if it has failed.
    pub failure: Option<(String, String)>,
    /// What an action has returned, as text; empty otherwise.
    pub result: String,
}
