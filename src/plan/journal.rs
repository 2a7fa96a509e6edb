//! A journal of changes in the states of tasks, for followers of a session. Nothing depends on it.

use std::cell::RefCell;
use std::collections::VecDeque;

use super::task::{Status, TaskId};
use crate::lisp::value::Value;

/// Maximum number of entries kept until they are fetched; the oldest are discarded first.
const MOST_ENTRIES: usize = 20_000;

/// A task that has begun, or whose status has changed.
#[derive(Clone)]
pub(crate) struct TaskChange {
    /// Which task.
    pub(crate) id: TaskId,
    /// The task that started it; `None` if it was started from the prompt.
    pub(crate) parent: Option<TaskId>,
    /// Its name.
    pub(crate) name: String,
    /// Its new status.
    pub(crate) status: Status,
    /// The failure with which it ended.
    pub(crate) failure: Option<Value>,
    /// Simulated time (s).
    pub(crate) time: f64,
}

/// A list of changes, if the journal is kept.
#[derive(Default)]
pub(super) struct Journal {
    entries: RefCell<Option<VecDeque<TaskChange>>>,
}

impl Journal {
    pub(super) fn begin(&self) {
        self.entries.borrow_mut().get_or_insert_default();
    }

    pub(super) fn is_kept(&self) -> bool {
        self.entries.borrow().is_some()
    }

    pub(super) fn note(&self, change: TaskChange) {
        if let Some(entries) = self.entries.borrow_mut().as_mut() {
            if entries.len() >= MOST_ENTRIES {
                entries.pop_front();
            }
            entries.push_back(change);
        }
    }

    pub(super) fn fetch(&self) -> Vec<TaskChange> {
        match self.entries.borrow_mut().as_mut() {
            Some(entries) => std::mem::take(entries).into(),
            None => Vec::new(),
        }
    }
}
