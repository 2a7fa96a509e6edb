//! Fingers that are on their way to a wider opening. What moves beside them has to leave them the room.

use super::scene::World;
use crate::robot::JointId;

/// Fingers of a hand that are opening.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpeningFingers {
    joint: JointId,
    /// Where the joint is going (rad or m).
    to: f64,
    /// The world's step in which that was said.
    said: u64,
}

impl World {
    /// Says where the joint of a hand's fingers is going (rad or m), wider than it is. It counts in this step and
    /// in the next one: whoever moves the fingers says it in each.
    pub(crate) fn fingers_are_opening(&mut self, joint: JointId, to: f64) {
        let said = self.state.steps;
        let opening = &mut self.state.opening;
        opening.retain(|fingers| fingers.joint != joint);
        opening.push(OpeningFingers { joint, to, said });
    }

    /// The joints of the fingers that are opening, and where these are going (rad or m).
    pub(crate) fn opening_fingers(&self) -> impl Iterator<Item = (JointId, f64)> {
        let now = self.state.steps;
        let opening = self.state.opening.iter();
        let opening = opening.filter(move |fingers| now <= fingers.said + 1);
        opening.map(|fingers| (fingers.joint, fingers.to))
    }
}
