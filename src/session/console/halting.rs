//! What the followers of a session learn when an evaluation does not go on.

use super::evaluator::Evaluator;
use crate::audience::task_news::class_name;
use lisp::image::identity::aside;
use lisp::print::report::report;
use view::watch::{Cause, Halt, TaskId, TaskNews, TaskState};

impl Evaluator {
    /// Tells the followers whether the session goes on. Call when an input has been dealt with;
    /// `aborted` is what has ended it, and `was_stopped` tells whether an evaluation was stopped
    /// before it.
    pub(crate) fn tell_halt(&mut self, was_stopped: bool, aborted: Option<Halt>) {
        let is_stopped = self.console.level() > 0;
        // Nobody looks after what moves while a person decides.
        self.host.simulation.stop_robot();
        let halt = if is_stopped {
            self.console.halt()
        } else {
            aborted
        };
        let image = &self.image;
        let stopped = self.scheduler.stopped_tasks(image).into_iter();
        let stopped = stopped.map(|(task, condition)| TaskNews {
            id: TaskId::Task(task.id.0),
            parent: task.parent.map(|parent| TaskId::Task(parent.0)),
            name: task.name,
            state: TaskState::Stopped,
            failure: aside(image, || report(image, &condition)),
            class: class_name(image, &condition),
            result: String::new(),
            about: None,
        });
        let stopped = stopped.collect();
        let now = self.host.simulation.now();
        self.host.audience.tell_halt(now, halt, stopped);
        // The end of a form that was evaluated in one go has been shown.
        if was_stopped || is_stopped {
            self.host.audience.show(&self.host.simulation, Cause::Rest);
        }
    }
}
