//! What the plan language stores in an image: its symbols, the time, the waiters to wake, and the
//! variables and trees that outlive a plan.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use indexmap::IndexMap;

use super::companion::Companion;
use super::fluent::Waiter;
use super::journal::{Change, Journal};
use super::names::Names;
use super::tree::TreeNode;
use lisp::image::Image;
use lisp::image::extension::Extension;
use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
use lisp::value::raise::Raise;
use lisp::value::symbol::Sym;

/// The plan language's part of an image.
pub struct Plan {
    /// Symbols that Rust code uses.
    pub names: Names,
    /// Simulated seconds, set only by the scheduler.
    now: Cell<f64>,
    /// Tasks whose fluents changed since the scheduler last checked, in the order in which they
    /// will run.
    woken: RefCell<Vec<Waiter>>,
    /// Special variables that every task binds, in order of definition: to their value in the task
    /// that starts it, or to what a function computes from that.
    pub(crate) task_variables: RefCell<Vec<(Sym, Option<Value>)>>,
    /// What is called again and again while time passes.
    pub(crate) companions: RefCell<Vec<Companion>>,
    /// Task trees of named top-level plans.
    pub trees: RefCell<IndexMap<Sym, Rc<TreeNode>>>,
    /// Changes in the states of tasks.
    pub(super) journal: Journal,
    /// Numbers for fluents and tasks without a name.
    numbers: Cell<u64>,
}

impl Extension for Plan {
    fn copied(self: Rc<Self>, copier: &mut Copier) -> Rc<dyn Extension> {
        if self.has_woken() || self.journal.is_fetched() {
            copier.refuse("a plan that runs");
        }
        if !self.trees.borrow().is_empty() {
            copier.refuse("the task tree of a plan");
        }
        let companions = self.companions.borrow();
        let companions = companions.iter().map(|c| c.copied(copier)).collect();
        let variables = self.task_variables.borrow();
        let variables = variables.iter();
        let variables = variables.map(|(name, function)| (*name, function.copied(copier)));
        Rc::new(Plan {
            names: self.names,
            now: self.now.clone(),
            woken: RefCell::default(),
            task_variables: RefCell::new(variables.collect()),
            companions: RefCell::new(companions),
            trees: RefCell::default(),
            journal: Journal::default(),
            numbers: self.numbers.clone(),
        })
    }
}

/// Where the clock ends, in simulated seconds: up to there, 136 years, it resolves a microsecond.
const END_OF_TIME: f64 = (1_u64 << 32) as f64;
/// The first number in generated names.
const FIRST_NUMBER: u64 = 390;

impl Plan {
    pub(super) fn new(names: Names) -> Plan {
        Plan {
            names,
            now: Cell::new(0.0),
            woken: RefCell::default(),
            task_variables: RefCell::default(),
            companions: RefCell::default(),
            trees: RefCell::default(),
            journal: Journal::default(),
            numbers: Cell::new(FIRST_NUMBER),
        }
    }

    /// The plan language's part of an image.
    ///
    /// # Panics
    ///
    /// Never: builtins and requests of the plan language are installed by [`super::install()`],
    /// which first puts this part there.
    pub fn of(image: &Image) -> Rc<Plan> {
        match image.extension() {
            Some(plan) => plan,
            None => unreachable!("the plan language is not installed"),
        }
    }

    /// Simulated time in seconds since the session began.
    pub fn now(&self) -> f64 {
        self.now.get()
    }

    /// The time so many seconds from now; an error if it is later than the clock can tell.
    pub fn after(&self, seconds: f64) -> Result<f64, Box<Raise>> {
        let time = self.now() + seconds;
        if time <= END_OF_TIME {
            return Ok(time);
        }
        Err(Raise::simple(format!(
            "The clock cannot wait {seconds:e} s: simulated time ends at {END_OF_TIME} s."
        )))
    }

    pub(super) fn set_now(&self, now: f64) {
        self.now.set(now);
    }

    /// Lets a function be called every so many simulated seconds, unless it is called already.
    pub(crate) fn accompany(&self, period: f64, function: Value) {
        self.add_companion(Companion::new(self.now(), period, function));
    }

    pub(crate) fn add_companion(&self, companion: Companion) {
        let mut companions = self.companions.borrow_mut();
        if !companions.iter().any(|known| known.is_like(&companion)) {
            companions.push(companion);
        }
    }

    /// Begins to record changes in the states of tasks until they are fetched.
    pub fn keep_journal(&self) {
        self.journal.begin();
    }

    /// What has happened to tasks and actions since the last fetch.
    pub fn fetch_journal(&self) -> Vec<Change> {
        self.journal.fetch()
    }

    /// A number for a generated name.
    pub(crate) fn fresh_number(&self) -> u64 {
        self.numbers.set(self.numbers.get() + 1);
        self.numbers.get()
    }

    /// Wakes the tasks that wait for a fluent, in order of creation.
    pub fn wake(&self, waiters: &mut Vec<Waiter>) {
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
