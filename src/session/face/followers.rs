//! Observing a session.

use super::observer::Observer;
use super::{KeptOutput, PlanEvent, PlanEventKind, TaskLog};
use crate::Session;
use crate::audience::FollowerId;
use crate::deeds::Deeds;
use std::rc::Rc;

/// An observer of a session.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ObserverId(FollowerId);

impl Session {
    /// Calls a function with everything that happens in plans from now on, in the order in which it
    /// happens. It is called in the midst of an evaluation, which waits for it.
    pub fn on_event(&mut self, tell: impl FnMut(&PlanEvent) + 'static) -> ObserverId {
        let observer = Box::new(Observer::new(Box::new(tell)));
        let host = &mut self.evaluator.host;
        let added = host
            .audience
            .add_follower(&host.simulation, &self.evaluator.image, observer);
        ObserverId(added)
    }

    /// Notes what happens from now on.
    pub(crate) fn note_deeds(&mut self, deeds: Rc<Deeds>) {
        let host = &mut self.evaluator.host;
        let (simulation, image) = (&host.simulation, &self.evaluator.image);
        let observer = Box::new(deeds.observer());
        host.audience.add_follower(simulation, image, observer);
    }

    /// Keeps what is printed from now on, as many characters as that; the evaluation under way is
    /// interrupted once there are more bytes than may be.
    pub fn keep_output(&mut self, characters: usize, max_bytes: usize) -> (ObserverId, KeptOutput) {
        let output = KeptOutput::new(characters, max_bytes);
        let (kept, interrupter) = (output.clone(), self.interrupter());
        let observer = self.on_event(move |event| {
            if let PlanEventKind::Printed(text) = &event.kind {
                kept.add(text);
                if kept.is_too_long() {
                    interrupter.interrupt();
                }
            }
        });
        (observer, output)
    }

    /// Observes no more.
    pub fn remove_observer(&mut self, observer: ObserverId) {
        self.evaluator.host.audience.remove_follower(observer.0);
    }

    /// Keeps all tasks, actions and motions from now on, for
    /// [`TaskLog::tree`].
    pub fn log_tasks(&mut self) -> TaskLog {
        let log = TaskLog::default();
        let kept = log.clone();
        self.on_event(move |event| kept.note(event));
        log
    }
}
