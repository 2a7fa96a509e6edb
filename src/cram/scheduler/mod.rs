//! The scheduler: runs tasks, one at a time, and owns simulated time.
//!
//! A task runs until it waits for something. Ready tasks run in the order in which they became
//! ready; those woken by the same event, in order of creation. Time passes only when every task
//! waits: then the host steps the world until something happens, or time jumps to the next end of a
//! sleep. So the same input gives the same run.
//!
//! The prompt's own thread is a root: it has a fiber like a task, but is not a task. A root with an
//! unhandled condition stays where it is, so that the debugger can examine it, evaluate in another
//! root on top of it, and continue or abort.

mod advance;
mod answer;
mod asked;
mod beside;
mod companions;
mod debug;
mod dying;
mod finish;
mod group;
mod live;
mod overview;
mod requests;
mod root;
mod run;
mod suspension;
mod task_start;

pub(crate) use group::composite;
pub(crate) use group::unwrapped;
pub(crate) use overview::TaskInfo;
pub(crate) use requests::outside_a_plan;
pub use root::Evaluation;

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};
use std::marker::PhantomData;

use super::host::Ticket;
use super::task::TaskId;
use crate::task::{Status, TaskRef};
use advance::Alarm;
use lisp::image::Image;
use lisp::value::Value;
use lisp::vm::fiber::Fiber;
use live::{Live, Slot};

/// Runs tasks in an image; `C` is a call of the host ([`Host::Call`](crate::Host::Call)).
pub struct Scheduler<C> {
    /// Live tasks and roots; free entries are reused.
    entries: Vec<Option<Box<Live>>>,
    free: Vec<Slot>,
    /// Entries that are ready, in the order in which they will run.
    ready: VecDeque<(Slot, TaskId)>,
    /// Ends of sleeps and timeouts; those whose waits are over are skipped.
    alarms: BinaryHeap<Reverse<Alarm>>,
    /// Pending requests to the host, with the entries that made them.
    tickets: Vec<(Ticket, Slot)>,
    /// Whether a request has been cancelled or paused, and the world has not stood still since.
    must_stand_still: bool,
    /// Evaluations at the prompt that have not ended, innermost last.
    roots: Vec<Slot>,
    /// The fiber of a root that is over, for the next one.
    idle: Option<Fiber>,
    /// The entry that an interrupt stopped.
    interrupted: Option<Slot>,
    /// Whether a task with an unhandled condition stays where it is.
    stops_in_place: bool,
    /// Whether what would have to wait is an error.
    time_stands_still: bool,
    /// Tasks stopped at unhandled conditions, with the conditions, newest last.
    stops: Vec<(Slot, Value)>,
    /// The condition of a stop that has not been reported yet.
    untold_stop: Option<Value>,
    /// Tasks of the last plan that have ended, in the order in which they ended.
    ended: Vec<TaskInfo>,
    /// The root to which these tasks belong.
    ended_root: Option<TaskId>,
    /// Number of the last task or root.
    last_id: u64,
    /// Number of the last wait.
    last_token: u64,
    calls: PhantomData<fn(C)>,
}

impl<C> Default for Scheduler<C> {
    fn default() -> Self {
        Self {
            entries: Vec::new(),
            free: Vec::new(),
            ready: VecDeque::new(),
            alarms: BinaryHeap::new(),
            tickets: Vec::new(),
            must_stand_still: false,
            roots: Vec::new(),
            idle: None,
            interrupted: None,
            stops_in_place: false,
            time_stands_still: false,
            stops: Vec::new(),
            untold_stop: None,
            ended: Vec::new(),
            ended_root: None,
            last_id: 0,
            last_token: 0,
            calls: PhantomData,
        }
    }
}

impl<C: 'static> Scheduler<C> {
    /// A scheduler without tasks.
    pub fn new() -> Self {
        Scheduler::default()
    }

    /// A scheduler that will number tasks and waits as this one would; `None` if there are tasks, or
    /// ended ones that are remembered.
    pub fn copied(&self) -> Option<Self> {
        let is_idle = self.entries.iter().all(Option::is_none)
            && self.ready.is_empty()
            && self.tickets.is_empty()
            && self.roots.is_empty()
            && self.interrupted.is_none()
            && self.stops.is_empty()
            && self.untold_stop.is_none()
            && self.ended.is_empty();
        is_idle.then(|| Scheduler {
            entries: self.entries.iter().map(|_| None).collect(),
            free: self.free.clone(),
            must_stand_still: self.must_stand_still,
            stops_in_place: self.stops_in_place,
            time_stands_still: self.time_stands_still,
            ended_root: self.ended_root,
            last_id: self.last_id,
            last_token: self.last_token,
            ..Scheduler::default()
        })
    }

    /// Ends all tasks as they are, without running any of their cleanup code: after a panic in
    /// the middle of one.
    pub fn give_up(&mut self, image: &mut Image) {
        let tasks = self.entries.iter().flatten();
        let tasks: Vec<TaskRef> = tasks.filter_map(|live| live.task.clone()).collect();
        for task in tasks {
            if !task.get().status().is_dead() {
                self.set_status(image, &task, Status::Evaporated);
            }
        }
        *self = Scheduler {
            stops_in_place: self.stops_in_place,
            last_id: self.last_id,
            last_token: self.last_token,
            ..Scheduler::default()
        };
    }
}
