//! What the followers of a session learn when an evaluation does not go on.

use super::Session;
use super::audience::task_news::class_name;
use super::dialogue::{Abort, Event};
use lisp::image::identity::aside;
use lisp::print::report::report;
use view::watch::{Cause, Halt, HaltKind, TaskId, TaskNews, TaskState};

impl Session {
    /// Tells the followers whether the session goes on. Call when an input has been dealt with;
    /// `aborted` is what has ended it, and `was_stopped` tells whether an evaluation was stopped
    /// before it.
    pub(super) fn tell_halt(&mut self, was_stopped: bool, aborted: Option<Halt>) {
        let is_stopped = self.console.level() > 0;
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

/// What an event says about the end of an input.
pub(super) fn end_of(event: &Event) -> Option<Halt> {
    match event {
        Event::Aborted(abort) => Some(halt_of(HaltKind::Aborted, abort)),
        _ => None,
    }
}

/// The halt at a condition or an interrupt.
pub(super) fn halt_of(kind: HaltKind, abort: &Abort) -> Halt {
    let place = abort.main_place();
    Halt {
        class: abort.class.clone(),
        place: place.map_or_else(String::new, ToString::to_string),
        ..Halt::new(kind, abort.report.clone())
    }
}
