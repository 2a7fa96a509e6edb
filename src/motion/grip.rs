//! Closing the fingers of a hand until both press on one object.

use super::failure::MotionFailure;
use super::guard;
use super::hand::{gripper_of, hand_may_touch_objects, pressing};
use super::job::{MotionOutcome, MotionStatus};
use super::joint_follower::with_joints;
use super::speeds;
use crate::robot::Side;
use crate::world::World;
use crate::world::physics::STEP_SECONDS;

/// How long (s) the fingers may press on different things before that counts as a failure.
const UNEQUAL: f64 = 0.25;

/// Fingers that close around an object: the named one, or any.
#[derive(Clone, Debug)]
pub(crate) struct Grip {
    side: Side,
    object: Option<String>,
    /// How long (s) they have pressed on different things.
    unequal: f64,
}

impl Grip {
    /// Grips with one hand.
    pub(super) fn new(side: Side, object: Option<String>) -> Self {
        Self {
            side,
            object,
            unequal: 0.0,
        }
    }

    /// Closes both fingers, which one joint moves, by one step.
    pub(super) fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        let side = self.side;
        let wanted = &self.object;
        let pressing = pressing(world, side);
        if let [Some(left), Some(right)] = &pressing {
            if left.body == right.body {
                let held = left.body.object().unwrap_or_default().to_owned();
                let right_one = wanted.as_ref().is_none_or(|w| *w == held);
                return Some(match (right_one, wanted) {
                    (false, Some(wanted)) => MotionStatus::failed(MotionFailure::WrongObject {
                        side,
                        wanted: wanted.clone(),
                        held: left.body.clone(),
                    }),
                    _ => MotionStatus::Done(MotionOutcome::Gripped { object: held }),
                });
            }
            self.unequal += STEP_SECONDS;
            if self.unequal > UNEQUAL {
                return Some(MotionStatus::failed(MotionFailure::WrongObject {
                    side,
                    wanted: wanted.clone().unwrap_or_else(|| "one object".to_owned()),
                    held: left.body.clone(),
                }));
            }
        }
        let gripper = gripper_of(world, side);
        let now = world.robot_configuration();
        let position = now.joints.get(gripper.joint);
        if position <= gripper.limits.lower {
            return Some(MotionStatus::failed(MotionFailure::NothingGripped { side }));
        }
        let closer = position - speeds::GRIP_VELOCITY * STEP_SECONDS;
        let next = with_joints(now, &[gripper.joint], &[closer.max(gripper.limits.lower)]);
        let allowed = hand_may_touch_objects(world, side);
        if let Some(hit) = guard::obstacle(world, &next, &allowed) {
            return Some(MotionStatus::failed(MotionFailure::FingersBlocked {
                side,
                hit: hit.into(),
            }));
        }
        world.set_robot_configuration(&next);
        None
    }
}
