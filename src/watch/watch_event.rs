//! What happens in a session beside movement.

/// Tells tasks and motions of a session apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum TaskId {
    /// A task of a plan, by its number.
    Task(u64),
    /// A motion that a task waits for, by its number.
    Motion(u64),
}

/// Something that happened.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum WatchEvent {
    /// Text was printed; not necessarily whole lines.
    Output(String),
    /// A condition that nobody handled ended an evaluation; its report.
    Aborted(String),
    /// A task began, or its state changed.
    Task(TaskNews),
}

/// What became of a task.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TaskNews {
    /// Which task.
    pub(crate) id: TaskId,
    /// The task that started it; none if the prompt did.
    pub(crate) parent: Option<TaskId>,
    /// How people call it.
    pub(crate) name: String,
    /// How it is now.
    pub(crate) state: TaskState,
    /// Why it failed; empty otherwise.
    pub(crate) failure: String,
}

/// How a task is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TaskState {
    /// It runs or waits.
    Running,
    /// It holds still.
    Suspended,
    /// It has ended well.
    Succeeded,
    /// It has ended with a failure.
    Failed,
    /// It was told to end.
    Evaporated,
}

impl TaskState {
    /// All states.
    pub(crate) const ALL: [Self; 5] = [
        Self::Running,
        Self::Suspended,
        Self::Succeeded,
        Self::Failed,
        Self::Evaporated,
    ];

    /// Name of the state.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Running => "running",
            Self::Suspended => "suspended",
            Self::Succeeded => "succeeded",
            Self::Failed => "failed",
            Self::Evaporated => "evaporated",
        }
    }

    /// The state of that name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|state| state.name() == name)
    }
}
