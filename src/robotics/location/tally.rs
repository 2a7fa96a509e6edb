//! How many candidates were rejected for which cause.

use std::fmt;

use indexmap::IndexMap;

/// Causes with their counts.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    causes: IndexMap<String, u32>,
    has_given_up: bool,
    /// Whether any would have done but for want of sight.
    was_unseen: bool,
    /// Whether there is one candidate only.
    is_of_only_place: bool,
}

impl Tally {
    /// Counts one candidate.
    pub(super) fn add(&mut self, cause: impl Into<String>) {
        *self.causes.entry(cause.into()).or_default() += 1;
    }

    /// What is said of the only candidate that there is.
    pub(super) fn of_only_place(cause: impl Into<String>) -> Self {
        let mut tally = Self {
            is_of_only_place: true,
            ..Self::default()
        };
        tally.add(cause);
        tally
    }

    /// Whether there is one candidate only.
    pub(super) fn is_of_only_place(&self) -> bool {
        self.is_of_only_place
    }

    /// Notes that there are candidates that have not been tried.
    pub(super) fn give_up(&mut self) {
        self.has_given_up = true;
    }

    /// Notes that a candidate would have done if the target were in sight from there.
    pub(super) fn note_unseen(&mut self) {
        self.was_unseen = true;
    }

    /// Whether any would have done if the target were in sight from there.
    pub(super) fn was_unseen(&self) -> bool {
        self.was_unseen
    }

    /// Number of candidates.
    pub(super) fn total(&self) -> u32 {
        self.causes.values().sum()
    }
}

impl fmt::Display for Tally {
    /// The most frequent cause first: `22 touch the table, 8 do not see bottle-1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let (true, Some(cause)) = (self.is_of_only_place, self.causes.keys().next()) {
            return f.write_str(cause);
        }
        let mut causes: Vec<(&String, u32)> = self.causes.iter().map(|(c, n)| (c, *n)).collect();
        causes.sort_by_key(|(_, n)| std::cmp::Reverse(*n));
        for (i, (cause, n)) in causes.into_iter().enumerate() {
            let comma = if i == 0 { "" } else { ", " };
            write!(f, "{comma}{n} {cause}")?;
        }
        if self.has_given_up {
            f.write_str("; the others were not tried any more")?;
        }
        Ok(())
    }
}
