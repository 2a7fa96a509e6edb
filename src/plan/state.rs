//! What the plan language keeps in an image: its symbols, the clock's reading, who is to be
//! woken, and the variables and trees that outlive a plan.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use indexmap::IndexMap;

use super::fluent::Waiter;
use super::journal::{Journal, TaskChange};
use super::names::Names;
use super::tree::TreeNode;
use crate::lisp::image::Image;
use crate::lisp::value::Value;
use crate::lisp::value::symbol::Sym;

/// The plan language's part of an image.
pub(crate) struct Plan {
    /// Symbols that Rust code names.
    pub(crate) names: Names,
    /// Simulated seconds. Only the scheduler sets it.
    now: Cell<f64>,
    /// Tasks whose fluents changed since the scheduler last looked, in the order in which
    /// they are to run.
    woken: RefCell<Vec<Waiter>>,
    /// Special variables that every task binds anew, in order of definition: to the value
    /// in the task that starts it, or to what a function makes of that.
    pub(crate) task_variables: RefCell<Vec<(Sym, Option<Value>)>>,
    /// Task trees of named top-level plans.
    pub(crate) trees: RefCell<IndexMap<Sym, Rc<TreeNode>>>,
    /// What became of tasks.
    pub(super) journal: Journal,
    /// Numbers given to fluents and tasks without a name.
    numbers: Cell<u64>,
}

/// The first number in generated names.
const FIRST_NUMBER: u64 = 390;

impl Plan {
    pub(super) fn new(names: Names) -> Plan {
        Plan {
            names,
            now: Cell::new(0.0),
            woken: RefCell::default(),
            task_variables: RefCell::default(),
            trees: RefCell::default(),
            journal: Journal::default(),
            numbers: Cell::new(FIRST_NUMBER),
        }
    }

    /// The plan language's part of an image.
    ///
    /// # Panics
    ///
    /// Never: builtins and requests of the plan language come to an image by
    /// [`super::install()`], which puts this part there first.
    pub(crate) fn of(image: &Image) -> Rc<Plan> {
        match image.extension() {
            Some(plan) => plan,
            None => unreachable!("the plan language is not installed"),
        }
    }

    /// Simulated time in seconds since the session began.
    pub(crate) fn now(&self) -> f64 {
        self.now.get()
    }

    pub(super) fn set_now(&self, now: f64) {
        self.now.set(now);
    }

    /// From here on, what becomes of tasks is noted until it is fetched.
    pub(crate) fn keep_journal(&self) {
        self.journal.begin();
    }

    /// What has become of tasks since it was fetched last.
    pub(crate) fn fetch_journal(&self) -> Vec<TaskChange> {
        self.journal.fetch()
    }

    /// A number for a name that nobody gave.
    pub(crate) fn fresh_number(&self) -> u64 {
        self.numbers.set(self.numbers.get() + 1);
        self.numbers.get()
    }

    /// Wakes tasks that wait for one fluent: in the order in which the tasks were made.
    pub(crate) fn wake(&self, waiters: &mut Vec<Waiter>) {
        waiters.sort_by_key(|w| w.order);
        self.woken.borrow_mut().append(waiters);
    }

    pub(super) fn take_woken(&self) -> Vec<Waiter> {
        self.woken.take()
    }

    pub(super) fn has_woken(&self) -> bool {
        !self.woken.borrow().is_empty()
    }
}
