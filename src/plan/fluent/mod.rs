//! Fluents: values that tasks can wait for.
//!
//! A value fluent holds a value. A network computes its value from other fluents and keeps
//! it until one of them changes. A pulse fluent is true once per pulse of another one, a
//! change fluent once per change.
//!
//! A change spreads in order of rank, so that a network is computed once however many ways
//! lead to it. Networks are held weakly by what they depend on: they live as long as
//! somebody uses them. Chains of networks of any length cost no Rust stack.

mod evaluation;
mod propagation;
mod reference;

use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};

use crate::lisp::native::PureFn;
use crate::lisp::value::Value;
use crate::lisp::value::foreign::{Foreign, ForeignBox, PrintContext};
use crate::lisp::value::slot::Slot;
use crate::lisp::value::symbol::Sym;

pub(crate) use evaluation::{read, value};
pub(crate) use propagation::{Propagation, pulse, settle, store};
pub(crate) use reference::FluentRef;

/// A task that waits, at one of its waits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Waiter {
    /// Creation order of the task.
    pub(crate) order: u64,
    /// The scheduler's entry of the task.
    pub(crate) slot: u32,
    /// Tells this wait from others.
    pub(crate) token: u64,
}

/// A fluent.
pub(crate) struct Fluent {
    name: FluentName,
    kind: Kind,
    /// Greater than that of every fluent that this one depends on.
    rank: u32,
    /// Order of creation, for networks of one rank.
    serial: u64,
    /// How often it was pulsed or changed.
    pulses: Cell<u64>,
    callbacks: RefCell<Vec<(Value, Value)>>,
    dependents: RefCell<Vec<Weak<ForeignBox>>>,
    waiters: RefCell<Vec<Waiter>>,
    type_symbol: Sym,
}

/// How a fluent is called.
enum FluentName {
    Given(Value),
    Numbered(&'static str, u64),
}

/// Where a fluent's value comes from.
enum Kind {
    /// From whoever stores it.
    Value {
        value: Slot,
        /// Decides whether a new value is a change; `NIL` stands for `eql`.
        test: Value,
    },
    /// From other fluents.
    Net {
        operation: Operation,
        args: RefCell<Vec<Value>>,
        /// The value while it holds; "no value" if it must be computed.
        cache: Slot,
        /// Does the value hold until something it depends on is pulsed?
        is_cacheable: bool,
    },
    /// From the pulses of another fluent.
    Pulses {
        source: FluentRef,
        mode: Missed,
        processed: Cell<u64>,
    },
    /// From changes of another fluent.
    Change {
        source: FluentRef,
        /// `NIL` stands for `eql`.
        test: Value,
        /// `NIL` stands for `identity`.
        key: Value,
        old: Slot,
    },
}

/// How a network computes its value from those of its arguments.
#[derive(Clone)]
pub(crate) enum Operation {
    /// By a function that needs no machine.
    Pure(PureFn),
    /// The last, or `NIL` at the first that is `NIL`.
    And,
    /// The first that is not `NIL`.
    Or,
    /// By a Lisp function.
    Call(Value),
    /// By a Lisp function; the last argument is a list of fluents and values.
    Apply(Value),
}

/// What a pulse fluent does about pulses that nobody was waiting for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Missed {
    /// Those before its creation do not count; others count as one.
    Never,
    /// All count as one.
    Once,
    /// Each counts.
    Always,
}

impl Fluent {
    /// The name, as it is shown.
    pub(crate) fn name(&self, context: &dyn PrintContext) -> String {
        match &self.name {
            FluentName::Given(name) => context.text(name, false),
            FluentName::Numbered(prefix, n) => format!("{prefix}{n}"),
        }
    }

    /// The name that was given, if any.
    pub(crate) fn given_name(&self) -> Option<Value> {
        match &self.name {
            FluentName::Given(name) => Some(name.clone()),
            FluentName::Numbered(..) => None,
        }
    }

    /// The value, if it can be told without computing.
    pub(crate) fn known_value(&self) -> Option<Value> {
        let value = match &self.kind {
            Kind::Value { value, .. } => value.get(),
            Kind::Net {
                cache,
                is_cacheable: true,
                ..
            } => cache.get(),
            _ => return None,
        };
        (!value.is_unbound()).then_some(value)
    }

    /// Does somebody store its value?
    pub(crate) fn is_settable(&self) -> bool {
        matches!(self.kind, Kind::Value { .. })
    }

    /// What decides whether a stored value is a change; `NIL` stands for `eql`.
    pub(crate) fn test(&self) -> Value {
        match &self.kind {
            Kind::Value { test, .. } => test.clone(),
            _ => Value::NIL,
        }
    }

    /// Does its value hold until it is pulsed?
    pub(crate) fn is_cacheable(&self) -> bool {
        match &self.kind {
            Kind::Value { .. } => true,
            Kind::Net { is_cacheable, .. } => *is_cacheable,
            Kind::Pulses { .. } | Kind::Change { .. } => false,
        }
    }

    /// Waits for the next pulse.
    pub(crate) fn add_waiter(&self, waiter: Waiter) {
        self.waiters.borrow_mut().push(waiter);
    }

    /// Waits no longer.
    pub(crate) fn remove_waiter(&self, token: u64) {
        self.waiters.borrow_mut().retain(|w| w.token != token);
    }

    /// The callback of a name.
    pub(crate) fn callback(&self, name: &Value) -> Option<Value> {
        let callbacks = self.callbacks.borrow();
        let found = callbacks.iter().find(|(n, _)| n.is_eql(name));
        found.map(|(_, function)| function.clone())
    }

    /// Adds a callback; false if the name is taken.
    pub(crate) fn add_callback(&self, name: &Value, function: &Value) -> bool {
        if self.callback(name).is_some() {
            return false;
        }
        let mut callbacks = self.callbacks.borrow_mut();
        callbacks.push((name.clone(), function.clone()));
        true
    }

    /// Removes a callback; was it there?
    pub(crate) fn remove_callback(&self, name: &Value) -> bool {
        let mut callbacks = self.callbacks.borrow_mut();
        let before = callbacks.len();
        callbacks.retain(|(n, _)| !n.is_eql(name));
        callbacks.len() < before
    }

    fn add_dependent(&self, dependent: &FluentRef) {
        let mut dependents = self.dependents.borrow_mut();
        if dependents.len() == dependents.capacity() {
            dependents.retain(|d| d.strong_count() > 0);
        }
        dependents.push(dependent.downgrade());
    }
}

impl Foreign for Fluent {
    fn type_symbol(&self) -> Sym {
        self.type_symbol
    }

    fn print(&self, context: &dyn PrintContext, _: bool) -> String {
        let name = self.name(context);
        match &self.kind {
            Kind::Value { value, .. } => {
                let value = context.text(&value.get(), true);
                format!("#<FLUENT {name} [{value}]>")
            }
            _ => format!("#<FLUENT {name}>"),
        }
    }
}

impl Drop for Fluent {
    /// Frees chains of networks with a loop, however long they are.
    fn drop(&mut self) {
        let Kind::Net { args, .. } = &self.kind else {
            return;
        };
        let mut pending = args.take();
        while let Some(value) = pending.pop() {
            if let Value::Foreign(object) = &value
                && Rc::strong_count(object) == 1
                && let Some(fluent) = object.downcast_ref::<Fluent>()
                && let Kind::Net { args, .. } = &fluent.kind
            {
                pending.append(&mut args.take());
            }
        }
    }
}
