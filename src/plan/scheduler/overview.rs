//! The tasks as a person sees them.

use super::Scheduler;
use super::live::{Live, Wait};
use crate::lisp::image::Image;
use crate::lisp::print;
use crate::lisp::value::Value;
use crate::plan::state::Plan;
use crate::plan::task::{Status, TaskId};

/// A task that is alive.
#[derive(Clone)]
pub struct TaskInfo {
    /// Which task.
    pub id: TaskId,
    /// Its name.
    pub name: String,
    /// What it is doing.
    pub status: Status,
    /// The task that started it; none if the prompt did.
    pub parent: Option<TaskId>,
    /// Its path in the task tree, innermost part first.
    pub path: Value,
    /// What it waits for, in words; none if it is ready.
    pub waits_for: Option<String>,
}

impl Scheduler {
    /// Simulated seconds since the session began.
    pub fn now(&self, image: &Image) -> f64 {
        Plan::of(image).now()
    }

    /// The tasks that are alive, in order of creation.
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

    /// Why nobody can go on.
    pub(super) fn describe_deadlock(&self, image: &Image) -> String {
        let mut lines =
            vec!["Nothing can go on: all that runs waits for what nobody will do.".to_owned()];
        for task in self.tasks(image) {
            let reason = match task.status {
                Status::Suspended => Some("somebody to wake it up".to_owned()),
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
        Wait::WakeUp => "somebody to wake it up".to_owned(),
        Wait::Debugger => "a decision".to_owned(),
    })
}
