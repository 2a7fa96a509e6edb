//! Handles the requests of builtins.

use std::any::Any;

use super::Scheduler;
use super::asked::Asked;
use super::beside::STANDS_STILL;
use super::group::Group;
use super::live::{Answer, Beginning, Slot, Told, Wait};
use crate::host::{Host, Reply};
use crate::request::{GroupKind, Request};
use crate::state::Plan;
use crate::task::{Status, Task, TaskName, TaskRef};
use crate::tree::TreeNode;
use lisp::guard::Stopped;
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::fiber::Fiber;

/// About how much memory a task takes that has just begun.
const BYTES_OF_A_TASK: usize = 1024;
/// How many tasks are begun between two looks at the interrupt flag.
const TASKS_AT_ONCE: usize = 1000;

impl<C: 'static> Scheduler<C> {
    /// Handles a request of the entry that is running with `fiber`; returns the answer, or `None`
    /// if the entry has to wait.
    pub(super) fn handle(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
        fiber: &Fiber,
        request: Box<dyn Any>,
    ) -> Option<Answer> {
        let request = match Asked::of(request) {
            Some(Asked::Scheduler(request)) => request,
            Some(Asked::Motion(motion)) => {
                let reply = host.perform(image, self.live(slot)?.id, motion);
                return self.replied(image, host, slot, reply);
            }
            Some(Asked::Host(call)) => {
                let reply = host.call(image, self.live(slot)?.id, call);
                return self.replied(image, host, slot, reply);
            }
            None => {
                return Some(Answer::Raise(Raise::control("This cannot be waited for.")));
            }
        };
        let plan = Plan::of(image);
        match request {
            Request::Sleep(seconds) => match plan.after(seconds) {
                Ok(end) => self.block(slot, Wait::Sleep, Some(end)),
                Err(raise) => return Some(Answer::Raise(raise)),
            },
            Request::Wait { fluent, until } => self.block(slot, Wait::Fluent(fluent), until),
            Request::TopLevel { name, function } => {
                let tree = match name {
                    Some(name) => {
                        let mut trees = plan.trees.borrow_mut();
                        let tree = trees.entry(name);
                        tree.or_insert_with(|| TreeNode::new(Value::NIL)).clone()
                    }
                    None => TreeNode::new(Value::NIL),
                };
                tree.restart();
                let what = match name {
                    Some(name) => format!("{}-TOP-LEVEL", image.name(name)),
                    None => "TOP-LEVEL".to_owned(),
                };
                let name = TaskName::Numbered(what.into(), plan.fresh_number());
                let task = TaskRef::new(&plan, name, true, tree);
                self.begin(image, slot, fiber, &task, (function, Vec::new()));
                self.wait_for_group(slot, GroupKind::All, vec![task]);
            }
            Request::Group {
                kind,
                functions,
                name,
            } => {
                if self.live(slot).is_none_or(|live| live.task.is_none()) {
                    let raise = if self.time_stands_still {
                        Raise::simple(STANDS_STILL)
                    } else {
                        outside_a_plan(name)
                    };
                    return Some(Answer::Raise(raise));
                }
                if functions.is_empty() {
                    return Some(Answer::Raise(Raise::simple(
                        "wait-for called with nil argument.",
                    )));
                }
                let of = functions.len();
                if image
                    .limits
                    .heap
                    .lacks_room_for(of.saturating_mul(BYTES_OF_A_TASK))
                {
                    return Some(Answer::Raise(Stopped::HeapExhausted.into()));
                }
                return Some(Answer::Begin(Box::new(Beginning {
                    kind,
                    name,
                    functions: functions.into_iter(),
                    children: Vec::with_capacity(of),
                    of,
                })));
            }
            Request::Run { task, function } => {
                if task.get().status() != Status::Created {
                    return Some(Answer::Raise(Raise::simple(format!(
                        "The task {} has run already.",
                        task.get().name
                    ))));
                }
                self.begin(image, slot, fiber, &task, (function, Vec::new()));
                self.wait_for_group(slot, GroupKind::All, vec![task]);
            }
            Request::Join(task) => return self.join(slot, task),
            Request::Evaporate { task, sync } => {
                return self.told_to_evaporate(image, host, slot, &task, sync);
            }
            Request::Suspend(task) => match self.slot_of(&task) {
                Some(target) => {
                    self.suspend(image, host, target);
                    if self.live(slot).is_some_and(|l| l.is_suspended) {
                        self.block(slot, Wait::WakeUp, None);
                    } else {
                        return Some(Answer::Value(Value::NIL));
                    }
                }
                None => {
                    hold(task.get(), true);
                    return Some(Answer::Value(Value::NIL));
                }
            },
            Request::WakeUp(task) => {
                match self.slot_of(&task) {
                    Some(target) => self.wake_up(image, host, target),
                    None => hold(task.get(), false),
                }
                return Some(Answer::Value(Value::NIL));
            }
            Request::Hook(hook) => {
                if let Some(live) = self.live_mut(slot) {
                    match hook {
                        Some(hook) => live.hooks.push(hook),
                        None => {
                            live.hooks.pop();
                        }
                    }
                }
                return Some(Answer::Value(Value::NIL));
            }
            Request::Overview => {
                let text = self.task_tree(image);
                return Some(Answer::Value(Value::string(text)));
            }
            Request::HooksDone => self.resume_aside(slot),
            Request::Scheduling(change) => {
                return self.allow_scheduling(image, host, slot, change);
            }
        }
        None
    }

    /// Handles the host's reply to what the entry has asked of it.
    fn replied(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
        reply: Reply,
    ) -> Option<Answer> {
        match reply {
            Reply::Now(Ok(value)) => Some(Answer::Value(value)),
            Reply::Now(Err(raise)) => Some(Answer::Raise(raise)),
            Reply::Later(ticket) if self.time_stands_still => {
                host.cancel(image, ticket);
                Some(Answer::Raise(Raise::simple(STANDS_STILL)))
            }
            Reply::Later(ticket) => {
                self.tickets.push((ticket, slot));
                self.block(slot, Wait::Ticket(ticket), None);
                None
            }
        }
    }

    /// Begins some of the tasks of a group; returns how to go on, or `None` if all have begun.
    pub(super) fn begin_some(
        &mut self,
        image: &Image,
        slot: Slot,
        fiber: &Fiber,
        mut group: Box<Beginning>,
    ) -> Option<Answer> {
        let owner = self.live(slot)?.task.clone()?;
        let plan = Plan::of(image);
        for function in group.functions.by_ref().take(TASKS_AT_ONCE) {
            let number = group.children.len() + 1;
            let name = TaskName::Child(group.name, number, group.of, plan.fresh_number());
            let task = TaskRef::new(&plan, name, false, owner.get().node.clone());
            self.begin(image, slot, fiber, &task, function);
            group.children.push(task);
        }
        if group.functions.len() > 0 {
            return Some(Answer::Begin(group));
        }
        self.wait_for_group(slot, group.kind, group.children);
        None
    }

    fn wait_for_group(&mut self, slot: Slot, kind: GroupKind, children: Vec<TaskRef>) {
        self.block(slot, Wait::Group(Group { kind, children }), None);
    }

    fn join(&mut self, slot: Slot, task: TaskRef) -> Option<Answer> {
        let is_own = self.live(slot).and_then(|l| l.task.as_ref());
        if is_own.is_some_and(|own| own.is(&task)) {
            return Some(Answer::Raise(Raise::simple("Cannot join current task.")));
        }
        let group = Group {
            kind: GroupKind::All,
            children: vec![task.clone()],
        };
        match self.slot_of(&task) {
            None if task.get().status().is_dead() => Some(Answer::Decide(group)),
            None => Some(Answer::Raise(Raise::simple(format!(
                "The task {} has not begun: nothing runs it.",
                task.get().name
            )))),
            Some(target) => {
                self.block(slot, Wait::Join(group), None);
                self.add_joiner(target, slot);
                None
            }
        }
    }

    pub(super) fn add_joiner(&mut self, target: Slot, joiner: Slot) {
        let token = self.live(joiner).map_or(0, |l| l.token);
        if let Some(target) = self.live_mut(target) {
            target.joiners.push((joiner, token));
        }
    }

    fn told_to_evaporate(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
        task: &TaskRef,
        sync: bool,
    ) -> Option<Answer> {
        let nil = Some(Answer::Value(Value::NIL));
        let Some(target) = self.slot_of(task) else {
            if task.get().status() == Status::Created {
                self.set_status(image, task, Status::Evaporated);
            }
            return nil;
        };
        let is_own = self.is_below(slot, target);
        if is_own && self.live(slot).is_some_and(|l| l.scheduling < 0) {
            self.evaporate(image, host, target);
            return nil;
        }
        self.evaporate(image, host, target);
        if is_own {
            // It has been made ready to unwind.
            return None;
        }
        if sync && self.slot_of(task).is_some() {
            self.block(slot, Wait::Death(task.clone()), None);
            self.add_joiner(target, slot);
            return None;
        }
        nil
    }

    fn allow_scheduling(
        &mut self,
        image: &mut Image,
        host: &mut dyn Host<Call = C>,
        slot: Slot,
        change: i32,
    ) -> Option<Answer> {
        let live = self.live_mut(slot)?;
        live.scheduling = live.scheduling.saturating_add(change);
        if live.scheduling < 0 || live.ending.is_some() {
            return Some(Answer::Value(Value::NIL));
        }
        match std::mem::take(&mut live.told) {
            Told::Nothing => Some(Answer::Value(Value::NIL)),
            Told::Evaporate => {
                self.evaporate(image, host, slot);
                None
            }
            Told::Suspend => {
                self.suspend(image, host, slot);
                self.block(slot, Wait::WakeUp, None);
                None
            }
        }
    }
}

/// Sets whether a task that has not begun is to be suspended when it begins.
fn hold(task: &Task, held: bool) {
    if task.status() == Status::Created {
        task.is_held.set(held);
    }
}

/// The error for a form that must be inside a plan.
pub(crate) fn outside_a_plan(name: &str) -> Box<Raise> {
    Raise::simple(format!("'{name}' form not inside a plan."))
}
