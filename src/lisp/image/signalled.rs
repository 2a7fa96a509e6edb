//! Where the most recently signalled conditions came from.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;

use super::Image;
use super::open_call::OpenCall;
use crate::value::Value;

/// The number of conditions whose calls are remembered.
const REMEMBERED: usize = 64;

/// The most calls that are remembered for one condition.
const MAX_CALLS: usize = 512;

/// The calls in which the most recent conditions were signalled.
#[derive(Default)]
pub(super) struct Signalled {
    /// Newest last; conditions that share their calls have one list.
    recent: VecDeque<(Value, Rc<RefCell<Vec<OpenCall>>>)>,
    leaving: Leaving,
}

/// The condition because of which stack frames are being left, if there is one; for code that
/// notices the end of a call when it has no image at hand.
#[derive(Clone, Default)]
pub struct Leaving(Rc<RefCell<Option<Value>>>);

impl Leaving {
    /// The condition.
    pub fn cause(&self) -> Option<Value> {
        self.0.borrow().clone()
    }

    /// Frames are left because of the condition from now on, or none are.
    pub fn set(&self, condition: Option<Value>) {
        self.0.replace(condition);
    }
}

impl Signalled {
    /// Is nothing known of any condition?
    pub(super) fn is_empty(&self) -> bool {
        self.recent.is_empty() && self.leaving.cause().is_none()
    }

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
    pub fn condition_calls(&self, condition: &Value) -> Vec<OpenCall> {
        let calls = self.signalled.calls(condition);
        calls.map_or_else(Vec::new, |calls| calls.borrow().clone())
    }

    /// What tells why stack frames are being left.
    pub fn leaving(&self) -> Leaving {
        self.signalled.leaving.clone()
    }

    /// Remembers the calls that were open where a condition was signalled.
    pub(crate) fn set_condition_calls(&mut self, condition: &Value, calls: Vec<OpenCall>) {
        let calls = Rc::new(RefCell::new(calls));
        self.signalled.remember(condition, calls);
    }

    /// Adds the calls of the code to which a condition has come from another task.
    pub(crate) fn add_condition_calls(&mut self, condition: &Value, calls: Vec<OpenCall>) {
        if let Some(inner) = self.signalled.calls(condition) {
            let mut inner = inner.borrow_mut();
            inner.extend(calls);
            inner.truncate(MAX_CALLS);
        }
    }

    /// Another condition, the envelope, carries this one on: what is known about its calls, and
    /// what becomes known later, holds for both.
    pub fn share_condition_calls(&mut self, condition: &Value, envelope: &Value) {
        if let Some(calls) = self.signalled.calls(condition).cloned() {
            self.signalled.remember(envelope, calls);
        }
    }
}
