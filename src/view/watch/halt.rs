//! Why a session does not go on.

/// Why a session does not go on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Halt {
    /// What has happened.
    pub kind: HaltKind,
    /// The class of the condition; empty for an interrupt, or if it is not known.
    pub class: String,
    /// The report of the condition.
    pub report: String,
    /// `FILE:LINE:COLUMN`; empty if it is not known.
    pub place: String,
    /// The ways to continue; each is chosen at the prompt by its index.
    pub choices: Vec<String>,
    /// Number of evaluations that have stopped, this one on top.
    pub level: usize,
}

/// What has happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HaltKind {
    /// A condition was not handled; the evaluation waits for a decision.
    Stopped,
    /// The user has interrupted the evaluation, which waits for a decision.
    Interrupted,
    /// A condition was not handled and has ended the evaluation.
    Aborted,
}

impl HaltKind {
    const ALL: [Self; 3] = [Self::Stopped, Self::Interrupted, Self::Aborted];

    /// Name of the kind.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stopped => "stopped",
            Self::Interrupted => "interrupted",
            Self::Aborted => "aborted",
        }
    }

    /// The kind with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl Halt {
    /// A halt of which only the report is known.
    pub fn new(kind: HaltKind, report: String) -> Self {
        Self {
            kind,
            class: String::new(),
            report,
            place: String::new(),
            choices: Vec::new(),
            level: 0,
        }
    }
}
