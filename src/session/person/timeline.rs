//! How the world was: snapshots at the moments at which something had changed, of which questions to the
//! past are asked.

use std::collections::VecDeque;

use super::snapshots::Snapshot;
use crate::simulation::Simulation;

/// Maximum number of moments that are kept; the oldest is forgotten first.
const MAX_MOMENTS: usize = 500;

/// The simulated time (s) between two moments while something moves.
const INTERVAL: f64 = 1.0;

/// The moments that are remembered.
#[derive(Default)]
pub(crate) struct Timeline {
    /// Simulated times (s) with the state that the world was in from then on, the oldest first.
    moments: VecDeque<(f64, Snapshot)>,
    /// Whether none are noted.
    is_off: bool,
}

impl Timeline {
    /// A timeline without moments, for a copy of the session.
    pub(super) fn emptied(&self) -> Timeline {
        Timeline {
            moments: VecDeque::new(),
            is_off: self.is_off,
        }
    }

    /// Sets whether no moments are noted from now on.
    pub(crate) fn set_off(&mut self, is_off: bool) {
        self.is_off = is_off;
        if is_off {
            self.moments.clear();
        }
    }

    /// Notes the present state. Of several at the same time the last one counts.
    pub(crate) fn note(&mut self, simulation: &Simulation) {
        if self.is_off {
            return;
        }
        let now = simulation.now();
        if self.moments.back().is_some_and(|(time, _)| *time >= now) {
            self.moments.pop_back();
        }
        if self.moments.len() == MAX_MOMENTS {
            self.moments.pop_front();
        }
        self.moments.push_back((now, Snapshot::take(simulation)));
    }

    /// Notes the present state if the last moment is long ago.
    pub(crate) fn note_now_and_then(&mut self, simulation: &Simulation) {
        let last = self.moments.back();
        if last.is_none_or(|(time, _)| simulation.now() - time >= INTERVAL) {
            self.note(simulation);
        }
    }

    /// The simulated times (s) of the moments, in order.
    pub(crate) fn times(&self) -> impl DoubleEndedIterator<Item = f64> {
        self.moments.iter().map(|(time, _)| *time)
    }

    /// The state that the world was in from a moment on.
    pub(crate) fn moment(&self, number: usize) -> Option<&Snapshot> {
        self.moments.get(number).map(|(_, snapshot)| snapshot)
    }
}
