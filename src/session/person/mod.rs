//! The state of the prompt, including the snapshots for undo.

mod progress;
mod snapshots;
mod timeline;

use lisp::value::Value;
use lisp::value::copy::{Copied, Copier};
pub(crate) use progress::{Done, Progress};
pub(crate) use snapshots::{Snapshot, Snapshots};
use timeline::Timeline;

/// The state of the prompt.
#[derive(Default)]
pub(crate) struct Person {
    /// Snapshots of earlier states.
    pub snapshots: Snapshots,
    /// How the world was.
    pub(crate) timeline: Timeline,
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

impl Person {
    /// The same state for a copy of the image.
    pub(super) fn copied(&self, copier: &mut Copier) -> Person {
        Person {
            snapshots: self.snapshots.copied(copier),
            timeline: self.timeline.emptied(),
            // A copy is not the person's.
            progress: None,
            inspected: self.inspected.copied(copier),
            can_serve: self.can_serve,
            port: self.port,
            quit: self.quit,
        }
    }
}
