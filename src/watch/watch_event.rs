//! What happens in a session besides motion.

use super::halt::Halt;

/// Identifies a task or a motion of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum TaskId {
    /// A task of a plan, by its number.
    Task(u64),
    /// A motion that a task waits for, by its number.
    Motion(u64),
}

/// An event of a session.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum WatchEvent {
    /// Text was printed, not necessarily whole lines.
    Output(String),
    /// An evaluation does not go on: it has stopped or ended at a condition or an interrupt.
    Halted(Halt),
    /// The session goes on after a halt.
    Resumed,
    /// A task began, or its state changed.
    Task(TaskNews),
}

/// A change in the state of a task.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TaskNews {
    /// Which task.
    pub(crate) id: TaskId,
    /// The task that started it; `None` if the prompt did.
    pub(crate) parent: Option<TaskId>,
    /// The name that users see.
    pub(crate) name: String,
    /// Its new state.
    pub(crate) state: TaskState,
    /// Why it failed or stopped; empty otherwise.
    pub(crate) failure: String,
}

/// The state of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TaskState {
    /// It runs or waits.
    Running,
    /// It is suspended.
    Suspended,
    /// It stands still at an unhandled condition, or waits for a task that does.
    Stopped,
    /// It has succeeded.
    Succeeded,
    /// It has failed.
    Failed,
    /// It was evaporated: another task made it end.
    Evaporated,
}

impl TaskState {
    /// All states.
    pub(crate) const ALL: [Self; 6] = [
        Self::Running,
        Self::Suspended,
        Self::Stopped,
        Self::Succeeded,
        Self::Failed,
        Self::Evaporated,
    ];

    /// Name of the state.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Suspended => "suspended",
            Self::Stopped => "stopped",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Evaporated => "evaporated",
        }
    }

    /// The state with this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.name() == name)
    }
}
