//! Propagates a change: wakes tasks, computes networks, calls callbacks.

use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;

use super::evaluation::Reading;
use super::{FluentRef, Kind};
use crate::state::Plan;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::computation::{Computation, Progress, compute};
use lisp::vm::machine::Machine;
use lisp::vm::step::Step;

type Result<T> = std::result::Result<T, Box<Raise>>;

/// A change being propagated.
pub(crate) struct Propagation {
    plan: Rc<Plan>,
    /// Networks to check, by rank and age.
    pending: BTreeMap<(u32, u64), FluentRef>,
    /// Callbacks to call, each with the value.
    calls: VecDeque<(Value, Value)>,
    /// The network being computed, and its previous value.
    current: Option<(FluentRef, Value, Reading, Purpose)>,
    /// What the builtin returns at the end.
    result: Value,
}

/// Why a fluent is computed.
#[derive(Clone, Copy, PartialEq)]
enum Purpose {
    /// To see whether it has changed.
    Update,
    /// To pass the value to its callbacks.
    Report,
}

/// Stores a value that differs from the old one.
pub(crate) fn store(machine: &mut Machine<'_>, fluent: &FluentRef, new: Value) -> Result<Step> {
    if let Kind::Value { value, .. } = &fluent.get().kind {
        value.set(new.clone());
        fluent.note();
    }
    spread(machine, fluent, new)
}

/// Pulses a fluent.
pub(crate) fn pulse(machine: &mut Machine<'_>, fluent: &FluentRef) -> Result<Step> {
    spread(machine, fluent, Value::NIL)
}

fn spread(machine: &mut Machine<'_>, fluent: &FluentRef, result: Value) -> Result<Step> {
    let plan = Plan::of(machine.image);
    let inner = fluent.get();
    if inner.dependents.borrow().is_empty() && inner.callbacks.borrow().is_empty() {
        inner.pulses.set(inner.pulses.get() + 1);
        wake(&plan, fluent);
        return Ok(Step::Return(result));
    }
    let mut propagation = Propagation::new(plan, result);
    propagation.pulse(fluent, None);
    propagation.spread(machine)
}

/// Stores a value and propagates the change until a Lisp function must be called; the rest, if any,
/// must continue in a fiber.
pub(crate) fn settle(image: &mut Image, fluent: &FluentRef, new: Value) -> Option<Propagation> {
    let plan = Plan::of(image);
    if let Kind::Value { value, .. } = &fluent.get().kind {
        value.set(new.clone());
        fluent.note();
    }
    let mut propagation = Propagation::new(plan, Value::NIL);
    propagation.pulse(fluent, Some(new));
    match propagation.go_on(image, None) {
        Ok(None) => None,
        Ok(Some((function, args))) => {
            // The call has been taken out: put it back as the next one.
            propagation.restart_with(function, args);
            Some(propagation)
        }
        Err(_) => None,
    }
}

fn wake(plan: &Plan, fluent: &FluentRef) {
    let mut waiters = fluent.get().waiters.borrow_mut();
    if !waiters.is_empty() {
        plan.wake(&mut waiters);
    }
}

impl Propagation {
    fn new(plan: Rc<Plan>, result: Value) -> Propagation {
        Propagation {
            plan,
            pending: BTreeMap::new(),
            calls: VecDeque::new(),
            current: None,
            result,
        }
    }

    /// Counts a pulse, wakes waiting tasks, and queues dependent networks, and callbacks if the
    /// value is known.
    fn pulse(&mut self, fluent: &FluentRef, value: Option<Value>) {
        let inner = fluent.get();
        inner.pulses.set(inner.pulses.get() + 1);
        wake(&self.plan, fluent);
        for dependent in inner.dependents.borrow().iter() {
            if let Some(dependent) = FluentRef::upgrade(dependent) {
                let key = (dependent.get().rank, dependent.get().serial);
                self.pending.insert(key, dependent);
            }
        }
        let value = value.or_else(|| inner.known_value());
        let callbacks = inner.callbacks.borrow();
        match value {
            Some(value) => {
                for (_, function) in callbacks.iter() {
                    self.calls.push_back((function.clone(), value.clone()));
                }
            }
            None if !callbacks.is_empty() => {
                let reading = Reading::new(fluent, true, false);
                self.current = Some((fluent.clone(), Value::Unbound, reading, Purpose::Report));
            }
            None => {}
        }
    }

    /// Does what it can; returns the next call that is needed, or `None` when finished.
    fn go_on(
        &mut self,
        image: &mut Image,
        mut answer: Option<Value>,
    ) -> Result<Option<(Value, Vec<Value>)>> {
        loop {
            if let Some((fluent, before, mut reading, purpose)) = self.current.take() {
                match reading.go_on(image, answer.take()) {
                    Ok(Progress::Done(value)) => match purpose {
                        Purpose::Report => {
                            for (_, function) in fluent.get().callbacks.borrow().iter() {
                                self.calls.push_back((function.clone(), value.clone()));
                            }
                        }
                        Purpose::Update if !value.is_eql(&before) => {
                            self.pulse(&fluent, Some(value));
                        }
                        Purpose::Update => {}
                    },
                    Ok(Progress::Call { function, args }) => {
                        self.current = Some((fluent, before, reading, purpose));
                        return Ok(Some((function, args)));
                    }
                    // Readers of the network will get the error; it has changed, at least.
                    Err(_) => self.pulse_broken(&fluent),
                }
                continue;
            }
            if let Some((function, value)) = self.calls.pop_front() {
                return Ok(Some((function, vec![value])));
            }
            let Some((_, fluent)) = self.pending.pop_first() else {
                return Ok(None);
            };
            match &fluent.get().kind {
                Kind::Net {
                    is_cacheable: true,
                    cache,
                    ..
                } => {
                    let before = cache.get();
                    let reading = Reading::new(&fluent, false, true);
                    self.current = Some((fluent, before, reading, Purpose::Update));
                }
                _ => self.pulse(&fluent, None),
            }
        }
    }

    /// Pulses a network whose value cannot be computed; its callbacks are not called.
    fn pulse_broken(&mut self, fluent: &FluentRef) {
        let inner = fluent.get();
        inner.pulses.set(inner.pulses.get() + 1);
        wake(&self.plan, fluent);
        for dependent in inner.dependents.borrow().iter() {
            if let Some(dependent) = FluentRef::upgrade(dependent) {
                let key = (dependent.get().rank, dependent.get().serial);
                self.pending.insert(key, dependent);
            }
        }
    }

    /// Puts back a call that was taken out.
    fn restart_with(&mut self, function: Value, args: Vec<Value>) {
        match self.current.take() {
            // The network is computed again from the start.
            Some((fluent, before, _, purpose)) => {
                let reading = Reading::new(&fluent, purpose == Purpose::Report, true);
                self.current = Some((fluent, before, reading, purpose));
            }
            None => {
                let value = args.into_iter().next().unwrap_or(Value::NIL);
                self.calls.push_front((function, value));
            }
        }
    }

    /// Continues in a fiber.
    pub(crate) fn spread(self, machine: &mut Machine<'_>) -> Result<Step> {
        compute(machine, "PULSE", self)
    }
}

impl Computation for Propagation {
    type Output = Value;

    fn advance(
        &mut self,
        machine: &mut Machine<'_>,
        answer: Option<Value>,
    ) -> Result<Progress<Value>> {
        // Unless a network is being computed, the value is that of a callback.
        let answer = answer.filter(|_| self.current.is_some());
        Ok(match self.go_on(machine.image, answer)? {
            None => Progress::Done(std::mem::take(&mut self.result)),
            Some((function, args)) => Progress::Call { function, args },
        })
    }
}
