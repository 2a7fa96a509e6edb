//! The tasks as shown to users.

use super::Scheduler;
use super::live::{Live, Wait};
#[cfg(test)]
use crate::state::Plan;
use crate::task::{Status, TaskId};
use lisp::image::Image;
use lisp::print;
use lisp::value::Value;

/// A live task.
#[derive(Clone)]
pub struct TaskInfo {
    /// Which task.
    pub id: TaskId,
    /// Its name.
    pub name: String,
    /// Its status.
    pub status: Status,
    /// The task that started it; `None` if it was started from the prompt.
    pub parent: Option<TaskId>,
    /// Its path in the task tree, innermost part first.
    pub path: Value,
    /// What it waits for, in words; `None` if it is ready.
    pub(crate) waits_for: Option<String>,
}

impl<C: 'static> Scheduler<C> {
    /// Simulated seconds since the session began.
    #[cfg(test)]
    pub fn now(&self, image: &Image) -> f64 {
        Plan::of(image).now()
    }

    /// The live tasks, in order of creation.
    pub fn tasks(&self, image: &Image) -> Vec<TaskInfo> {
        let mut tasks: Vec<TaskInfo> = self
            .entries
            .iter()
            .flatten()
            .filter_map(|live| {
                let task = live.task.as_ref()?.get();
                let parent = live.parent.and_then(|slot| self.live(slot));
                Some(TaskInfo {
                    id: live.id,
                    name: task.name.to_string(),
                    status: task.status(),
                    parent: parent.filter(|p| p.task.is_some()).map(|p| p.id),
                    path: task.node.path.clone(),
                    waits_for: describe(image, live),
                })
            })
            .collect();
        tasks.sort_by_key(|t| t.id);
        tasks
    }

    /// The live tasks and those of the last plan that have ended, as a tree.
    pub fn task_tree(&self, image: &Image) -> String {
        let mut tasks = self.tasks(image);
        tasks.extend(self.ended.iter().cloned());
        tasks.sort_by_key(|task| task.id);
        if tasks.is_empty() {
            return "; There are no tasks.\n".to_owned();
        }
        let mut text = String::new();
        let is_known = |id: TaskId| tasks.iter().any(|task| task.id == id);
        let roots = tasks
            .iter()
            .filter(|task| !task.parent.is_some_and(is_known));
        // Depth first, children in order of creation.
        let mut pending: Vec<(&TaskInfo, usize)> = roots.map(|task| (task, 0)).collect();
        pending.reverse();
        while let Some((task, depth)) = pending.pop() {
            text.push_str(&line(image, task, depth));
            let children = tasks.iter().filter(|t| t.parent == Some(task.id));
            let below: Vec<_> = children.map(|child| (child, depth + 1)).collect();
            pending.extend(below.into_iter().rev());
        }
        text
    }

    /// Records a task that has ended.
    pub(super) fn note_ended(&mut self, info: TaskInfo) {
        if self.ended.len() < MAX_ENDED {
            self.ended.push(info);
        }
    }

    /// Call when a task begins: those of earlier plans are forgotten.
    pub(super) fn note_begun(&mut self, root: TaskId) {
        if self.ended_root != Some(root) {
            self.ended_root = Some(root);
            self.ended.clear();
        }
    }

    /// Why nothing can continue.
    pub(super) fn describe_deadlock(&self, image: &Image) -> String {
        let mut lines =
            vec!["Nothing can continue: everything waits for what will never happen.".to_owned()];
        for task in self.tasks(image) {
            let reason = match task.status {
                Status::Suspended => Some("a call of WAKE-UP".to_owned()),
                _ => task.waits_for,
            };
            if let Some(reason) = reason {
                lines.push(format!("  {} waits for {reason}.", task.name));
            }
        }
        let root = self.roots.last().and_then(|root| self.live(*root));
        if let Some(reason) = root.and_then(|root| describe(image, root)) {
            lines.push(format!("  The prompt waits for {reason}."));
        }
        lines.join("\n")
    }
}

/// Maximum number of ended tasks that are remembered.
const MAX_ENDED: usize = 200;

fn line(image: &Image, task: &TaskInfo, depth: usize) -> String {
    let status = format!("{:?}", task.status).to_lowercase();
    let waits = task.waits_for.as_ref();
    let waits = waits
        .map(|what| format!(", waits for {what}"))
        .unwrap_or_default();
    let part = task.path.car_or_nil();
    let path = if part.is_true() {
        format!("  {}", print::to_string(image, &part, true))
    } else {
        String::new()
    };
    format!(
        "{}{}: {status}{waits}{path}\n",
        "  ".repeat(depth),
        task.name
    )
}

fn describe(image: &Image, live: &Live) -> Option<String> {
    Some(match &live.wait {
        Wait::Nothing => return None,
        Wait::Sleep => "the end of a sleep".to_owned(),
        Wait::Fluent(fluent) => {
            let shown = print::to_string(image, &fluent.value(), true);
            match live.until {
                Some(time) => format!("{shown}, until {time:.3} s"),
                None => shown,
            }
        }
        Wait::Group(group) => match group.children.as_slice() {
            [only] => format!("the task {}", only.get().name),
            tasks => format!("{} tasks", tasks.len()),
        },
        Wait::Drain(_) | Wait::LastChildren => "its tasks to end".to_owned(),
        Wait::Ticket(_) => "a motion".to_owned(),
        Wait::Join(group) => match group.children.first() {
            Some(task) => format!("the end of the task {}", task.get().name),
            None => "a task".to_owned(),
        },
        Wait::Death(task) => format!("the end of the task {}", task.get().name),
        Wait::WakeUp => "a call of WAKE-UP".to_owned(),
        Wait::Debugger => "a decision".to_owned(),
    })
}
