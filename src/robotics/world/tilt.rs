//! What is open at the top and upright in a hand, and when it is tilted.

use nalgebra::Vector3;
use serde::Serialize;

use super::holding::Hold;
use super::object::{Attachment, Object};
use super::scene::World;
use crate::robot::{LinkId, Side};
use spatial::{Pose, trig};

/// Greatest tilt (rad, 15 degrees) at which what is open at the top counts as upright.
pub const UPRIGHT: f64 = 0.2618;

/// Tilt (rad) of something at a pose.
pub fn tilt_at(pose: &Pose) -> f64 {
    trig::acos((pose.rotation * Vector3::z()).z.clamp(-1.0, 1.0))
}

/// The tilt of something that is open at the top, in a hand.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tilt {
    /// Name of what is held.
    pub object: String,
    /// The hand.
    pub side: Side,
    /// The angle (rad) between its own upward axis and the world's.
    pub angle: f64,
}

impl Object {
    /// Whether it is open at the top, or filled and opened, and upright at a pose: what is in it stays there.
    pub(crate) fn is_upright_at(&self, pose: &Pose) -> bool {
        self.may_lose_content() && tilt_at(pose) <= UPRIGHT
    }
}

impl World {
    /// What is attached to a link, open at the top and upright in the present posture.
    fn upright_on(&self, link: LinkId) -> Option<(&Object, &Attachment)> {
        let at = self.link_pose(link);
        self.objects().find_map(|object| {
            let held = object.attachment_to(link)?;
            object
                .is_upright_at(&(at * held.at))
                .then_some((object, held))
        })
    }

    /// What a hand holds that is open at the top and upright in the present posture.
    pub fn upright_in_hand(&self, side: Side) -> Option<(&Object, &Attachment)> {
        self.upright_on(self.models.description.arm(side).gripper.palm)
    }

    /// How much what a hand holds is tilted now, if it was upright before.
    pub(super) fn newly_tilted(&self, object: &Object, hold: &Hold) -> Option<Tilt> {
        let pose = self.physics.pose(object.body);
        (hold.is_upright() && !object.is_upright_at(&pose)).then(|| Tilt {
            object: object.name.clone(),
            side: hold.side(),
            angle: tilt_at(&pose),
        })
    }

    /// What was upright in a hand and has been tilted in that step or later.
    pub fn tilts_since(&self, step: u64) -> impl Iterator<Item = &Tilt> {
        let tilts = self.state.tilts.iter();
        tilts
            .filter(move |(at, _)| *at >= step)
            .map(|(_, tilt)| tilt)
    }
}
