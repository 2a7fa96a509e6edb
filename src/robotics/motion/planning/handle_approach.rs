//! The way of a hand to the bar of a handle, and away from it afterwards.

use nalgebra::Translation3;

use super::configuration::with_joints;
use crate::motion::contact::guard::GREATEST_LAG;
use crate::robot::{ArmPositions, JointId, Side};
use crate::world::{
    AllowedPairs, BodyName, CollisionHit, MovedPart, MovingParts, RobotConfiguration, World,
};
use spatial::Pose;

/// How far (m) the fingers are apart when the hand comes to a handle, and when it leaves it.
pub(crate) const OPENING: f64 = 0.06;
/// How far (m) the hand is from the bar before it approaches, and after it has withdrawn.
const AWAY: f64 = 0.1;
/// Clearance (m) of the robot while the hand approaches and withdraws: a little more than what
/// planned paths keep.
const MARGIN: f64 = 0.0045;
/// Distance (m) of points of the approach.
const APPROACH_STEP: f64 = 0.02;
/// By how much more the joints of the arm may change between them than between points of other ways.
pub(crate) const APPROACH_JUMP: f64 = 2.0;

/// From the bar to where the hand is before the approach, along the tool's axis.
pub(crate) fn away() -> Translation3<f64> {
    Translation3::new(-AWAY, 0.0, 0.0)
}

/// Poses of the tool up to the one at the bar.
pub(crate) fn approach(tool: &Pose) -> Vec<Pose> {
    line(&(tool * away()), tool)
}

/// Poses of the tool from the one at the bar to where the hand has withdrawn.
pub(crate) fn withdrawal(tool: &Pose) -> Vec<Pose> {
    line(tool, &(tool * away()))
}

/// Poses on a straight line between two of the same orientation.
fn line(from: &Pose, to: &Pose) -> Vec<Pose> {
    let count = (AWAY / APPROACH_STEP).ceil() as u32;
    let at = |i: u32| spatial::pose::between(from, to, f64::from(i) / f64::from(count));
    (0..=count).map(at).collect()
}

/// A robot with a hand as open as it approaches and withdraws.
pub(crate) fn with_open_hand(
    world: &World,
    robot: &RobotConfiguration,
    side: Side,
) -> RobotConfiguration {
    let gripper = &world.models().description.arm(side).gripper;
    let mut open = robot.clone();
    let position = gripper.position_for_opening(OPENING);
    open.joints.set(gripper.joint, position);
    open
}

/// What the robot would touch, with an arm at one of some positions and a drawer or door where it is moved to; what
/// is close in any case does not count.
pub(crate) fn obstacle(
    world: &World,
    (robot, side): (&RobotConfiguration, Side),
    part: &MovedPart<'_>,
    close: &AllowedPairs,
    points: &[ArmPositions],
) -> Option<CollisionHit> {
    let mut checker = part.checker();
    let joints = world.models().description.arm(side).joints();
    points.iter().find_map(|point| {
        let there = with_joints(robot, joints, point);
        checker.first_hit(&there, close, MARGIN)
    })
}

/// The links of the robot that are close to each other as it stands, and that neither the torso nor one of the arms
/// moves relative to each other: a head that looks down at its shoulders, say, wherever the base is.
pub(crate) fn close_links(world: &World, arms: &[Side]) -> AllowedPairs {
    let models = world.models();
    let mut moved: Vec<JointId> = models.description.torso.joint.into_iter().collect();
    for side in arms {
        let arm = models.description.arm(*side);
        moved.extend(arm.joints());
        moved.push(arm.gripper.joint);
    }
    let parts = MovingParts::of_joints(&models.robot, &moved);
    let robot = world.robot_configuration();
    let mut checker = world.collision_checker();
    let near = checker.all_hits(robot, &AllowedPairs::none(), MARGIN);
    near.into_iter().fold(AllowedPairs::none(), |close, hit| {
        let links = [&hit.moving, &hit.other].map(BodyName::robot_link);
        match links {
            [Some(one), Some(other)] if !parts.part(one, other) && hit.depth < GREATEST_LAG => {
                close.and(hit.moving, hit.other)
            }
            _ => close,
        }
    })
}
