//! Tasks that run in parallel for one form, and the result of the form.

use super::Scheduler;
use super::live::{Answer, Slot, Wait};
use crate::host::Host;
use crate::request::GroupKind;
use crate::state::Plan;
use crate::task::{Status, TaskRef};
use lisp::condition;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::known;
use lisp::value::raise::Raise;

/// The tasks of a form.
pub(super) struct Group {
    pub kind: GroupKind,
    pub(crate) children: Vec<TaskRef>,
}

/// The state of a group.
enum Decision {
    Open,
    Value(Value),
    Failure(Value),
    AllFailed(Vec<Value>),
}

impl Group {
    /// If several tasks have ended since the last check, the last one listed determines a failure
    /// or the winner of `GroupKind::First`, the first one listed everything else.
    fn decision(&self) -> Decision {
        let tasks = || self.children.iter().map(TaskRef::get);
        let result = |task: &crate::task::Task| task.result.borrow().clone();
        let mut failed = tasks().filter(|t| t.status() == Status::Failed);
        let mut done = tasks().filter(|t| t.status().is_done());
        let is_open = tasks().any(|t| !t.status().is_dead());
        match self.kind {
            GroupKind::All | GroupKind::First => {
                if let Some(task) = failed.next_back() {
                    return Decision::Failure(result(task));
                }
            }
            GroupKind::Any => {}
        }
        let decided = match self.kind {
            GroupKind::All if is_open => None,
            GroupKind::All | GroupKind::Any => done.next(),
            GroupKind::First => done.next_back(),
        };
        match decided {
            Some(task) => Decision::Value(result(task)),
            None if is_open => Decision::Open,
            // In the order in which the form's watcher sees them: the last one first.
            None => Decision::AllFailed(tasks().rev().map(result).collect()),
        }
    }
}

impl<C: 'static> Scheduler<C> {
    /// Determines the result of a group; returns what its owner continues with, if that is possible
    /// now.
    pub(super) fn decide(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
        group: Group,
    ) -> Option<Answer> {
        let plan = Plan::of(image);
        let answer = match group.decision() {
            Decision::Open => {
                self.block(slot, Wait::Group(group), None);
                return None;
            }
            Decision::Value(value) => {
                self.evaporate_group(image, host, &group);
                let answer = Answer::Value(value);
                let is_open = group.children.iter().any(|c| self.slot_of(c).is_some());
                if is_open {
                    self.block(slot, Wait::Drain(Box::new(answer)), None);
                    return None;
                }
                return Some(answer);
            }
            Decision::Failure(failure) => failure,
            Decision::AllFailed(failures) => match composite(&plan, image, failures) {
                Ok(failure) => failure,
                Err(raise) => return Some(Answer::Raise(raise)),
            },
        };
        self.evaporate_group(image, host, &group);
        let is_root = self.live(slot).is_some_and(|l| l.task.is_none());
        let failure = if is_root {
            unwrapped(&plan, answer)
        } else {
            wrapped(&plan, image, answer)
        };
        Some(Answer::Raise(Raise::condition(failure)))
    }

    fn evaporate_group(&mut self, image: &mut Image, host: &mut dyn Host<Call = C>, group: &Group) {
        for child in &group.children {
            if let Some(slot) = self.slot_of(child) {
                self.evaporate(image, host, slot);
            }
        }
    }
}

/// A failure that contains other failures.
pub(crate) fn composite(
    plan: &Plan,
    image: &Image,
    failures: Vec<Value>,
) -> Result<Value, Box<Raise>> {
    let initargs = [plan.names.failures.into(), Value::list(failures)];
    condition::make_condition(image, plan.names.composite_failure, &initargs)
}

/// A condition as it leaves a task: a Lisp error is wrapped in an envelope.
pub(super) fn wrapped(plan: &Plan, image: &mut Image, condition: Value) -> Value {
    let Value::Instance(instance) = &condition else {
        return condition;
    };
    if !instance.is_a(known::ERROR) || instance.is_a(plan.names.plan_failure) {
        return condition;
    }
    let initargs = [plan.names.error.into(), condition.clone()];
    match condition::make_condition(image, plan.names.envelope, &initargs) {
        Ok(envelope) => {
            image.share_condition_calls(&condition, &envelope);
            envelope
        }
        Err(_) => condition,
    }
}

/// A condition as it leaves the plan, without its envelopes.
pub(crate) fn unwrapped(plan: &Plan, mut condition: Value) -> Value {
    loop {
        let inner = match &condition {
            Value::Instance(instance) if instance.is_a(plan.names.envelope) => {
                instance.slot(known::ERROR)
            }
            _ => None,
        };
        match inner {
            Some(inner) if !inner.is_unbound() => condition = inner,
            _ => return condition,
        }
    }
}
