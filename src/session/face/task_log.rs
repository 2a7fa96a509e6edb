//! The tasks, actions and motions of a session, as a tree.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use super::plan_event::{PlanEvent, PlanEventKind};
use view::watch::{About, TaskId, TaskState};

/// Maximum number of tasks, actions and motions that are kept.
const MAX_NODES: usize = 100_000;

/// What has been done since it was made, or since it was cleared. See
/// [`Session::log_tasks`](crate::Session::log_tasks).
#[derive(Clone, Default)]
pub struct TaskLog(Rc<RefCell<Vec<TaskNode>>>);

/// A task, an action or a motion, with what it has started.
#[derive(Clone, PartialEq, Debug)]
pub struct TaskNode {
    /// Which; it also tells whether it is a task, an action or a motion.
    pub id: TaskId,
    /// What has started it; `None` if it was started from outside a plan.
    pub parent: Option<TaskId>,
    /// The name of the task, or the type of the action or motion.
    pub name: String,
    /// What the designator of an action or motion says, and where it is performed.
    pub about: Option<Arc<About>>,
    /// Whether it runs, or how it has ended.
    pub state: TaskState,
    /// The class of its failure and the report, if it has failed.
    pub failure: Option<(String, String)>,
    /// Simulated time (s) at which it began.
    pub began: f64,
    /// Simulated time (s) at which it ended.
    pub ended: Option<f64>,
    /// What it has started, in order.
    pub children: Vec<TaskNode>,
}

impl TaskLog {
    /// The tree: what was started from outside a plan, or by what is not in the log, in order.
    pub fn tree(&self) -> Vec<TaskNode> {
        let mut nodes: Vec<Option<TaskNode>> = self.0.borrow().iter().cloned().map(Some).collect();
        let places = nodes.iter().enumerate().filter_map(|(at, node)| {
            let id = node.as_ref()?.id;
            Some((id, at))
        });
        let places: std::collections::BTreeMap<TaskId, usize> = places.collect();
        let mut roots = Vec::new();
        // What is started begins later than what starts it, so it has its own children by now.
        for at in (0..nodes.len()).rev() {
            let Some(mut node) = nodes.get_mut(at).and_then(Option::take) else {
                continue;
            };
            node.children.reverse();
            let parent = node.parent.and_then(|id| places.get(&id));
            let parent = parent.filter(|parent| **parent < at);
            match parent.and_then(|parent| nodes.get_mut(*parent)?.as_mut()) {
                Some(parent) => parent.children.push(node),
                None => roots.push(node),
            }
        }
        roots.reverse();
        roots
    }

    /// Forgets all that has been done.
    pub fn clear(&self) {
        self.0.borrow_mut().clear();
    }

    /// Notes an event.
    pub(super) fn note(&self, event: &PlanEvent) {
        let mut nodes = self.0.borrow_mut();
        let (id, state) = match &event.kind {
            PlanEventKind::Began(begin) => {
                if nodes.len() < MAX_NODES {
                    nodes.push(TaskNode {
                        id: begin.id,
                        parent: begin.parent,
                        name: begin.name.clone(),
                        about: begin.about.clone(),
                        state: TaskState::Running,
                        failure: None,
                        began: event.time,
                        ended: None,
                        children: Vec::new(),
                    });
                }
                return;
            }
            PlanEventKind::Suspended(id) => (*id, TaskState::Suspended),
            PlanEventKind::Continued(id) => (*id, TaskState::Running),
            PlanEventKind::Ended(end) => (end.id, end.state),
            _ => return,
        };
        let Some(node) = nodes.iter_mut().rev().find(|node| node.id == id) else {
            return;
        };
        node.state = state;
        if let PlanEventKind::Ended(end) = &event.kind {
            node.failure.clone_from(&end.failure);
            node.ended = Some(event.time);
        }
    }
}

impl TaskNode {
    /// This node and all below it, each before its children.
    pub fn all(&self) -> impl Iterator<Item = &TaskNode> {
        let mut pending = vec![self];
        std::iter::from_fn(move || {
            let node = pending.pop()?;
            pending.extend(node.children.iter().rev());
            Some(node)
        })
    }
}
