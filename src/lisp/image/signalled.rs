//! Where the most recently signalled conditions came from.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use super::Image;
use super::open_call::OpenCall;
use crate::lisp::value::Value;

/// The number of conditions whose calls are remembered.
const REMEMBERED: usize = 64;

/// The most calls that are remembered for one condition.
const MOST_CALLS: usize = 512;

/// The calls in which the most recent conditions were signalled.
#[derive(Default)]
pub(super) struct Signalled {
    /// Newest last; conditions that share their calls have one list.
    recent: VecDeque<(Value, Rc<RefCell<Vec<OpenCall>>>)>,
    last: LastCondition,
}

/// The condition that was signalled last, and how many have been signalled; for code that notices
/// the end of a call when it has no image at hand.
#[derive(Clone, Default)]
pub(crate) struct LastCondition(Rc<RefCell<(u64, Option<Value>)>>);

impl LastCondition {
    /// How many conditions have been signalled.
    pub(crate) fn count(&self) -> u64 {
        self.0.borrow().0
    }

    /// The condition, if it has been signalled since `count` was returned and not been forgotten.
    pub(crate) fn since(&self, count: u64) -> Option<Value> {
        let last = self.0.borrow();
        last.1.clone().filter(|_| last.0 > count)
    }

    /// Forgets the condition: it has been dealt with.
    pub(crate) fn forget(&self) {
        self.0.borrow_mut().1 = None;
    }

    fn set(&self, condition: &Value) {
        let mut last = self.0.borrow_mut();
        last.0 += 1;
        last.1 = Some(condition.clone());
    }
}

impl Signalled {
    fn calls(&self, condition: &Value) -> Option<&Rc<RefCell<Vec<OpenCall>>>> {
        let (older, newer) = self.recent.as_slices();
        let mut all = newer.iter().rev().chain(older.iter().rev());
        all.find(|(known, _)| known.is_eq(condition))
            .map(|(_, calls)| calls)
    }

    fn remember(&mut self, condition: &Value, calls: Rc<RefCell<Vec<OpenCall>>>) {
        if self.recent.len() == REMEMBERED {
            self.recent.pop_front();
        }
        self.recent.push_back((condition.clone(), calls));
    }
}

impl Image {
    /// Is it known where a condition was signalled?
    pub(crate) fn knows_condition_calls(&self, condition: &Value) -> bool {
        self.signalled.calls(condition).is_some()
    }

    /// The calls that were open where a condition was signalled, innermost first; none if
    /// that is not known.
    pub(crate) fn condition_calls(&self, condition: &Value) -> Vec<OpenCall> {
        let calls = self.signalled.calls(condition);
        calls.map_or_else(Vec::new, |calls| calls.borrow().clone())
    }

    /// The condition that was signalled last.
    pub(crate) fn last_condition(&self) -> LastCondition {
        self.signalled.last.clone()
    }

    /// Remembers the calls that were open where a condition was signalled.
    pub(crate) fn set_condition_calls(&mut self, condition: &Value, calls: Vec<OpenCall>) {
        let calls = Rc::new(RefCell::new(calls));
        self.signalled.last.set(condition);
        self.signalled.remember(condition, calls);
    }

    /// Adds the calls of the code to which a condition has come from another task.
    pub(crate) fn add_condition_calls(&mut self, condition: &Value, calls: Vec<OpenCall>) {
        if let Some(inner) = self.signalled.calls(condition) {
            let mut inner = inner.borrow_mut();
            inner.extend(calls);
            inner.truncate(MOST_CALLS);
        }
    }

    /// Another condition, the envelope, carries this one on: what is known about its calls, and
    /// what becomes known later, holds for both.
    pub(crate) fn share_condition_calls(&mut self, condition: &Value, envelope: &Value) {
        if let Some(calls) = self.signalled.calls(condition).cloned() {
            self.signalled.remember(envelope, calls);
        }
    }
}
