//! Fluents: values that tasks can wait for.
//!
//! A value fluent contains a value. A network computes its value from other fluents and keeps it
//! until one of them changes. A pulse fluent is true once per pulse of another fluent, a change
//! fluent once per change.
//!
//! A change propagates in order of rank, so a network is computed once, however many paths lead to
//! it. Fluents have weak references to the networks that depend on them: a network lives as long as
//! it is used. Chains of networks of any length cost no Rust stack.

mod evaluation;
mod propagation;
mod reference;

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::rc::{Rc, Weak};

use lisp::native::PureFn;
use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
use lisp::value::foreign::{Foreign, ForeignBox, ForeignCopy, PrintContext};
use lisp::value::slot::Slot;
use lisp::value::symbol::Sym;

pub(crate) use evaluation::{read, value};
pub(crate) use propagation::{Propagation, pulse};
pub(crate) use propagation::{settle, store};
pub(crate) use reference::FluentRef;

/// A waiting task, at a particular wait.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Waiter {
    /// Creation order of the task.
    pub order: u64,
    /// The scheduler's entry of the task.
    pub slot: u32,
    /// Identifies this wait.
    pub token: u64,
}

/// A fluent.
pub(crate) struct Fluent {
    name: FluentName,
    kind: Kind,
    /// Greater than that of every fluent that this one depends on.
    rank: u32,
    /// Creation order, for networks of the same rank.
    serial: u64,
    /// How many times it was pulsed or changed.
    pulses: Cell<u64>,
    callbacks: RefCell<Vec<(Value, Value)>>,
    dependents: RefCell<Vec<Weak<ForeignBox>>>,
    waiters: RefCell<Vec<Waiter>>,
    type_symbol: Sym,
}

/// The name of a fluent.
enum FluentName {
    Given(Value),
    Numbered(&'static str, u64),
}

/// Where a fluent's value comes from.
enum Kind {
    /// From calls that store it.
    Value {
        value: Slot,
        /// Determines whether a new value is a change; `NIL` stands for `eql`.
        test: Value,
    },
    /// From other fluents.
    Net {
        operation: Operation,
        args: RefCell<Vec<Value>>,
        /// The value while it is valid; "no value" if it must be computed.
        cache: Slot,
        /// Whether the value is valid until something it depends on is pulsed.
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
    /// The last value, or `NIL` as soon as one is `NIL`.
    And,
    /// The first value that is not `NIL`.
    Or,
    /// By a Lisp function.
    Call(Value),
    /// By a Lisp function; the last argument is a list of fluents and values.
    Apply(Value),
}

/// What a pulse fluent does about pulses for which no task was waiting.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Missed {
    /// Those before its creation do not count; later ones count as one.
    Never,
    /// All count as one.
    Once,
    /// Each counts.
    Always,
}

impl Fluent {
    /// The name as shown.
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

    /// The value, if it is known without computing it.
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

    /// Whether its value can be set.
    pub(crate) fn is_settable(&self) -> bool {
        matches!(self.kind, Kind::Value { .. })
    }

    /// The test for whether a stored value is a change; `NIL` stands for `eql`.
    pub(crate) fn test(&self) -> Value {
        match &self.kind {
            Kind::Value { test, .. } => test.clone(),
            _ => Value::NIL,
        }
    }

    /// Whether its value is valid until it is pulsed.
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

    /// Stops waiting.
    pub(crate) fn remove_waiter(&self, token: u64) {
        self.waiters.borrow_mut().retain(|w| w.token != token);
    }

    /// The callback with that name.
    pub(crate) fn callback(&self, name: &Value) -> Option<Value> {
        let callbacks = self.callbacks.borrow();
        let found = callbacks.iter().find(|(n, _)| n.is_eql(name));
        found.map(|(_, function)| function.clone())
    }

    /// Adds a callback; false if the name is taken.
    fn add_callback(&self, name: &Value, function: &Value) -> bool {
        if self.callback(name).is_some() {
            return false;
        }
        let mut callbacks = self.callbacks.borrow_mut();
        callbacks.push((name.clone(), function.clone()));
        true
    }

    /// Removes a callback; returns whether it existed.
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
    fn copied(&self, copier: &mut Copier) -> ForeignCopy {
        let is_alone = self.waiters.borrow().is_empty()
            && self
                .dependents
                .borrow()
                .iter()
                .all(|d| d.strong_count() == 0);
        let Kind::Value { test, .. } = &self.kind else {
            return ForeignCopy::Refused("a network of fluents");
        };
        if !is_alone {
            return ForeignCopy::Refused("a fluent on which others depend");
        }
        let name = match &self.name {
            FluentName::Given(name) => FluentName::Given(copier.value(name)),
            FluentName::Numbered(prefix, number) => FluentName::Numbered(prefix, *number),
        };
        ForeignCopy::New(Box::new(Fluent {
            name,
            kind: Kind::Value {
                value: Slot::default(),
                test: copier.value(test),
            },
            rank: self.rank,
            serial: self.serial,
            pulses: self.pulses.clone(),
            callbacks: RefCell::default(),
            dependents: RefCell::default(),
            waiters: RefCell::default(),
            type_symbol: self.type_symbol,
        }))
    }

    fn fill_copy(&self, copy: &dyn Any, copier: &mut Copier) {
        let Some(copy) = copy.downcast_ref::<Fluent>() else {
            return;
        };
        if let (Kind::Value { value, .. }, Kind::Value { value: filled, .. }) =
            (&self.kind, &copy.kind)
        {
            filled.set(value.with(|value| copier.value(value)));
        }
        let callbacks = self.callbacks.borrow();
        let callbacks = callbacks.iter();
        let callbacks = callbacks.map(|callback| callback.copied(copier));
        copy.callbacks.replace(callbacks.collect());
    }

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

    fn may_be_in_circle(&self) -> bool {
        true
    }

    fn for_each_reference(&self, visit: &mut dyn FnMut(&Value)) {
        if let FluentName::Given(name) = &self.name {
            visit(name);
        }
        match &self.kind {
            Kind::Value { value, test } => {
                value.with(|value| visit(value));
                visit(test);
            }
            Kind::Net {
                args,
                cache,
                operation,
                ..
            } => {
                if let Ok(args) = args.try_borrow() {
                    args.iter().for_each(&mut *visit);
                }
                cache.with(|value| visit(value));
                if let Operation::Call(function) | Operation::Apply(function) = operation {
                    visit(function);
                }
            }
            Kind::Change {
                source,
                old,
                test,
                key,
            } => {
                visit(&source.value());
                old.with(|value| visit(value));
                visit(test);
                visit(key);
            }
            Kind::Pulses { source, .. } => visit(&source.value()),
        }
        if let Ok(callbacks) = self.callbacks.try_borrow() {
            for (name, function) in callbacks.iter() {
                visit(name);
                visit(function);
            }
        }
    }

    fn let_go(&self) {
        match &self.kind {
            Kind::Value { value, .. } => drop(value.take()),
            Kind::Net { args, cache, .. } => drop((args.take(), cache.take())),
            Kind::Change { old, .. } => drop(old.take()),
            Kind::Pulses { .. } => {}
        }
        self.callbacks.take();
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
