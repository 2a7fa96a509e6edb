//! Whether a drawer or a door could be closed over something that is put down in it.

use super::body_name::BodyName;
use super::moved_part::MovedPart;
use super::scene::World;
use super::standing_room::Load;
use crate::robot::{JointId, JointKind, LinkId};
use spatial::Pose;

/// Distance (m or rad) between the positions on the way that are looked at.
const STEP: [f64; 2] = [0.02, 0.06];
/// Maximum number of them.
const MAX_STEPS: u32 = 60;
/// A container that is not farther open (m or rad) is closed.
const CLOSED: f64 = 1e-3;

/// The way on which a container that is open would be closed.
pub struct Closing<'w> {
    on_way: Vec<MovedPart<'w>>,
    /// Whether what is put down would move with it.
    carries: bool,
}

impl World {
    /// The way on which a container would be closed by its joint, for what is put down in a link; `None` if it
    /// is closed.
    pub fn closing(&self, joint: JointId, link: LinkId) -> Option<Closing<'_>> {
        let kitchen = &self.models.kitchen;
        let closed = kitchen.joint(joint).limits?.lower;
        let open = kitchen.position(self.kitchen_positions(), joint);
        let way = closed - open;
        if way.abs() <= CLOSED {
            return None;
        }
        let slides = kitchen.joint(joint).kind == JointKind::Prismatic;
        let step = STEP[usize::from(!slides)];
        // The cast saturates.
        let count = ((way.abs() / step).ceil() as u32).clamp(1, MAX_STEPS);
        let part = self.part(joint);
        let positions = (1..=count).map(|i| open + way * f64::from(i) / f64::from(count));
        Some(Closing {
            on_way: positions
                .map(|position| self.moved(&part, position))
                .collect(),
            carries: kitchen.carries(kitchen.joint(joint).child, link),
        })
    }
}

impl Closing<'_> {
    /// What a thing at a pose, or the container because of it, would run into.
    pub(crate) fn stopped_by(&self, load: &Load, pose: &Pose) -> Option<BodyName> {
        self.on_way.iter().find_map(|moved| match self.carries {
            true => moved.meets_as_rider(load.solids(), load.key(), pose),
            false => moved.meets(load.solids(), pose),
        })
    }
}
