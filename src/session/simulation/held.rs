//! What the hands hold.

use super::Simulation;
use crate::log_level::LogLevel;
use lisp::image::Image;
use robotics::motion::{HeldGrip, MotionFailure};
use robotics::robot::Side;
use robotics::world::WorldError;
use robotics::world::tilt::UPRIGHT as MOST_TILT;
use spatial::Pose;

/// How an object is held.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Held {
    /// The hand.
    pub side: Side,
    /// The grasp by which it was picked up, if known.
    pub grasp: Option<String>,
    /// The angle (rad) by which that grasp was turned about the axis of a round object.
    pub turn: f64,
    /// Where it was detected before that, in the map.
    pub(crate) taken_from: Pose,
    /// The pose of the tool in the frame of the object as the robot takes it to be, if it may err: as the
    /// object was seen, and as the hand was to go.
    pub(crate) tool_in_object: Option<Pose>,
}

impl Simulation {
    /// Logs what has slipped out of a hand in the step.
    pub(crate) fn tell_of_slips(&self, image: &mut Image, step: u64) {
        if let Some(slip) = self.world.slip_since(step, |_| true) {
            let failure = MotionFailure::HeldObjectSlipped(Box::new(slip.clone()));
            self.log(
                image,
                LogLevel::Warn,
                "(PICK-PLACE HOLD)",
                &failure.to_string(),
            );
        }
    }

    /// Logs what was upright in a hand and has been tilted in the step.
    pub(crate) fn tell_of_tilts(&self, image: &mut Image, step: u64) {
        for tilt in self.world.tilts_since(step) {
            // What is known to be in a vessel is counted, and may be meant to leave it.
            let content = self.world.object(&tilt.object).map(|held| held.content());
            if content.is_ok_and(|content| !content.what.is_empty()) {
                continue;
            }
            let text = format!(
                "{} in the {} hand is open at the top and was tilted by more than {:.0} degrees: what is in \
                 it or on it falls out.",
                tilt.object,
                tilt.side,
                MOST_TILT.to_degrees()
            );
            self.log(image, LogLevel::Warn, "(PICK-PLACE HOLD)", &text);
        }
    }

    /// Names of the objects that a hand holds.
    pub(crate) fn held_by(&self, side: Side) -> Vec<String> {
        robotics::motion::held_objects(&self.world, side)
    }

    /// The hand that holds an object.
    pub(crate) fn hand_of(&self, object: &str) -> Option<Side> {
        let mut sides = self.models.description.sides();
        sides.find(|side| self.held_by(*side).iter().any(|name| name == object))
    }

    /// How a hand holds an object.
    pub(crate) fn grip_on(&self, object: &str, side: Side) -> Result<HeldGrip, WorldError> {
        let held = self.held.get(object);
        let kind = self.world.object(object)?.type_name();
        let grasp = held.and_then(|held| self.definition(kind, side, held.grasp.as_ref()?));
        let turn = held.map_or(0.0, |held| held.turn);
        let grip = HeldGrip::of(&self.world, side, object, grasp.as_ref(), turn)?;
        Ok(match held.and_then(|held| held.tool_in_object) {
            Some(tool) => grip.as_believed(tool),
            None => grip,
        })
    }

    /// How the robot takes a hand to hold an object that it sees at a pose in the frame of the base: the
    /// pose of the tool in the frame of the object; `None` if it does not err.
    pub(crate) fn believed_grip(&self, object_in_base: &Pose, side: Side) -> Option<Pose> {
        let noise = self.world.noise()?;
        let arm = self.models.description.arm(side);
        let tool = arm.tool_for_wrist(&self.world.link_pose(arm.wrist));
        let tool = noise.believed_hand(side, &(self.base().inverse() * tool));
        Some(object_in_base.inverse() * tool)
    }

    /// Where the robot takes an object to be, in the map, that a hand holds.
    pub(crate) fn held_pose(&self, object: &str, side: Side) -> Result<Pose, WorldError> {
        let believed = self.held.get(object).and_then(|held| held.tool_in_object);
        let Some(tool_in_object) = believed else {
            return Ok(self.world.to_belief(&self.world.object_pose(object)?));
        };
        let arm = self.models.description.arm(side);
        let tool = arm.tool_for_wrist(&self.world.link_pose(arm.wrist));
        Ok(self.world.to_belief(&tool) * tool_in_object.inverse())
    }

    /// Corrects how the robot takes a hand to hold an object, if it sees a held one.
    pub(super) fn see_grip(&mut self, object: &str, in_base: &Pose) {
        let Some(side) = self.held.get(object).map(|held| held.side) else {
            return;
        };
        let believed = self.believed_grip(in_base, side);
        if let Some(held) = self.held.get_mut(object) {
            held.tool_in_object = believed;
        }
    }
}
