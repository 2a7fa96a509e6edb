//! The state of the prompt, including the snapshots for undo.

mod progress;
mod shelf;
mod snapshots;
mod timeline;

use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
pub(crate) use progress::{Done, Progress};
use shelf::{Pace, Shelf};
pub(crate) use snapshots::{Snapshot, Snapshots};
use timeline::Timeline;

use crate::simulation::Simulation;

/// The state of the prompt.
pub(crate) struct Person {
    /// Snapshots of earlier states.
    pub snapshots: Snapshots,
    /// How the world was.
    pub(crate) timeline: Timeline,
    /// Where snapshots before forms are taken, and named ones.
    of_forms: Shelf,
    /// Where snapshots before motions and at moments are taken. There are many of them between two forms, so that those
    /// before forms would have little in common with their neighbours.
    of_moments: Shelf,
    /// Where it is kept what has been done of lessons, if anywhere.
    pub(crate) progress: Option<Progress>,
    /// A value that is to be inspected.
    pub inspected: Option<Value>,
    /// Whether the session can be served to an editor from here.
    pub(crate) can_serve: bool,
    /// The port by which it is to be served.
    pub port: Option<u16>,
    /// The exit status, once an exit has been requested.
    pub quit: Option<u8>,
}

impl Default for Person {
    fn default() -> Self {
        Self {
            snapshots: Snapshots::default(),
            timeline: Timeline::default(),
            of_forms: Shelf::new(Pace::Forms),
            of_moments: Shelf::new(Pace::Moments),
            progress: None,
            inspected: None,
            can_serve: false,
            port: None,
            quit: None,
        }
    }
}

impl Person {
    /// Call when a form at top level is about to be evaluated.
    pub(crate) fn begin_form(&mut self, simulation: &Simulation, form: &Value) {
        self.snapshots
            .begin_form(&mut self.of_forms, simulation, form);
    }

    /// Call when the next motion is about to begin: both undo and the past may need the state of then.
    pub(crate) fn begin_motion(&mut self, simulation: &Simulation) {
        let is_moment = self.is_past_kept();
        let is_undone = self.snapshots.keeps_motions();
        if !is_moment && !is_undone {
            return;
        }
        let snapshot = self.of_moments.take(simulation);
        if is_undone {
            let motion = simulation.jobs.begun;
            self.snapshots.begin_motion(motion, snapshot.clone());
        }
        if is_moment {
            self.timeline.note(simulation.now(), snapshot);
        }
    }

    /// Remembers how the world is now, unless it is only tried out.
    pub(crate) fn note_moment(&mut self, simulation: &Simulation) {
        if self.is_past_kept() {
            let snapshot = self.of_moments.take(simulation);
            self.timeline.note(simulation.now(), snapshot);
        }
    }

    /// The same if the last moment is long ago.
    pub(crate) fn note_now_and_then(&mut self, simulation: &Simulation) {
        if self.timeline.is_due(simulation) {
            self.note_moment(simulation);
        }
    }

    /// Takes a named snapshot of the world.
    pub(crate) fn keep_snapshot(&mut self, simulation: &Simulation, name: &str) {
        self.snapshots.keep(&mut self.of_forms, simulation, name);
    }

    /// Whether moments are noted.
    fn is_past_kept(&self) -> bool {
        !self.timeline.is_off() && !self.snapshots.is_trial()
    }

    /// The same state for a copy of the image.
    pub(super) fn copied(&self, copier: &mut Copier) -> Person {
        Person {
            snapshots: self.snapshots.copied(copier),
            timeline: self.timeline.emptied(),
            of_forms: Shelf::new(Pace::Forms),
            of_moments: Shelf::new(Pace::Moments),
            // A copy is not the person's.
            progress: None,
            inspected: self.inspected.copied(copier),
            can_serve: self.can_serve,
            port: self.port,
            quit: self.quit,
        }
    }
}
