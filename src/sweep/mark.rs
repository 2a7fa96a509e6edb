//! What came of a submission in one world of a lesson.

use serde::{Deserialize, Serialize};

use super::Record;

/// What came of a submission in one world of a lesson. Its steps are the record's expectations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mark {
    /// What came of the world.
    pub record: Record,
    /// Why it was not passed, as one sentence; empty if it was.
    pub why: String,
    /// The line of the submission at which it ended, as `FILE:LINE`.
    pub line: Option<String>,
    /// The first part of what it printed.
    pub printed: String,
}

impl Mark {
    /// Whether the submission has done in this world what was asked for.
    pub fn is_passed(&self) -> bool {
        self.record.is_success()
    }
}
