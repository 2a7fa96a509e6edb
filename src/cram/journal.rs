//! A journal of what happens in plans, for followers of a session: tasks, and the actions that
//! they perform. Nothing depends on it.

use std::cell::{Cell, Ref, RefCell};
use std::collections::{BTreeMap, VecDeque};

use super::task::{Status, TaskId};
use super::trace::Trace;
use lisp::source::Place;
use lisp::value::Value;

/// Maximum number of entries kept until they are fetched; the oldest are discarded first.
const MAX_ENTRIES: usize = 20_000;

/// Identifies an action that is or was performed.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct ActionId(pub u64);

/// What starts a task, an action or a motion.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Starter {
    /// A task.
    Task(TaskId),
    /// An action that a task performs.
    Action(ActionId),
}

/// An entry of the journal.
#[derive(Clone)]
pub enum Change {
    /// A task has begun, or its status has changed.
    Task(TaskChange),
    /// An action has begun.
    Begun(BegunAction),
    /// An action has ended.
    Ended(EndedAction),
}

/// A task that has begun, or whose status has changed.
#[derive(Clone)]
pub struct TaskChange {
    /// Which task.
    pub id: TaskId,
    /// What started it; `None` if it was started from the prompt.
    pub starter: Option<Starter>,
    /// Its name.
    pub name: String,
    /// Its new status.
    pub status: Status,
    /// The failure with which it ended.
    pub failure: Option<Value>,
    /// Simulated time (s).
    pub time: f64,
}

/// An action that has begun.
#[derive(Clone)]
pub struct BegunAction {
    /// Which action.
    pub id: ActionId,
    /// What performs it.
    pub starter: Option<Starter>,
    /// Its designator.
    pub designator: Value,
    /// Where it is performed.
    pub place: Place,
    /// Simulated time (s).
    pub time: f64,
}

/// An action that has ended.
#[derive(Clone)]
pub struct EndedAction {
    /// What it was.
    pub begun: BegunAction,
    /// How it has ended.
    pub end: ActionEnd,
    /// Simulated time (s).
    pub time: f64,
}

/// How an action has ended.
#[derive(Clone)]
pub enum ActionEnd {
    /// With a value.
    Succeeded(Value),
    /// With a failure.
    Failed(Value),
    /// Its task was told to end, or its plan was left otherwise.
    Evaporated,
}

/// A list of changes, if the journal is kept.
#[derive(Default)]
pub(super) struct Journal {
    entries: RefCell<Option<VecDeque<Change>>>,
    /// The task, or the root, that runs.
    running: Cell<Option<TaskId>>,
    /// Why the one that runs is unwound as a whole, if it is.
    unwinding: RefCell<Option<ActionEnd>>,
    /// The actions that tasks perform, innermost last.
    open: RefCell<BTreeMap<TaskId, Vec<ActionId>>>,
    last_action: Cell<u64>,
    /// What was performed, for questions about it.
    trace: RefCell<Trace>,
    /// Is the trace switched off?
    is_traceless: Cell<bool>,
}

impl Journal {
    pub(super) fn begin(&self) {
        self.entries.borrow_mut().get_or_insert_default();
    }

    /// Does anybody fetch it?
    pub(super) fn is_fetched(&self) -> bool {
        self.entries.borrow().is_some()
    }

    /// Does anything become of what is noted?
    pub(super) fn is_kept(&self) -> bool {
        !self.is_traceless.get() || self.is_fetched()
    }

    /// The trace.
    pub(super) fn trace(&self) -> Ref<'_, Trace> {
        self.trace.borrow()
    }

    /// Switches the trace on or off.
    pub(super) fn set_traces(&self, traces: bool) {
        self.is_traceless.set(!traces);
    }

    /// Is the trace switched on?
    pub(super) fn traces(&self) -> bool {
        !self.is_traceless.get()
    }

    /// A form at top level has ended.
    pub(super) fn end_top_level(&self, id: TaskId, status: Status, result: Value, time: f64) {
        self.trace
            .borrow_mut()
            .end_top_level(id, status, result, time);
    }

    pub(super) fn note(&self, change: Change) {
        if self.traces() {
            self.trace.borrow_mut().note(&change);
        }
        if let Some(entries) = self.entries.borrow_mut().as_mut() {
            if entries.len() >= MAX_ENTRIES {
                entries.pop_front();
            }
            entries.push_back(change);
        }
    }

    pub(super) fn fetch(&self) -> Vec<Change> {
        match self.entries.borrow_mut().as_mut() {
            Some(entries) => std::mem::take(entries).into(),
            None => Vec::new(),
        }
    }

    /// A task or a root runs from now on.
    pub(super) fn set_running(&self, id: TaskId) {
        self.running.set(Some(id));
        self.unwinding.replace(None);
    }

    /// The one that runs is unwound as a whole from now on.
    pub(super) fn set_unwinding(&self, why: ActionEnd) {
        self.unwinding.replace(Some(why));
    }

    pub(super) fn unwinding(&self) -> Option<ActionEnd> {
        self.unwinding.borrow().clone()
    }

    pub(super) fn running(&self) -> Option<TaskId> {
        self.running.get()
    }

    /// The innermost action that a task performs.
    pub(super) fn action_of(&self, task: TaskId) -> Option<ActionId> {
        self.open.borrow().get(&task)?.last().copied()
    }

    /// A task performs a new action.
    pub(super) fn open_action(&self, task: TaskId) -> ActionId {
        self.last_action.set(self.last_action.get() + 1);
        let id = ActionId(self.last_action.get());
        self.open.borrow_mut().entry(task).or_default().push(id);
        id
    }

    /// A task does not perform an action any more.
    pub(super) fn close_action(&self, task: TaskId, id: ActionId) {
        let mut open = self.open.borrow_mut();
        if let Some(actions) = open.get_mut(&task) {
            actions.retain(|action| *action != id);
            if actions.is_empty() {
                open.remove(&task);
            }
        }
    }
}
