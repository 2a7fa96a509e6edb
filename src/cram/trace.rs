//! The execution trace: what was performed in the last plans, with what came of it. Programs ask for it
//! in Prolog; nothing else depends on it.

use std::collections::{BTreeMap, VecDeque};

use super::journal::{ActionEnd, Change, Starter};
use super::task::{Status, TaskId};
use lisp::source::Place;
use lisp::value::Value;

/// How many plans at top level are kept; the oldest is forgotten first.
const MAX_TOP_LEVELS: usize = 10;

/// How many rows are kept, whatever they belong to.
const MAX_ROWS: usize = 20_000;

/// What a row is about.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum RowKind {
    /// A plan at top level, or a form there that performs something.
    TopLevel,
    /// A task of the plan language.
    Task,
    /// An action or a motion that was performed.
    Performed,
}

/// By what changes know a row as long as it has not ended.
#[derive(Clone, Copy)]
enum Key {
    Task(TaskId),
    Action(u64),
}

/// Something that was performed, or is.
pub(super) struct Row {
    pub(super) kind: RowKind,
    key: Key,
    /// The number of the row that it is part of.
    pub(super) parent: Option<usize>,
    /// Its name; empty for what has a designator.
    pub(super) name: String,
    pub(super) designator: Value,
    /// Where it is performed.
    pub(super) place: Place,
    /// Simulated times (s).
    pub(super) created: f64,
    pub(super) started: Option<f64>,
    pub(super) ended: Option<f64>,
    pub(super) status: Status,
    /// Its value, or the failure with which it ended.
    pub(super) result: Value,
}

/// The rows of the last plans.
#[derive(Default)]
pub(super) struct Trace {
    rows: VecDeque<Row>,
    /// The number of the first row that is kept.
    first: usize,
    /// The rows of tasks and actions that have not ended.
    tasks: BTreeMap<TaskId, usize>,
    actions: BTreeMap<u64, usize>,
    /// The rows of plans at top level.
    top_levels: VecDeque<usize>,
}

impl Trace {
    /// All rows with their numbers, in order of creation.
    pub(super) fn rows(&self) -> impl Iterator<Item = (usize, &Row)> {
        (self.first..).zip(&self.rows)
    }

    /// The row with a number.
    pub(super) fn row(&self, number: usize) -> Option<&Row> {
        let at = number.checked_sub(self.first)?;
        self.rows.get(at)
    }

    /// Notes a change.
    pub(super) fn note(&mut self, change: &Change) {
        match change {
            Change::Task(change) => {
                let number = match self.tasks.get(&change.id) {
                    Some(number) => *number,
                    None => match change.starter {
                        Some(by) => {
                            let parent = self.starter(by, change.time);
                            self.add(RowKind::Task, Key::Task(change.id), parent, change.time)
                        }
                        None => self.add_top_level(change.id, change.time),
                    },
                };
                if let Some(row) = self.row_mut(number) {
                    row.name.clone_from(&change.name);
                    row.status = change.status;
                    if change.status == Status::Running && row.started.is_none() {
                        row.started = Some(change.time);
                    }
                    if change.status.is_dead() {
                        row.ended = Some(change.time);
                        row.result = change.failure.clone().unwrap_or_default();
                    }
                }
                if change.status.is_dead() {
                    self.tasks.remove(&change.id);
                }
            }
            Change::Begun(begun) => {
                let parent = begun.starter.and_then(|by| self.starter(by, begun.time));
                let key = Key::Action(begun.id.0);
                let number = self.add(RowKind::Performed, key, parent, begun.time);
                if let Some(row) = self.row_mut(number) {
                    row.designator = begun.designator.clone();
                    row.place = begun.place;
                    row.started = Some(begun.time);
                    row.status = Status::Running;
                }
            }
            Change::Ended(ended) => {
                let number = self.actions.remove(&ended.begun.id.0);
                if let Some(row) = number.and_then(|number| self.row_mut(number)) {
                    row.ended = Some(ended.time);
                    (row.status, row.result) = match &ended.end {
                        ActionEnd::Succeeded(value) => (Status::Succeeded, value.clone()),
                        ActionEnd::Failed(failure) => (Status::Failed, failure.clone()),
                        ActionEnd::Evaporated => (Status::Evaporated, Value::NIL),
                    };
                }
            }
        }
    }

    /// A form at top level has ended.
    pub(super) fn end_top_level(&mut self, id: TaskId, status: Status, result: Value, time: f64) {
        let number = self.tasks.remove(&id);
        if let Some(row) = number.and_then(|number| self.row_mut(number)) {
            row.ended = Some(time);
            (row.status, row.result) = (status, result);
        }
    }

    /// The row of what starts something; none if it has been forgotten.
    fn starter(&mut self, starter: Starter, time: f64) -> Option<usize> {
        let id = match starter {
            Starter::Action(id) => return self.actions.get(&id.0).copied(),
            Starter::Task(id) => id,
        };
        if let Some(number) = self.tasks.get(&id) {
            return Some(*number);
        }
        // What no task has started is evaluated at top level.
        let number = self.add_top_level(id, time);
        if let Some(row) = self.row_mut(number) {
            row.started = Some(time);
            row.status = Status::Running;
        }
        Some(number)
    }

    /// A new row for a plan at top level.
    fn add_top_level(&mut self, id: TaskId, created: f64) -> usize {
        if self.top_levels.len() >= MAX_TOP_LEVELS {
            self.top_levels.pop_front();
            let next = self.top_levels.front().copied();
            self.forget(next.unwrap_or(self.first));
        }
        let number = self.add(RowKind::TopLevel, Key::Task(id), None, created);
        self.top_levels.push_back(number);
        number
    }

    fn add(&mut self, kind: RowKind, key: Key, parent: Option<usize>, created: f64) -> usize {
        if self.rows.len() >= MAX_ROWS {
            self.forget(self.first + 1);
        }
        self.rows.push_back(Row {
            kind,
            key,
            parent,
            name: String::new(),
            designator: Value::NIL,
            place: Place::NONE,
            created,
            started: None,
            ended: None,
            status: Status::Created,
            result: Value::NIL,
        });
        let number = self.first + self.rows.len() - 1;
        match key {
            Key::Task(id) => self.tasks.insert(id, number),
            Key::Action(id) => self.actions.insert(id, number),
        };
        number
    }

    fn row_mut(&mut self, number: usize) -> Option<&mut Row> {
        let at = number.checked_sub(self.first)?;
        self.rows.get_mut(at)
    }

    /// Forgets the rows before a number.
    fn forget(&mut self, first: usize) {
        while self.first < first
            && let Some(row) = self.rows.pop_front()
        {
            self.first += 1;
            // What has ended is no longer among these; its key may belong to a later row.
            let is_forgotten = |number: &usize| *number < self.first;
            match row.key {
                Key::Task(id) if self.tasks.get(&id).is_some_and(is_forgotten) => {
                    self.tasks.remove(&id);
                }
                Key::Action(id) if self.actions.get(&id).is_some_and(is_forgotten) => {
                    self.actions.remove(&id);
                }
                Key::Task(_) | Key::Action(_) => {}
            }
        }
        while self
            .top_levels
            .front()
            .is_some_and(|number| *number < self.first)
        {
            self.top_levels.pop_front();
        }
    }
}
