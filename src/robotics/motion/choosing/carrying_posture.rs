//! The posture in which an arm carries what is open at the top: one near the body in which that is level.
//!
//! The robot's description names postures. In each of them, the hand is turned about the wrist until what it
//! holds is level, which leaves its heading free. Where something is in the way of these, the wrist is brought
//! to one of some places before the shoulder.

use nalgebra::{Translation3, UnitQuaternion, Vector3};

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
/// Places of the wrist before the shoulders (m), forward from the arm's base, to the arm's side, and above: lower,
/// a thing would stay in a drawer from which it is taken, and the robot could not go away.
const FORWARD: [f64; 3] = [0.3, 0.4, 0.5];
const ASIDE: [f64; 3] = [0.15, 0.3, 0.45];
const ABOVE: [f64; 2] = [0.05, 0.25];
/// Every so many headings are tried there.
const FEWER_HEADINGS: u32 = 3;
/// How many postures of the description, and how many others, get a short search for a path, and how many random configurations that takes.
const SHORT_SEARCHES: usize = 8;
const SAMPLES: usize = 150;
/// How many postures get a long one.
const LONG_SEARCHES: usize = 2;

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
    let mut free: Vec<ArmPositions> = Vec::new();
    for group in carrying_postures(world, side) {
        let positions = group.into_iter().map(|carrying| carrying.positions);
        let mut some = positions.filter(|one| checker.is_free_on_way(one));
        free.extend(some.by_ref().take(SHORT_SEARCHES));
    }
    let long = JointPathEffort::default();
    let short = JointPathEffort {
        samples: SAMPLES,
        ..long
    };
    let searches = (free.iter().map(|goal| (goal, short)))
        .chain(free.iter().take(LONG_SEARCHES).map(|goal| (goal, long)));
    let mut found = searches.filter(|(goal, effort)| {
        plan_joint_trajectory(world, &group, &goal[..], &mut checker, *effort).is_ok()
    });
    found.next().map(|(goal, _)| *goal)
}

/// All postures for carrying, those of the description and the others, of both the best one first; collisions
/// are not checked.
fn carrying_postures(world: &World, side: Side) -> [Vec<Carrying>; 2] {
    let arm = world.models().description.arm(side);
    let now = arm.positions(&world.robot_configuration().joints);
    let group = PlanningGroup::new(world, false, &[side]);
    let level = LevelHands::of(world, &group.joints);
    let (mut all, mut others) = (Vec::new(), Vec::new());
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
    let carrying = |positions: ArmPositions| {
        let positions = near(arm, positions, &now);
        let travel: f64 = positions.iter().zip(&now).map(|(a, b)| (a - b).abs()).sum();
        let out = reach_over_floor(world, side, &positions);
        Carrying {
            cost: travel + REACHES_OUT * out,
            positions,
        }
    };
    for (_, posture) in &arm.postures {
        let mut settled = *posture;
        if !level.settle(&mut settled) {
            settled = *posture;
        }
        let hand = arm.kinematics.hand_rotation(&settled);
        for i in 0..HEADINGS {
            let turn = heading(i).to_rotation_matrix().into_inner();
            let turned = arm.kinematics.with_hand_turned(&settled, &(turn * hand));
            all.extend(turned.map(carrying));
        }
    }
    let mut settled = now;
    if level.settle(&mut settled) {
        let hand = arm.kinematics.hand_rotation(&settled);
        let hand = UnitQuaternion::from_matrix(&hand);
        let outward = if side == Side::Left { 1.0 } else { -1.0 };
        for x in FORWARD {
            for y in ASIDE {
                for z in ABOVE {
                    for i in (0..HEADINGS).step_by(FEWER_HEADINGS as usize) {
                        let at = Translation3::new(x, y * outward, z);
                        let to = Pose::from_parts(at, heading(i) * hand);
                        let reached = arm.kinematics.nearest(&to, &now);
                        others.extend(reached.ok().map(carrying));
                    }
                }
            }
        }
    }
    let mut groups = [all, others];
    for group in &mut groups {
        group.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    }
    groups
}

/// The turn about the vertical with that number.
fn heading(number: u32) -> UnitQuaternion<f64> {
    let angle = std::f64::consts::TAU * f64::from(number) / f64::from(HEADINGS);
    UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle)
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
/// (rad) for each joint: the one that was found last, or one of the description's, with the hand turned.
pub fn carries(world: &World, side: Side, found: Option<&ArmPositions>, tolerance: f64) -> bool {
    let arm = world.models().description.arm(side);
    let now = arm.positions(&world.robot_configuration().joints);
    let is_near = |posture: &ArmPositions, joints: usize| {
        let posture = near(arm, *posture, &now);
        let some = now.iter().zip(&posture).take(joints);
        some.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs())) <= tolerance
    };
    world.upright_in_hand(side).is_some()
        && (found.is_some_and(|found| is_near(found, found.len()))
            || arm
                .postures
                .iter()
                .any(|(_, posture)| is_near(posture, TURNED)))
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
    carrying_postures(world, side)
        .iter()
        .flatten()
        .any(|carrying| {
            let hits = checker.overlaps(&carrying.positions, 0.0);
            !hits.iter().any(|hit| own(&hit.moving) && own(&hit.other))
        })
}
