//! What is in the way of a drawer or door, and of the hand that moves it.

use super::configuration::with_joints;
use super::handle_way::PartWay;
use crate::robot::{ArmPositions, LinkId, Side};
use crate::world::{AllowedPairs, CollisionHit, RobotConfiguration, World};

/// Clearance (m) of the robot on the way, except between hand and handle.
const WAY_MARGIN: f64 = 0.002;

/// The first point of the way at which the part, or what rides in it, would run into something.
pub(crate) fn part_obstacle(way: &PartWay<'_>) -> Option<(usize, CollisionHit)> {
    let mut parts = way.parts.iter().enumerate().skip(1);
    parts.find_map(|(i, part)| Some((i, part.hit()?)))
}

/// What the robot would run into on the way of its hand, at points of the arm's positions.
pub(crate) fn robot_obstacle(
    world: &World,
    robot: &RobotConfiguration,
    (side, handle): (Side, LinkId),
    way: &PartWay<'_>,
    points: &[ArmPositions],
) -> Option<(usize, CollisionHit)> {
    let models = world.models();
    let links = models.description.arm(side).gripper.links();
    let hand = links.map(|link| models.robot_body(link));
    let own = AllowedPairs::none().and_all(hand, &models.furniture_body(handle));
    let joints = models.description.arm(side).joints();
    let mut near_at_start: Vec<CollisionHit> = Vec::new();
    for (i, (part, point)) in way.parts.iter().zip(points).enumerate() {
        let there = with_joints(robot, joints, point);
        let mut checker = part.checker();
        if i == 0 {
            near_at_start = checker.all_hits(&there, &own, WAY_MARGIN);
            continue;
        }
        let hits = if near_at_start.is_empty() {
            checker
                .first_hit(&there, &own, WAY_MARGIN)
                .into_iter()
                .collect()
        } else {
            checker.all_hits(&there, &own, WAY_MARGIN)
        };
        // What is close at the start may stay close.
        let is_new = |hit: &CollisionHit| {
            let mut before = near_at_start.iter();
            let before = before.find(|b| b.moving == hit.moving && b.other == hit.other);
            before.is_none_or(|b| hit.depth > b.depth.max(0.0))
        };
        if let Some(hit) = hits.into_iter().find(is_new) {
            return Some((i, hit));
        }
    }
    None
}
