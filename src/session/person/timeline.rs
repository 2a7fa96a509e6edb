//! How the world was: snapshots at the moments at which something had changed, of which questions to the
//! past are asked.

use std::collections::VecDeque;

use super::snapshots::{MIN_SNAPSHOTS, Snapshot};
use crate::simulation::Simulation;

/// Maximum number of moments that are kept, about 10 kB each in the usual kitchen. Then every other one of the older half
/// is forgotten, so that the past gets coarser with age.
const MAX_MOMENTS: usize = 64;
/// The memory (bytes) that they may take in a larger kitchen, where that is fewer of them.
const MAX_BYTES: usize = 10 << 20;

/// The simulated time (s) between two moments while something moves.
const INTERVAL: f64 = 2.0;

/// A moment that is remembered.
struct Moment {
    /// In simulated seconds.
    time: f64,
    /// Which one it is of all that have been noted, in copies of the session, too.
    serial: u64,
    /// The state that the world was in from then on.
    snapshot: Snapshot,
}

/// The moments that are remembered.
#[derive(Default)]
pub(crate) struct Timeline {
    /// The oldest first.
    moments: VecDeque<Moment>,
    /// How many have been noted.
    noted: u64,
    /// Whether none are noted.
    is_off: bool,
}

impl Timeline {
    /// A timeline without moments, for a copy of the session.
    pub(super) fn emptied(&self) -> Timeline {
        Timeline {
            moments: VecDeque::new(),
            noted: self.noted,
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

    /// Whether none are noted.
    pub(super) fn is_off(&self) -> bool {
        self.is_off
    }

    /// Notes the state at a simulated time (s). Of several at the same time the last one counts.
    pub(super) fn note(&mut self, now: f64, snapshot: Snapshot) {
        if self.moments.back().is_some_and(|moment| moment.time >= now) {
            self.moments.pop_back();
        }
        while self.moments.len() >= MAX_MOMENTS
            || (self.moments.len() >= MIN_SNAPSHOTS && self.bytes() > MAX_BYTES)
        {
            self.thin_out();
        }
        self.noted += 1;
        self.moments.push_back(Moment {
            time: now,
            serial: self.noted,
            snapshot,
        });
    }

    /// How much memory (bytes) the moments take, roughly.
    fn bytes(&self) -> usize {
        Snapshot::bytes_of_all(self.moments.iter().map(|moment| &moment.snapshot))
    }

    /// Forgets every other moment of the older half.
    fn thin_out(&mut self) {
        let half = self.moments.len() / 2;
        let mut place = 0;
        self.moments.retain(|_| {
            place += 1;
            place > half || place % 2 == 1
        });
    }

    /// Whether the last moment is long ago.
    pub(super) fn is_due(&self, simulation: &Simulation) -> bool {
        let last = self.moments.back();
        !self.is_off && last.is_none_or(|moment| simulation.now() - moment.time >= INTERVAL)
    }

    /// The simulated times (s) of the moments, in order.
    pub(crate) fn times(&self) -> impl DoubleEndedIterator<Item = f64> {
        self.moments.iter().map(|moment| moment.time)
    }

    /// Numbers by which moments can be told apart for ever, in order.
    pub(crate) fn serials(&self) -> impl DoubleEndedIterator<Item = u64> {
        self.moments.iter().map(|moment| moment.serial)
    }

    /// The state that the world was in from a moment on.
    pub(crate) fn moment(&self, number: usize) -> Option<&Snapshot> {
        self.moments.get(number).map(|moment| &moment.snapshot)
    }
}
