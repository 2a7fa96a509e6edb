//! Snapshots of a world, to return to an earlier state.

use super::physics::Sets;
use super::scene::{State, World};

/// The whole state of a world at one moment. A world restored to it continues with the same
/// bits as before.
#[derive(Clone)]
pub struct Snapshot {
    pub(super) physics: Sets,
    pub(super) state: State,
}

impl Snapshot {
    /// How much memory (bytes) it takes, roughly.
    pub fn bytes(&self) -> usize {
        self.physics.bytes() + self.state.bytes()
    }
}

impl World {
    /// The current state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot {
            physics: self.physics.save(),
            state: self.state.clone(),
        }
    }

    /// Restores a state of this world, or of one that was cloned from it.
    pub fn restore(&mut self, snapshot: &Snapshot) {
        self.go_to(snapshot.clone());
    }

    /// Restores a state that nobody else needs.
    pub(super) fn go_to(&mut self, snapshot: Snapshot) {
        self.physics.load(snapshot.physics);
        self.state = snapshot.state;
    }
}
