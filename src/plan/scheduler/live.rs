//! What the scheduler knows about a task or a root that is alive.

use super::Scheduler;
use super::group::Group;
use crate::lisp::value::Value;
use crate::lisp::value::raise::Raise;
use crate::lisp::vm::fiber::Fiber;
use crate::plan::fluent::FluentRef;
use crate::plan::host::Ticket;
use crate::plan::task::{TaskId, TaskRef};

/// Index of an entry.
pub(super) type Slot = u32;

/// A task or a root.
pub(super) struct Live {
    pub(crate) id: TaskId,
    pub(crate) fiber: Fiber,
    /// The task; a root has none.
    pub(crate) task: Option<TaskRef>,
    pub(crate) parent: Option<Slot>,
    /// Children that are alive, in order of creation.
    pub(crate) children: Vec<Slot>,
    /// What it waits for.
    pub(crate) wait: Wait,
    /// Tells its current wait from others.
    pub(crate) token: u64,
    /// What to do when it runs next; none while it waits or is dead.
    pub(crate) answer: Option<Answer>,
    /// Is it in the queue of the ready?
    pub(crate) is_queued: bool,
    /// How it will end, once that is decided.
    pub(crate) ending: Option<Ending>,
    /// Has it begun to unwind?
    pub(crate) is_unwinding: bool,
    /// How often cleanup code has left the unwinding that called it.
    pub(crate) escapes: u32,
    /// Is it suspended?
    pub(crate) is_suspended: bool,
    /// Negative: it may not be suspended or evaporated now.
    pub(crate) scheduling: i32,
    /// Was it told to end, or to hold still, at a time when that was forbidden?
    pub(crate) told: Told,
    /// What to call when it is suspended, innermost last.
    pub(crate) hooks: Vec<Value>,
    /// What the running hooks interrupt.
    pub(crate) set_aside: Option<Box<SetAside>>,
    /// When a sleep or timeout of its wait ends.
    pub(crate) until: Option<f64>,
    /// Entries that wait for its end.
    pub(crate) joiners: Vec<(Slot, u64)>,
}

/// What an entry waits for.
#[derive(Default)]
pub(super) enum Wait {
    /// Nothing: it runs or is ready.
    #[default]
    Nothing,
    /// The end of a sleep.
    Sleep,
    /// A fluent.
    Fluent(FluentRef),
    /// Its children.
    Group(Group),
    /// The end of its children, then to go on with this answer.
    Drain(Box<Answer>),
    /// The end of its children, then its own.
    LastChildren,
    /// The host.
    Ticket(Ticket),
    /// The end of another task, then to decide what comes of it.
    Join(Group),
    /// The end of another task.
    Death(TaskRef),
    /// Somebody who wakes it up; it has suspended itself.
    WakeUp,
    /// A debugger: its condition was not handled.
    Debugger,
}

/// A wait that hooks interrupt.
pub(super) struct SetAside {
    pub(crate) wait: Wait,
    pub(crate) until: Option<f64>,
    pub(crate) answer: Option<Answer>,
}

/// What to do with an entry's fiber when it runs next.
pub(super) enum Answer {
    /// Call a function in the fresh fiber.
    Start(Value, Vec<Value>),
    /// Go on with a value.
    Value(Value),
    /// Go on with an error.
    Raise(Box<Raise>),
    /// Go on after an interrupt.
    GoOn,
    /// Go on with a call on top.
    Call(Value, Vec<Value>),
    /// Leave the frame of this index and go on with a call in its place.
    Replace(usize, Value, Vec<Value>),
    /// Decide what comes of its children.
    Decide(Group),
    /// Leave everything.
    Unwind,
}

/// How a task ends.
pub(super) enum Ending {
    /// With values.
    Succeeded(Value),
    /// With a failure.
    Failed(Value),
    /// Told to.
    Evaporated,
}

/// What an entry was told while it could not obey.
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

    /// May it run while it is suspended: does it run its hooks?
    pub(crate) fn runs_hooks(&self) -> bool {
        self.set_aside.is_some()
    }
}

impl Scheduler {
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
                // Four billion live tasks do not fit in memory.
                u32::try_from(self.entries.len() - 1).unwrap_or(u32::MAX)
            }
        }
    }

    /// Forgets an entry.
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

    /// The entry of a task that is alive.
    pub(super) fn slot_of(&self, task: &TaskRef) -> Option<Slot> {
        let slot = task.get().slot.get()?;
        let live = self.live(slot)?;
        live.task.as_ref()?.is(task).then_some(slot)
    }

    pub(super) fn next_id(&mut self) -> TaskId {
        self.last_id += 1;
        TaskId(self.last_id)
    }

    /// Is `slot` below `ancestor`, or the same?
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
