//! What becomes of tasks, noted for those who follow a session. Nothing depends on it.

use std::cell::RefCell;
use std::collections::VecDeque;

use super::task::{Status, TaskId};
use crate::lisp::value::Value;

/// Entries that are kept until somebody fetches them; the oldest are forgotten first.
const MOST_ENTRIES: usize = 20_000;

/// A task that began, or whose status changed.
#[derive(Clone)]
pub(crate) struct TaskChange {
    /// Which task.
    pub(crate) id: TaskId,
    /// The task that started it; none if the prompt did.
    pub(crate) parent: Option<TaskId>,
    /// Its name.
    pub(crate) name: String,
    /// Its status now.
    pub(crate) status: Status,
    /// The failure that it ended with.
    pub(crate) failure: Option<Value>,
    /// Simulated time (s).
    pub(crate) time: f64,
}

/// A list of changes, if anybody wants one.
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
