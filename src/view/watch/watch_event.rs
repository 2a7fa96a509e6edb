//! What happens in a session besides motion.

use std::sync::Arc;

use super::halt::Halt;

/// Identifies a task, an action or a motion of a session.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TaskId {
    /// A task of a plan, by its number.
    Task(u64),
    /// An action that a task performs, by its number.
    Action(u64),
    /// A motion that a task waits for, by its number.
    Motion(u64),
}

impl TaskId {
    /// The number with a letter for its kind: `t`, `a` or `m`.
    pub fn text(self) -> String {
        match self {
            Self::Task(number) => format!("t{number}"),
            Self::Action(number) => format!("a{number}"),
            Self::Motion(number) => format!("m{number}"),
        }
    }

    /// What has that text.
    pub fn of_text(text: &str) -> Option<Self> {
        let (kind, number) = text.split_at_checked(1)?;
        let number = number.parse().ok()?;
        match kind {
            "t" => Some(Self::Task(number)),
            "a" => Some(Self::Action(number)),
            "m" => Some(Self::Motion(number)),
            _ => None,
        }
    }
}

/// An event of a session.
#[derive(Clone, Debug, PartialEq)]
pub enum WatchEvent {
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
pub struct TaskNews {
    /// Which task.
    pub id: TaskId,
    /// The task that started it; `None` if the prompt did.
    pub parent: Option<TaskId>,
    /// The name that users see.
    pub name: String,
    /// Its new state.
    pub state: TaskState,
    /// Why it failed or stopped; empty otherwise.
    pub failure: String,
    /// The class of that failure; empty otherwise, and where it is not known, as in recordings.
    pub class: String,
    /// What it returned, as text; empty for what is not an action.
    pub result: String,
    /// What it is, told when it begins; `None` for what is only a task.
    pub about: Option<Arc<About>>,
}

/// What an action or a motion is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct About {
    /// The keys of its designator in lower case, with their values as text.
    pub keys: Vec<(String, String)>,
    /// `FILE:LINE:COLUMN` where it is performed; empty if that is not known.
    pub place: String,
    /// The text of that line.
    pub line: String,
    /// The process module that carries it out, if it is a motion; empty otherwise.
    pub module: String,
}

/// The state of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskState {
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
    pub const ALL: [Self; 6] = [
        Self::Running,
        Self::Suspended,
        Self::Stopped,
        Self::Succeeded,
        Self::Failed,
        Self::Evaporated,
    ];

    /// Name of the state.
    pub fn name(self) -> &'static str {
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
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.name() == name)
    }
}
