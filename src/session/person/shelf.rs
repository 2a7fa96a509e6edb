//! Where snapshots are taken that may be kept for long: all but the newest are packed.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::{Rc, Weak};

use super::snapshots::Snapshot;
use crate::simulation::Simulation;
use robotics::world::{self, Packed, Packer, World};

/// How often a shelf takes snapshots, on which it depends what it keeps at hand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    /// Now and then, before forms.
    Forms,
    /// Many times a second, some of which are forgotten at once.
    Moments,
}

impl Pace {
    /// How many of the newest snapshots stay as they are: what comes next is most often the return to one of these, or
    /// that they are forgotten.
    fn whole(self) -> usize {
        match self {
            Self::Forms => 1,
            Self::Moments => 2,
        }
    }
}

/// A world that is kept.
pub(super) enum KeptWorld {
    Whole(Box<world::Snapshot>),
    Packed(Box<Packed>),
}

impl KeptWorld {
    /// The present state of the world.
    pub(super) fn of(world: &World) -> Self {
        Self::Whole(Box::new(world.snapshot()))
    }

    /// Restores the state in a world.
    pub(super) fn restore(&self, world: &mut World) {
        match self {
            Self::Whole(snapshot) => world.restore(snapshot),
            Self::Packed(packed) => world.restore_packed(packed),
        }
    }

    /// How much memory (bytes) it takes for itself.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Whole(snapshot) => snapshot.bytes(),
            Self::Packed(packed) => packed.bytes(),
        }
    }

    /// What it shares with others that were kept before and after it, if anything, as [`Packed::shared`] says it.
    pub(super) fn shared(&self) -> Option<(usize, usize)> {
        match self {
            Self::Whole(_) => None,
            Self::Packed(packed) => Some(packed.shared()),
        }
    }
}

/// Takes snapshots, and packs those that are no longer among the newest.
pub(super) struct Shelf {
    pace: Pace,
    packer: Packer,
    /// Those that are not packed yet, the oldest first.
    whole: VecDeque<Weak<RefCell<KeptWorld>>>,
}

impl Shelf {
    /// An empty shelf.
    pub(super) fn new(pace: Pace) -> Self {
        Self {
            pace,
            packer: Packer::default(),
            whole: VecDeque::new(),
        }
    }

    /// Takes a snapshot of the present state.
    pub(super) fn take(&mut self, simulation: &Simulation) -> Snapshot {
        let snapshot = Snapshot::take(simulation);
        self.whole.push_back(Rc::downgrade(snapshot.world()));
        while self.whole.len() > self.pace.whole() {
            let oldest = self.whole.pop_front();
            if let Some(kept) = oldest.and_then(|kept| kept.upgrade()) {
                self.pack(&kept);
            }
        }
        snapshot
    }

    fn pack(&mut self, kept: &RefCell<KeptWorld>) {
        let packed = match &*kept.borrow() {
            KeptWorld::Whole(snapshot) => self.packer.pack(snapshot),
            KeptWorld::Packed(_) => None,
        };
        if let Some(packed) = packed {
            *kept.borrow_mut() = KeptWorld::Packed(Box::new(packed));
        }
        if self.pace == Pace::Forms {
            self.packer.leave_room();
        }
    }
}
