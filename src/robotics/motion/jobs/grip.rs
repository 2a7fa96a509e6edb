//! Closing the fingers of a hand until both press on one object, or on the bar of a handle.

use super::job::{MotionOutcome, MotionStatus};
use crate::motion::contact::guard;
use crate::motion::contact::hand::{
    bar_between, gripper_of, hand_may_touch_objects, hand_names, pressing, yields,
};
use crate::motion::contact::holding::{held_objects, press, press_too};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::planning::configuration::with_joints;
use crate::motion::trajectories::speeds;
use crate::robot::Side;
use crate::world::physics::STEP_SECONDS;
use crate::world::{BodyName, World};

/// A finger just before the limit of its joint (rad/s).
const SLOWEST: f64 = 0.01;
/// How long (s) the fingers may press on different things before that counts as a failure.
const UNEQUAL: f64 = 0.25;

/// How long (s) a finger may press an object against something before that counts as a failure.
const PINNED: f64 = 0.25;

/// Fingers that close around an object: the named one, or any.
#[derive(Clone, Debug)]
pub(crate) struct Grip {
    side: Side,
    object: Option<String>,
    /// The force (N) of each finger; as much as possible if none is given.
    effort: Option<f64>,
    /// Whether the other hand may hold the object, too.
    together: bool,
    /// How fast (rad/s) the finger joint closes.
    speed: f64,
    /// How long (s) they have pressed on different things.
    unequal: f64,
    /// How long (s) one has pressed an object against something.
    pinned: f64,
}

impl Grip {
    /// Grips with one hand.
    pub(super) fn new(
        side: Side,
        object: Option<String>,
        effort: Option<f64>,
        together: bool,
    ) -> Self {
        Self {
            side,
            object,
            effort,
            together,
            speed: 0.0,
            unequal: 0.0,
            pinned: 0.0,
        }
    }

    /// The force (N) of each finger, if one is given.
    pub(super) fn effort(&self) -> Option<f64> {
        self.effort
    }

    /// Closes both fingers, which one joint moves, by one step.
    pub(super) fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        let side = self.side;
        let greatest = gripper_of(world, side).effort;
        let effort = self.effort.unwrap_or(greatest);
        // NaN is no effort either.
        if !(effort > 0.0 && effort <= greatest) {
            return Some(MotionStatus::failed(MotionFailure::GripEffort {
                side,
                effort,
                greatest,
            }));
        }
        let wanted = &self.object;
        if let Some(held) = held_objects(world, side).into_iter().next() {
            return Some(self.gripped(world, held, effort));
        }
        let bar = bar_between(world, side).filter(|_| wanted.is_none());
        if let Some(bar) = bar.filter(|bar| bar.is_pressed)
            && world.hold_handle(side, bar.handle, effort)
        {
            let object = world.models().furniture_body(bar.handle).to_string();
            return Some(MotionStatus::Done(MotionOutcome::Gripped { object }));
        }
        let pressing = pressing(world, side);
        if let [Some(left), Some(right)] = &pressing {
            if left.body == right.body {
                let held = left.body.object().unwrap_or_default().to_owned();
                return Some(self.gripped(world, held, effort));
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
        let mut pressed = pressing.iter().flatten();
        if let Some(pinned) = pressed.find_map(|one| guard::pinned(world, one.body.object()?)) {
            // The fingers wait for the object to give way.
            self.speed = 0.0;
            self.pinned += STEP_SECONDS;
            let failure = || MotionFailure::FingerPins { side, pinned };
            return (self.pinned > PINNED).then(|| MotionStatus::failed(failure()));
        }
        let gripper = gripper_of(world, side);
        let now = world.robot_configuration();
        let position = now.joints.get(gripper.joint);
        if position <= gripper.limits.lower {
            return Some(MotionStatus::failed(MotionFailure::NothingGripped { side }));
        }
        let acceleration = world.models().description.speed(gripper.joint).acceleration;
        // Nothing may be between the fingers, and then they stop at the limit.
        let room = position - gripper.limits.lower;
        // With half of the acceleration, since steps of time are not infinitely short.
        let stopping = (acceleration * room).sqrt();
        let speed = (self.speed + acceleration * STEP_SECONDS)
            .min(speeds::GRIP_VELOCITY * gripper.scale())
            .min(stopping.max(SLOWEST * gripper.scale()));
        let closer = position - speed * STEP_SECONDS;
        let next = with_joints(now, &[gripper.joint], &[closer.max(gripper.limits.lower)]);
        let mut allowed = hand_may_touch_objects(world, side);
        if let Some(bar) = bar.filter(yields) {
            let handle = world.models().furniture_body(bar.handle);
            allowed = allowed.and_all(hand_names(world, side), &handle);
        }
        if let Some(hit) = guard::obstacle(world, &next, &allowed) {
            return Some(MotionStatus::failed(MotionFailure::FingersBlocked {
                side,
                hit: hit.into(),
            }));
        }
        world.set_robot_configuration(&next);
        self.speed = speed;
        None
    }

    /// Both fingers press on an object: they hold it, if it is the right one.
    fn gripped(&self, world: &mut World, held: String, effort: f64) -> MotionStatus {
        let side = self.side;
        if let Some(wanted) = self.object.as_ref().filter(|wanted| **wanted != held) {
            return MotionStatus::failed(MotionFailure::WrongObject {
                side,
                wanted: wanted.clone(),
                held: BodyName::Object(held),
            });
        }
        let pressed = match self.together {
            true => press_too(world, side, &held, effort),
            false => press(world, side, &held, effort),
        };
        match pressed {
            Ok(()) => MotionStatus::Done(MotionOutcome::Gripped { object: held }),
            Err(failure) => MotionStatus::failed(failure),
        }
    }
}
