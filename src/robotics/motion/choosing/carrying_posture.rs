//! The posture in which an arm carries what is open at the top: one near the body in which that is level.
//!
//! The robot's description names postures. In each of them, the hand is turned about the wrist until what it
//! holds is level, which leaves its heading free.

use nalgebra::{Matrix3, Rotation3, Vector3};

use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::level::LevelHands;
use crate::motion::planning::configuration::with_joints;
use crate::motion::planning::configuration_checker::ConfigurationChecker;
use crate::motion::planning::joint_path::JointPathEffort;
use crate::motion::planning::joint_trajectory::plan_joint_trajectory;
use crate::motion::planning::planning_group::PlanningGroup;
use crate::robot::description::Arm;
use crate::robot::{ArmPositions, Side};
use crate::world::{BodyName, World};
use spatial::{Pose, trig};

/// Name of the posture in which an arm is parked.
const PARKED: &str = "park";
/// Number of headings of the hand that are tried in each posture.
const HEADINGS: u32 = 24;
/// Cost (rad of joint motion) of each metre by which the robot with the object reaches out over the floor.
const REACHES_OUT: f64 = 20.0;
/// How many joints of a posture are kept; the others turn the hand.
const TURNED: usize = 4;
/// How many postures are looked for a path to.
const PATHS: usize = 4;

/// A posture in which a hand carries something.
struct Carrying {
    cost: f64,
    positions: ArmPositions,
}

/// The posture in which an arm carries what is open at the top and upright in its hand, and to which it
/// finds a path; `None` if it holds no such thing, or if there is none.
pub fn carrying_posture(world: &World, side: Side) -> Option<ArmPositions> {
    let group = PlanningGroup::new(world, false, &[side]);
    let level = LevelHands::of(world, &group.joints);
    if level.is_empty() {
        return None;
    }
    let contacts = ExpectedContacts::of(world, [side].into_iter(), CollisionMode::AvoidAll, None);
    let mut checker =
        ConfigurationChecker::new(world, group.joints.clone(), &contacts).keeping(level);
    let mut all = carrying_postures(world, side);
    all.retain(|carrying| checker.obstacle(&carrying.positions).is_none());
    let effort = JointPathEffort::default();
    let mut found = all.iter().take(PATHS);
    found
        .find(|carrying| {
            plan_joint_trajectory(world, &group, &carrying.positions, &mut checker, effort).is_ok()
        })
        .map(|carrying| carrying.positions)
}

/// All postures for carrying, the best one first; collisions are not checked.
fn carrying_postures(world: &World, side: Side) -> Vec<Carrying> {
    let arm = world.models().description.arm(side);
    let now = arm.positions(&world.robot_configuration().joints);
    let group = PlanningGroup::new(world, false, &[side]);
    let level = LevelHands::of(world, &group.joints);
    let mut all = Vec::new();
    // The arm is parked as usual where that keeps level what it holds.
    let parked = arm.posture(PARKED).map(|posture| near(arm, *posture, &now));
    all.extend(
        parked
            .filter(|posture| level.tilted(posture).is_none())
            .map(|positions| Carrying {
                cost: 0.0,
                positions,
            }),
    );
    for (_, posture) in &arm.postures {
        let mut settled = *posture;
        if !level.settle(&mut settled) {
            settled = *posture;
        }
        let hand = arm.kinematics.hand_rotation(&settled);
        for i in 0..HEADINGS {
            let heading = std::f64::consts::TAU * f64::from(i) / f64::from(HEADINGS);
            let turn: Matrix3<f64> =
                Rotation3::from_axis_angle(&Vector3::z_axis(), heading).into_inner();
            let Some(positions) = arm.kinematics.with_hand_turned(&settled, &(turn * hand)) else {
                continue;
            };
            let positions = near(arm, positions, &now);
            let travel: f64 = positions.iter().zip(&now).map(|(a, b)| (a - b).abs()).sum();
            let out = reach_over_floor(world, side, &positions);
            all.push(Carrying {
                cost: travel + REACHES_OUT * out,
                positions,
            });
        }
    }
    all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    all
}

/// The positions with the continuous joints turned to within half a turn of where they are.
fn near(arm: &Arm, mut positions: ArmPositions, now: &ArmPositions) -> ArmPositions {
    for ((to, from), limits) in positions.iter_mut().zip(now).zip(arm.kinematics.limits()) {
        if limits.is_none() {
            *to = from + trig::wrap(*to - from);
        }
    }
    positions
}

/// How far (m) what a hand holds is from the middle of the base at most, seen from above.
fn reach_over_floor(world: &World, side: Side, positions: &ArmPositions) -> f64 {
    let Some((object, held)) = world.upright_in_hand(side) else {
        return 0.0;
    };
    let models = world.models();
    let arm = models.description.arm(side);
    let robot = with_joints(world.robot_configuration(), arm.joints(), positions);
    let palm = arm.gripper.palm;
    let palm = models
        .robot
        .link_pose(palm, &Pose::identity(), &robot.joints);
    let at = (palm * held.at).translation;
    let [x, y, _] = object.size();
    libm::hypot(at.x, at.y) + libm::hypot(x, y) / 2.0
}

/// Whether an arm that holds something open at the top upright is in a posture for carrying it, up to an angle
/// (rad) for each joint.
pub fn carries(world: &World, side: Side, tolerance: f64) -> bool {
    let arm = world.models().description.arm(side);
    let now = arm.positions(&world.robot_configuration().joints);
    let is_near = |posture: &ArmPositions| {
        let upper = now.iter().zip(posture).take(TURNED);
        upper.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) <= tolerance
    };
    world.upright_in_hand(side).is_some()
        && arm.postures.iter().any(|(_, posture)| is_near(posture))
}

/// Whether there is a posture in which the arm can carry what it holds, whatever is around the robot.
pub(crate) fn can_carry(world: &World, side: Side) -> bool {
    let Some((object, _)) = world.upright_in_hand(side) else {
        return true;
    };
    let group = PlanningGroup::new(world, false, &[side]);
    let contacts = ExpectedContacts::of(world, [side].into_iter(), CollisionMode::AvoidAll, None);
    let mut checker = ConfigurationChecker::new(world, group.joints.clone(), &contacts);
    let own = |body: &BodyName| {
        matches!(body, BodyName::Robot(_)) || body.object() == Some(object.name())
    };
    carrying_postures(world, side).iter().any(|carrying| {
        let hits = checker.overlaps(&carrying.positions, 0.0);
        !hits.iter().any(|hit| own(&hit.moving) && own(&hit.other))
    })
}
