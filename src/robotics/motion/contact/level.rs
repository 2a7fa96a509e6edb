//! Which hands must stay level, since what they hold is open at the top, and how level they are.
//!
//! A hand is bound that holds something hollow upright. What lies in the hand or is upside down may turn.

use std::ops::Range;

use nalgebra::{Matrix3, Vector3};

use crate::robot::{ArmKinematics, ArmPositions, JointId, Side};
use crate::world::{Tilt, World};
use spatial::{Pose, trig};

/// Greatest tilt (rad, 13 degrees) on paths that are planned: what is held may sag in the hand.
const PLANNED: f64 = 0.2269;
/// How much farther (rad) than at its start a motion may tilt what is tilted more than that.
const MORE: f64 = 0.0175;

/// A hand that must stay level.
#[derive(Clone)]
struct LevelHand<'w> {
    side: Side,
    object: &'w str,
    kinematics: &'w ArmKinematics,
    /// Where the arm's joints begin among those that move.
    first: usize,
    /// The world's upward direction in the frame of the arm's base.
    up: Vector3<f64>,
    /// The upward axis of what is held, in the frame of the wrist.
    axis: Vector3<f64>,
    /// The cosine of the greatest tilt.
    least_cosine: f64,
}

impl LevelHand<'_> {
    /// The places of the arm's joints among those that move.
    fn range(&self) -> Range<usize> {
        self.first..self.first + self.kinematics.joints().len()
    }

    fn positions(&self, all: &[f64]) -> Option<ArmPositions> {
        all.get(self.range())?.try_into().ok()
    }

    /// The upward axis of what is held, in the frame of the arm's base.
    fn axis_at(&self, positions: &ArmPositions) -> Vector3<f64> {
        self.kinematics.hand_rotation(positions) * self.axis
    }

    fn tilt(&self, cosine: f64) -> Tilt {
        Tilt {
            object: self.object.to_owned(),
            side: self.side,
            angle: trig::acos(cosine.clamp(-1.0, 1.0)),
        }
    }
}

/// The hands among those that move that must stay level.
#[derive(Clone, Default)]
pub(crate) struct LevelHands<'w>(Vec<LevelHand<'w>>);

impl<'w> LevelHands<'w> {
    /// Those whose arms' joints are all among some joints.
    pub(crate) fn of(world: &'w World, joints: &[JointId]) -> Self {
        let hands = world.models().description.sides();
        Self(
            hands
                .filter_map(|side| level_hand(world, side, joints))
                .collect(),
        )
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Those that are level with the joints at some positions: others are meant to be tilted.
    #[must_use]
    pub(crate) fn level_at(mut self, positions: &[f64]) -> Self {
        self.0.retain(|hand| {
            let at = hand.positions(positions);
            at.is_some_and(|at| hand.axis_at(&at).dot(&hand.up) >= hand.least_cosine)
        });
        self
    }

    /// Those that are level with the tools of some hands at poses in the frame of the base.
    #[must_use]
    pub(crate) fn level_with(mut self, tools: &[(Side, Pose)]) -> Self {
        self.0.retain(|hand| {
            let mut tools = tools.iter().filter(|(side, _)| *side == hand.side);
            tools.all(|(_, tool)| (tool.rotation * hand.axis).z >= hand.least_cosine)
        });
        self
    }

    /// What is tilted too much with the joints at some positions.
    pub(crate) fn tilted(&self, positions: &[f64]) -> Option<Tilt> {
        self.0.iter().find_map(|hand| {
            let cosine = hand.axis_at(&hand.positions(positions)?).dot(&hand.up);
            (cosine < hand.least_cosine).then(|| hand.tilt(cosine))
        })
    }

    /// Turns the hands level, the wrists staying where they are, by as little as possible. Returns whether
    /// that is possible.
    pub(crate) fn settle(&self, positions: &mut [f64]) -> bool {
        self.0.iter().all(|hand| {
            let Some(at) = hand.positions(positions) else {
                return false;
            };
            let rotation = hand.kinematics.hand_rotation(&at);
            let axis = rotation * hand.axis;
            let cosine = axis.dot(&hand.up);
            if cosine >= 1.0 - 1e-12 {
                return true;
            }
            let turned = turning(&axis, &hand.up).map(|turn| turn * rotation);
            let settled = turned.and_then(|to| hand.kinematics.with_hand_turned(&at, &to));
            let place = positions.get_mut(hand.range());
            match (settled, place) {
                (Some(settled), Some(place)) => {
                    place.copy_from_slice(&settled);
                    true
                }
                _ => false,
            }
        })
    }
}

/// The smallest rotation that turns one direction into another; `None` if they are opposite.
fn turning(from: &Vector3<f64>, to: &Vector3<f64>) -> Option<Matrix3<f64>> {
    let (axis, cosine) = (from.cross(to), from.dot(to));
    if cosine <= -1.0 + 1e-9 {
        return None;
    }
    let cross = axis.cross_matrix();
    Some(Matrix3::identity() + cross + cross * cross / (1.0 + cosine))
}

fn level_hand<'w>(world: &'w World, side: Side, joints: &[JointId]) -> Option<LevelHand<'w>> {
    let (object, held) = world.upright_in_hand(side)?;
    let arm = world.models().description.arm(side);
    let own = arm.joints();
    let first = joints.windows(own.len()).position(|some| some == own)?;
    let palm = world.link_pose(arm.gripper.palm);
    let up = palm.rotation * held.at.rotation * Vector3::z();
    let wrist = world.link_pose(arm.wrist);
    let base = world.link_pose(arm.base);
    let most = PLANNED.max(trig::acos(up.z.clamp(-1.0, 1.0)) + MORE);
    Some(LevelHand {
        side,
        object: object.name(),
        kinematics: &arm.kinematics,
        first,
        up: base.rotation.inverse() * Vector3::z(),
        axis: wrist.rotation.inverse() * up,
        least_cosine: trig::cos(most),
    })
}
