//! Tasks that stop at an unhandled condition, so that the user can examine them and decide how to
//! continue.

use indexmap::IndexMap;

use super::Scheduler;
use super::group::{unwrapped, wrapped};
use super::live::{Answer, Slot, Wait};
use super::overview::TaskInfo;
use super::root::Evaluation;
use crate::host::Host;
use crate::request::GroupKind;
use crate::state::Plan;
use crate::task::TaskId;
use lisp::image::Image;
use lisp::value::Value;
use lisp::vm::fiber::{Dynamic, Fiber};

impl<C: 'static> Scheduler<C> {
    /// Sets whether a task stops where it is at a condition that no handler in it or further out
    /// will handle; by default, it fails.
    pub fn set_stops_in_place(&mut self, stops: bool) {
        self.stops_in_place = stops;
    }

    /// The task or root that stopped last.
    fn stopped(&self) -> Option<Slot> {
        let of_task = self.stops.last().map(|(slot, _)| *slot);
        let of_root = || {
            let root = self.roots.last().copied()?;
            let live = self.live(root)?;
            matches!(live.wait, Wait::Debugger).then_some(root)
        };
        of_task.or_else(of_root)
    }

    /// Identifies the task or root that stopped last.
    pub fn stopped_id(&self) -> Option<TaskId> {
        self.live(self.stopped()?).map(|live| live.id)
    }

    /// The tasks that stand still at unhandled conditions and those that wait for them, in order
    /// of creation, each with the condition.
    pub fn stopped_tasks(&self, image: &Image) -> Vec<(TaskInfo, Value)> {
        if self.stops.is_empty() {
            return Vec::new();
        }
        let mut conditions: IndexMap<TaskId, &Value> = IndexMap::new();
        for (slot, condition) in self.stops.iter().rev() {
            let chain = std::iter::successors(Some(*slot), |slot| self.live(*slot)?.parent);
            for live in chain.filter_map(|slot| self.live(slot)) {
                conditions.entry(live.id).or_insert(condition);
            }
        }
        let tasks = self.tasks(image).into_iter();
        tasks
            .filter_map(|task| {
                let condition = conditions.get(&task.id)?;
                Some((task, Value::clone(condition)))
            })
            .collect()
    }

    /// The stopped or interrupted entry and those above it, the root last.
    pub(super) fn stopped_chain(&self) -> Vec<Slot> {
        let stopped = self.interrupted.or_else(|| self.stopped());
        let first = stopped.or_else(|| self.waited_for());
        std::iter::successors(first, |slot| self.live(*slot)?.parent).collect()
    }

    /// The fibers of the task that stopped last and of those that wait for it, innermost
    /// first.
    pub fn stopped_fibers(&self) -> Vec<&Fiber> {
        let chain = self.stopped_chain();
        chain
            .iter()
            .filter_map(|slot| self.live(*slot))
            .map(|live| &live.fiber)
            .collect()
    }

    /// The fiber of the task that stopped last.
    pub fn stopped_fiber(&mut self) -> Option<&mut Fiber> {
        let slot = self.stopped()?;
        self.live_mut(slot).map(|live| &mut live.fiber)
    }

    /// Whether the host has pending requests.
    pub fn has_requests(&self) -> bool {
        !self.tickets.is_empty()
    }

    /// Removes the last stop, because its entry is about to continue.
    pub(super) fn leave_stop(&mut self) -> Option<Slot> {
        let slot = self.stopped()?;
        self.stops.pop();
        if let Some(live) = self.live_mut(slot) {
            live.ending = None;
        }
        Some(slot)
    }

    /// Reports the last stop again, because nothing else can continue.
    pub(super) fn tell_stop_again(&mut self) -> bool {
        self.untold_stop = self.stops.last().map(|(_, condition)| condition.clone());
        self.untold_stop.is_some()
    }

    /// Unwinds a stack frame and everything called from it, and continues with a call in its place.
    /// The frame belongs to the `link`th of the stopped fibers; tasks begun further in are ended
    /// first.
    pub fn replace_frame(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        (link, frame): (usize, usize),
        call: (Value, Vec<Value>),
    ) -> Evaluation {
        let Some(slot) = self.stopped_chain().get(link).copied() else {
            return self.go_on(image, host);
        };
        let condition = self.stops.last().map(|(_, condition)| condition.clone());
        self.leave_stop();
        if link > 0 {
            self.leave_wait(slot);
            self.evaporate_children(image, host, slot);
            self.drain(image, host, slot);
            let alive: Vec<bool> = self
                .stops
                .iter()
                .map(|(s, _)| self.live(*s).is_some())
                .collect();
            let mut alive = alive.into_iter();
            self.stops.retain(|_| alive.next().unwrap_or(false));
        }
        let answer = Answer::Replace {
            frame,
            call,
            condition,
        };
        self.make_ready(slot, answer);
        self.go_on(image, host)
    }

    /// Whether a task stops here because its condition will not be handled.
    pub(super) fn may_stop(&self, image: &mut Image, slot: Slot, condition: &Value) -> bool {
        self.stops_in_place
            && self.live(slot).is_some_and(|live| live.ending.is_none())
            && !self.is_handled_above(image, slot, condition)
    }

    /// Whether there is a handler for the condition with which the task fails, even one that
    /// declines.
    fn is_handled_above(&self, image: &mut Image, slot: Slot, condition: &Value) -> bool {
        let plan = Plan::of(image);
        let in_task = wrapped(&plan, image, condition.clone());
        let mut current = slot;
        loop {
            let Some(live) = self.live(current) else {
                return true;
            };
            let Some(parent) = live.parent.and_then(|parent| self.live(parent)) else {
                return true;
            };
            let waits = match &parent.wait {
                Wait::Group(group) => {
                    let is_member = |task| group.children.iter().any(|c| c.is(task));
                    let others = group.children.len() > 1 && group.kind == GroupKind::Any;
                    live.task.as_ref().is_some_and(is_member) && !others
                }
                _ => false,
            };
            if !waits || !live.joiners.is_empty() {
                return true;
            }
            let is_root = parent.task.is_none();
            let as_seen = if is_root {
                unwrapped(&plan, condition.clone())
            } else {
                in_task.clone()
            };
            if has_handler(image, &parent.fiber, &as_seen) {
                return true;
            }
            match live.parent {
                Some(parent) if !is_root => current = parent,
                _ => return false,
            }
        }
    }
}

fn has_handler(image: &mut Image, fiber: &Fiber, condition: &Value) -> bool {
    fiber.dynamic.iter().any(|entry| match entry {
        Dynamic::Handlers(handlers) => handlers.iter().any(|handler| {
            lisp::evaluator::matching::is_of_type(image, condition, &handler.condition_type)
                .unwrap_or(true)
        }),
        _ => false,
    })
}
