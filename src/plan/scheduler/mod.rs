//! The scheduler: runs tasks, one at a time, and owns simulated time.
//!
//! A task runs until it waits for something. Tasks that are ready run in the order in
//! which they became so; those that one event wakes, in order of creation. Time passes only
//! when every task waits: then the host steps the world until something happens, or time
//! jumps to the next end of a sleep. The same input so gives the same run.
//!
//! The prompt's own thread is a root: it has a fiber like a task, but is none. A root whose
//! condition nobody handles stays where it is, so that a debugger can look at it, evaluate
//! in another root on top of it, and go on or abort.

mod advance;
mod answer;
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
pub(crate) use overview::TaskInfo;
pub(crate) use requests::outside_a_plan;
pub(crate) use root::Evaluation;

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use super::host::Ticket;
use super::task::TaskId;
use crate::lisp::value::Value;
use advance::Alarm;
use live::{Live, Slot};

/// Runs tasks on an image.
#[derive(Default)]
pub(crate) struct Scheduler {
    /// Tasks and roots that are alive; entries are used again.
    entries: Vec<Option<Box<Live>>>,
    free: Vec<Slot>,
    /// Entries that are ready, in the order in which they are to run.
    ready: VecDeque<(Slot, TaskId)>,
    /// Ends of sleeps and timeouts; those of waits that are over are skipped.
    alarms: BinaryHeap<Reverse<Alarm>>,
    /// Requests that the host works on, with who made them.
    tickets: Vec<(Ticket, Slot)>,
    /// Evaluations at the prompt that have not ended, innermost last.
    roots: Vec<Slot>,
    /// The entry that an interrupt stopped.
    interrupted: Option<Slot>,
    /// Does a task whose condition nobody handles stay where it is?
    stops_in_place: bool,
    /// Tasks that have stopped so, with their conditions, newest last.
    stops: Vec<(Slot, Value)>,
    /// The condition of a stop that has not been told yet.
    untold_stop: Option<Value>,
    /// Tasks of the last plan that have ended, in the order in which they did.
    ended: Vec<TaskInfo>,
    /// The root whose tasks these are.
    ended_root: Option<TaskId>,
    /// Number of the last task or root.
    last_id: u64,
    /// Number of the last wait.
    last_token: u64,
}

impl Scheduler {
    /// A scheduler without tasks.
    pub(crate) fn new() -> Scheduler {
        Scheduler::default()
    }
}
