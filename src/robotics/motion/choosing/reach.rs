//! What the robot could do at a base pose, without moving: stand there, and bring a hand to
//! a pose.
//!
//! The answers agree with those of the motions; whether there is a path is not checked.

use super::hand_reach::HandReach;
use crate::motion::contact::expected_contacts::CollisionMode;
use crate::motion::failure::base_place::BasePlace;
use crate::motion::planning::base_checker::BaseChecker;
use crate::motion::planning::configuration::at_place;
use crate::robot::Side;
use crate::world::{AllowedPairs, CollisionHit, World};
use spatial::Pose;

/// Whether the base could be at the pose (m, m, rad) with torso and arms as they are: on the
/// map, without collision.
pub fn can_stand(world: &World, place: &BasePlace) -> bool {
    let [x, y, _] = *place;
    world.models().map.contains([x, y]) && BaseChecker::new(world).blocked(place, 0.0).is_none()
}

/// What the robot would touch with its base at the pose (m, m, rad) and torso and arms as
/// they are.
pub fn touching_at(world: &World, place: &BasePlace) -> Vec<CollisionHit> {
    let robot = at_place(world.robot_configuration(), place);
    let mut checker = world.collision_checker();
    checker.all_hits(&robot, &AllowedPairs::none(), 0.0)
}

/// Whether the tool of a hand could be at the pose in the frame of the base, at any height
/// of the torso, while the robot touches nothing but what the mode permits, and of objects only
/// the target, if one is named.
pub fn can_reach(
    world: &World,
    side: Side,
    tool: &Pose,
    mode: CollisionMode,
    target: Option<&str>,
) -> bool {
    let robot = world.robot_configuration().clone();
    HandReach::new(world, robot, side, &[]).reaches(&[(*tool, mode)], target)
}
