//! The beginning and the end of tasks.

use super::group::unwrapped;
use super::live::{Answer, Ending, Live, Slot, Told, Wait};
use super::task_start;
use super::{Scheduler, TaskInfo};
use crate::fluent;
use crate::journal::{Change, TaskChange};
use crate::request::Call;
use crate::state::Plan;
use crate::task::{Status, TaskId, TaskRef};
use lisp::image::Image;
use lisp::value::Value;
use lisp::value::function::Function;
use lisp::value::known;
use lisp::value::package::PackageTable;
use lisp::value::symbol::Sym;
use lisp::vm::fiber::{Dynamic, Fiber};

/// The value of a special variable in a fiber that is not running.
fn value_in(image: &Image, fiber: &Fiber, sym: Sym) -> Value {
    let bound = fiber.dynamic.iter().rev().find_map(|entry| match entry {
        Dynamic::Bind(s, value) if *s == sym => Some(value.clone()),
        _ => None,
    });
    bound.unwrap_or_else(|| image.special(sym).clone())
}

impl<C: 'static> Scheduler<C> {
    /// Begins a task as a child of an entry, whose fiber is `parent_fiber`.
    pub(super) fn begin(
        &mut self,
        image: &Image,
        parent: Slot,
        parent_fiber: &Fiber,
        task: &TaskRef,
        (mut function, mut args): Call,
    ) {
        let plan = Plan::of(image);
        let names = &plan.names;
        let inner = task.get();
        let id = self.next_id();
        let mut fiber = Fiber::default();
        fiber.bind(known::V_PACKAGE, Value::Package(PackageTable::USER));
        fiber.bind(names.current_task, task.value());
        fiber.bind(names.current_path, inner.node.path.clone());
        let mut initialisers = Vec::new();
        for (variable, init) in plan.task_variables.borrow().iter() {
            let value = value_in(image, parent_fiber, *variable);
            if let Some(init) = init {
                let owner = value_in(image, parent_fiber, names.current_task);
                let args = vec![task.value(), owner, value.clone()];
                initialisers.push((*variable, init.clone(), args));
            }
            fiber.bind(*variable, value);
        }
        let constraints = inner.constraints.take();
        if !constraints.is_empty() {
            function = task_start::constrained(&plan, (function, args), constraints);
            args = Vec::new();
        }
        if !initialisers.is_empty() {
            function = task_start::initialised(&plan, (function, args), initialisers);
            args = Vec::new();
        }
        let mut live = Live::new(id, Answer::Start(function, args));
        live.fiber = fiber;
        live.task = Some(task.clone());
        live.parent = Some(parent);
        if inner.is_held.take() {
            live.told = Told::Suspend;
        }
        let root = self.live(parent).and_then(|parent| parent.root);
        let root = root.unwrap_or(parent);
        live.root = Some(root);
        if let Some(root) = self.live(root).map(|live| live.id) {
            self.note_begun(root);
        }
        let slot = self.add(live);
        inner.slot.set(Some(slot));
        if let Some(parent) = self.live_mut(parent) {
            parent.children.push(slot);
        }
        self.enqueue(slot);
    }

    /// Notes the status of a live task in the journal.
    fn note(&self, plan: &Plan, slot: Slot, status: Status) {
        if !plan.journal.is_kept() {
            return;
        }
        let Some(live) = self.live(slot) else { return };
        let Some(task) = &live.task else { return };
        let parent = live.parent.and_then(|slot| self.task_id(slot));
        plan.journal.note(Change::Task(TaskChange {
            id: live.id,
            starter: parent.map(|parent| plan.starter(parent)),
            name: task.get().name.to_string(),
            status,
            failure: None,
            time: plan.now(),
        }));
    }

    /// The number of the task at an entry; `None` for a root.
    fn task_id(&self, slot: Slot) -> Option<TaskId> {
        let live = self.live(slot)?;
        live.task.as_ref().map(|_| live.id)
    }

    /// Sets a task's status and wakes those that wait for its fluent.
    pub(super) fn set_status(&mut self, image: &mut Image, task: &TaskRef, status: Status) {
        if task.get().status() == status {
            return;
        }
        task.get().set_status(status);
        if let Some(slot) = self.slot_of(task) {
            self.note(&Plan::of(image), slot, status);
        }
        let Some(fluent) = task.get().known_fluent().cloned() else {
            return;
        };
        let keyword = status.keyword(&Plan::of(image).names).into();
        if let Some(rest) = fluent::settle(image, &fluent, keyword) {
            self.add_helper(image, rest);
        }
    }

    /// Adds a fiber for the calls of Lisp functions that a change of status causes.
    fn add_helper(&mut self, image: &Image, rest: fluent::Propagation) {
        let names = Plan::of(image).names;
        let rest = std::cell::Cell::new(Some(rest));
        let function = Function::made_control(names.sys_propagate, (0, Some(0)), move |m, _| {
            match rest.take() {
                Some(rest) => rest.spread(m),
                None => Ok(lisp::vm::step::Step::Return(Value::NIL)),
            }
        });
        let id = self.next_id();
        let start = Answer::Start(Value::Function(function), Vec::new());
        let slot = self.add(Live::new(id, start));
        self.enqueue(slot);
    }

    /// Call when an entry's function has returned: the entry ends when its children have ended.
    pub(super) fn returned(
        &mut self,
        image: &mut Image,
        host: &mut dyn crate::host::Host<Call = C>,
        slot: Slot,
        value: Value,
    ) {
        let Some(live) = self.live_mut(slot) else {
            return;
        };
        if live.ending.is_none() {
            live.ending = Some(Ending::Succeeded(value));
        }
        if live.children.is_empty() {
            self.end(image, slot);
        } else {
            self.evaporate_children(image, host, slot);
            // Some may have ended at once.
            let is_alone = self.live(slot).is_some_and(|l| l.children.is_empty());
            if is_alone {
                self.end(image, slot);
            } else {
                self.block(slot, Wait::LastChildren, None);
            }
        }
    }

    /// Ends an entry. Live children, which exist only after a failure, are handed over to its
    /// parent.
    pub(super) fn end(&mut self, image: &mut Image, slot: Slot) {
        let mut ended = Some(slot);
        while let Some(slot) = ended {
            ended = self.end_one(image, slot);
        }
    }

    /// Ends an entry; returns the parent if it was only waiting for that and ends, too.
    fn end_one(&mut self, image: &mut Image, slot: Slot) -> Option<Slot> {
        if self.roots.contains(&slot) {
            // The caller of the evaluation removes roots.
            let live = self.live_mut(slot)?;
            live.wait = Wait::Nothing;
            live.answer = None;
            return None;
        }
        let live = self.remove(slot)?;
        let parent = live.parent.and_then(|slot| self.task_id(slot));
        let ending = live.ending.unwrap_or(Ending::Evaporated);
        let (status, result) = match ending {
            Ending::Succeeded(value) => (Status::Succeeded, value),
            Ending::Failed(condition) => (Status::Failed, condition),
            Ending::Evaporated => (Status::Evaporated, Value::values(Vec::new())),
        };
        if let Some(task) = &live.task {
            let plan = Plan::of(image);
            if plan.journal.is_kept() {
                let failure = (status == Status::Failed).then(|| unwrapped(&plan, result.clone()));
                plan.journal.note(Change::Task(TaskChange {
                    id: live.id,
                    starter: parent.map(|parent| plan.starter(parent)),
                    name: task.get().name.to_string(),
                    status,
                    failure,
                    time: plan.now(),
                }));
            }
            if !result.is_plain() {
                task.note();
            }
            *task.get().result.borrow_mut() = result;
            task.get().slot.set(None);
            let parent = live.parent.and_then(|slot| self.live(slot));
            let parent = parent.filter(|p| p.task.is_some()).map(|p| p.id);
            self.note_ended(TaskInfo {
                id: live.id,
                name: task.get().name.to_string(),
                status,
                parent,
                path: task.get().node.path.clone(),
                waits_for: None,
            });
        }
        for child in &live.children {
            if let Some(child) = self.live_mut(*child) {
                child.parent = live.parent;
            }
        }
        // The status is set before any other task runs; the parent runs before others that wait.
        if let Some(task) = &live.task {
            task.get().set_status(status);
        }
        let ended = live
            .parent
            .filter(|parent| self.child_has_ended(*parent, slot, &live.children));
        for (joiner, token) in live.joiners {
            let is_current = self.live(joiner).is_some_and(|l| l.token == token);
            if !is_current {
                continue;
            }
            let answer = match self.leave_wait(joiner) {
                Wait::Join(group) => Answer::Decide(group),
                _ => Answer::Value(Value::NIL),
            };
            self.make_ready(joiner, answer);
        }
        if let Some(task) = &live.task
            && let Some(fluent) = task.get().known_fluent().cloned()
        {
            let keyword = status.keyword(&Plan::of(image).names).into();
            if let Some(rest) = fluent::settle(image, &fluent, keyword) {
                self.add_helper(image, rest);
            }
        }
        ended
    }

    /// Informs an entry that a child has ended; returns whether the entry ends with it.
    fn child_has_ended(&mut self, parent: Slot, child: Slot, orphans: &[Slot]) -> bool {
        let Some(live) = self.live_mut(parent) else {
            return false;
        };
        live.children.retain(|c| *c != child);
        live.children.extend_from_slice(orphans);
        let is_alone = live.children.is_empty();
        match std::mem::take(&mut live.wait) {
            Wait::Group(group) => self.make_ready(parent, Answer::Decide(group)),
            Wait::Drain(answer) if is_alone => self.make_ready(parent, *answer),
            Wait::LastChildren if is_alone => match &live.ending {
                Some(Ending::Evaporated) => self.make_ready(parent, Answer::Unwind),
                _ => return true,
            },
            wait => live.wait = wait,
        }
        false
    }
}
