//! What the hands hold, and taking hold of an object between the fingers.

use super::hand::{GRIP_FORCE, gripper_of, pressing_on};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::robot::Side;
use crate::world::World;

/// Makes the fingers of a hand hold the object on which both press, each with the effort (N).
pub(crate) fn press(
    world: &mut World,
    side: Side,
    object: &str,
    effort: f64,
) -> Result<(), MotionFailure> {
    world
        .hold(object, side, effort)
        .map_err(|e| MotionFailure::UnknownName(e.to_string()))
}

/// Makes the fingers of a hand hold an object on which both press, together with the other hand if that holds it.
pub(crate) fn press_too(
    world: &mut World,
    side: Side,
    object: &str,
    effort: f64,
) -> Result<(), MotionFailure> {
    world
        .hold_too(object, side, effort)
        .map_err(|e| MotionFailure::UnknownName(e.to_string()))
}

/// Makes sure that the hand holds the object: that its fingers do already, or that both press on
/// it.
pub fn take_hold(world: &mut World, side: Side, object: &str) -> Result<(), MotionFailure> {
    if held_objects(world, side).iter().any(|held| held == object) {
        return Ok(());
    }
    let forces = pressing_on(world, side, object);
    if forces.iter().any(|force| *force <= GRIP_FORCE) {
        return Err(MotionFailure::NotBetweenFingers {
            side,
            object: object.to_owned(),
            forces,
        });
    }
    let effort = gripper_of(world, side).effort;
    press(world, side, object, effort)
}

/// Names of the objects that the hand holds.
pub fn held_objects(world: &World, side: Side) -> Vec<String> {
    let palm = world.models().description.arm(side).gripper.palm;
    let held = world.objects().filter(|o| o.attachment_to(palm).is_some());
    held.map(|o| o.name().to_owned()).collect()
}
