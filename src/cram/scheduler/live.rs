//! The scheduler's data on a live task or root.

use super::Scheduler;
use super::group::Group;
use crate::fluent::FluentRef;
use crate::host::Ticket;
use crate::request::{Call, GroupKind};
use crate::task::{TaskId, TaskRef};
use lisp::value::Value;
use lisp::value::raise::Raise;
use lisp::vm::fiber::Fiber;

/// Index of an entry.
pub(super) type Slot = u32;

/// A task or a root.
pub(super) struct Live {
    pub id: TaskId,
    pub fiber: Fiber,
    /// The task; `None` for a root.
    pub task: Option<TaskRef>,
    pub parent: Option<Slot>,
    /// The root that it belongs to; `None` for a root itself.
    pub(crate) root: Option<Slot>,
    /// Children that are alive, in order of creation.
    pub(crate) children: Vec<Slot>,
    /// What it waits for.
    pub wait: Wait,
    /// Identifies its current wait.
    pub token: u64,
    /// What to do when it runs next; `None` while it waits or is dead.
    pub answer: Option<Answer>,
    /// Whether it is in the queue of ready entries.
    pub(crate) is_queued: bool,
    /// How it will end, once that is determined.
    pub ending: Option<Ending>,
    /// Whether it has begun to unwind.
    pub(crate) is_unwinding: bool,
    /// How many times cleanup code has escaped from unwinding.
    pub(crate) escapes: u32,
    /// Whether it is suspended.
    pub(crate) is_suspended: bool,
    /// If negative, it must not be suspended or evaporated now.
    pub(crate) scheduling: i32,
    /// Whether it was told to end or to suspend while that was forbidden.
    pub told: Told,
    /// Functions to call when it is suspended, innermost last.
    pub(crate) hooks: Vec<Value>,
    /// The wait that running hooks interrupt.
    pub set_aside: Option<Box<SetAside>>,
    /// When a sleep or timeout of its wait ends.
    pub until: Option<f64>,
    /// Entries that wait for its end.
    pub(crate) joiners: Vec<(Slot, u64)>,
}

/// What an entry waits for.
#[derive(Default)]
pub(super) enum Wait {
    /// Nothing: it is running or ready.
    #[default]
    Nothing,
    /// The end of a sleep.
    Sleep,
    /// A fluent.
    Fluent(FluentRef),
    /// Its children.
    Group(Group),
    /// The end of its children, to continue with this answer.
    Drain(Box<Answer>),
    /// The end of its children, to end itself.
    LastChildren,
    /// The host.
    Ticket(Ticket),
    /// The end of another task, to determine the result of the group.
    Join(Group),
    /// The end of another task.
    Death(TaskRef),
    /// To be woken up; it has suspended itself.
    WakeUp,
    /// The debugger, at an unhandled condition.
    Debugger,
}

/// A wait that hooks interrupt.
pub(super) struct SetAside {
    pub wait: Wait,
    pub until: Option<f64>,
    pub answer: Option<Answer>,
}

/// What to do with an entry's fiber when it runs next.
pub(super) enum Answer {
    /// Call a function in the new fiber.
    Start(Value, Vec<Value>),
    /// Continue with a value.
    Value(Value),
    /// Continue with an error.
    Raise(Box<Raise>),
    /// Continue after an interrupt.
    GoOn,
    /// Continue with a call on top.
    Call(Value, Vec<Value>),
    /// Unwind a frame and continue with a call in its place.
    Replace {
        /// The frame's index.
        frame: usize,
        /// The function and its arguments.
        call: (Value, Vec<Value>),
        /// The condition at which its task has stopped.
        condition: Option<Value>,
    },
    /// Begin the rest of its children.
    Begin(Box<Beginning>),
    /// Determine the result of its children.
    Decide(Group),
    /// Unwind everything.
    Unwind,
}

/// A group of tasks of which some have begun.
pub(super) struct Beginning {
    pub kind: GroupKind,
    /// What their names begin with.
    pub name: &'static str,
    /// What the others are to run.
    pub functions: std::vec::IntoIter<Call>,
    /// Those that have begun.
    pub(crate) children: Vec<TaskRef>,
    /// How many there will be.
    pub of: usize,
}

/// How a task ends.
pub(super) enum Ending {
    /// With values.
    Succeeded(Value),
    /// With a failure.
    Failed(Value),
    /// By evaporation.
    Evaporated,
}

/// What an entry was told to do while it could not.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Told {
    #[default]
    Nothing,
    Suspend,
    Evaporate,
}

impl Live {
    pub(crate) fn new(id: TaskId, answer: Answer) -> Live {
        Live {
            id,
            fiber: Fiber::default(),
            task: None,
            parent: None,
            root: None,
            children: Vec::new(),
            wait: Wait::Nothing,
            token: 0,
            answer: Some(answer),
            is_queued: false,
            ending: None,
            is_unwinding: false,
            escapes: 0,
            is_suspended: false,
            scheduling: 0,
            told: Told::Nothing,
            hooks: Vec::new(),
            set_aside: None,
            until: None,
            joiners: Vec::new(),
        }
    }

    /// Whether it may run although it is suspended, because it runs its hooks.
    pub(crate) fn runs_hooks(&self) -> bool {
        self.set_aside.is_some()
    }
}

impl<C: 'static> Scheduler<C> {
    /// Adds an entry.
    pub(super) fn add(&mut self, live: Live) -> Slot {
        let live = Some(Box::new(live));
        match self.free.pop() {
            Some(slot) => {
                self.entries[slot as usize] = live;
                slot
            }
            None => {
                self.entries.push(live);
                // Four billion live tasks do not fit into memory.
                u32::try_from(self.entries.len() - 1).unwrap_or(u32::MAX)
            }
        }
    }

    /// Removes an entry.
    pub(super) fn remove(&mut self, slot: Slot) -> Option<Box<Live>> {
        let live = self.entries.get_mut(slot as usize)?.take()?;
        self.free.push(slot);
        Some(live)
    }

    pub(super) fn live(&self, slot: Slot) -> Option<&Live> {
        self.entries.get(slot as usize)?.as_deref()
    }

    pub(super) fn live_mut(&mut self, slot: Slot) -> Option<&mut Live> {
        self.entries.get_mut(slot as usize)?.as_deref_mut()
    }

    /// The entry of a live task.
    pub(super) fn slot_of(&self, task: &TaskRef) -> Option<Slot> {
        let slot = task.get().slot.get()?;
        let live = self.live(slot)?;
        live.task.as_ref()?.is(task).then_some(slot)
    }

    pub(super) fn next_id(&mut self) -> TaskId {
        self.last_id += 1;
        TaskId(self.last_id)
    }

    /// Whether `slot` is `ancestor` or below it.
    pub(super) fn is_below(&self, slot: Slot, ancestor: Slot) -> bool {
        let mut current = Some(slot);
        while let Some(slot) = current {
            if slot == ancestor {
                return true;
            }
            current = self.live(slot).and_then(|l| l.parent);
        }
        false
    }
}
