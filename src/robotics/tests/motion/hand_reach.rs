//! What hands reach, asked many times of one hand.

use super::fixture::Kitchen;
use crate::motion::choosing::hand_reach::HandReach;
use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::planning::configuration_checker::ConfigurationChecker;
use crate::motion::planning::pose_goal::{PathSearch, PoseGoalTask, TORSO_STEP};
use crate::robot::Side;
use crate::world::World;
use spatial::Pose;
use spatial::pose::from_xyz_rpy;

/// A table with a bottle, a cup and a bowl, before which the robot stands.
fn set_table() -> Kitchen {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.2);
    for (name, kind, x) in [
        ("bottle-1", "bottle", -1.6),
        ("cup-1", "cup", -1.48),
        ("bowl-1", "bowl", -1.3),
    ] {
        let at = from_xyz_rpy([x, -0.85, 0.83], [0.0; 3]);
        kitchen.world.spawn(name, kind, &at, None, None).unwrap();
    }
    kitchen.world.settle(2.0);
    kitchen
}

/// Whether any posture at any height is free, without any proof that none is.
fn any_posture(
    world: &World,
    side: Side,
    tool: &Pose,
    mode: CollisionMode,
    target: Option<&str>,
) -> bool {
    let contacts = ExpectedContacts::of(world, [side].into_iter(), mode, target);
    let task = PoseGoalTask {
        world,
        goals: vec![(side, *tool)],
        contacts,
        search: PathSearch::Long,
        leaves_room: false,
    };
    task.heights(TORSO_STEP).into_iter().any(|height| {
        let group = task.group(height);
        let joints = group.joints.clone();
        let mut checker = ConfigurationChecker::new(world, joints, &task.contacts);
        let mut postures = task.configurations(height, &group).into_iter();
        postures.any(|posture| checker.is_free(&posture.positions))
    })
}

#[test]
fn a_hand_that_is_asked_often_answers_as_all_postures_do() {
    let kitchen = set_table();
    let world = &kitchen.world;
    let robot = world.robot_configuration().clone();
    let mut random = 7_u64;
    let mut between = |least: f64, most: f64| {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        least + (most - least) * ((random >> 40) as f64 / (1_u64 << 24) as f64)
    };
    let mut hands =
        [Side::Left, Side::Right].map(|side| HandReach::new(world, robot.clone(), side, &[]));
    let (mut reached, mut blocked, mut missed) = (0, 0, 0);
    for round in 0..150 {
        let tool = from_xyz_rpy(
            [between(0.3, 0.9), between(-0.4, 0.4), between(0.6, 1.1)],
            [0.0, between(-0.2, 1.6), between(-0.8, 0.8)],
        );
        let (mode, target) = match round % 3 {
            0 => (CollisionMode::AvoidAll, None),
            1 => (CollisionMode::AllowHand, Some("cup-1")),
            _ => (CollisionMode::AllowHand, Some("bottle-1")),
        };
        for (hand, side) in hands.iter_mut().zip([Side::Left, Side::Right]) {
            let expected = any_posture(world, side, &tool, mode, target);
            let told = hand.reaches(&[(tool, mode)], target);
            assert_eq!(told, expected, "{side:?} {tool:?} {mode:?} {target:?}");
            match (told, hand.is_surely_blocked(&tool, mode, target)) {
                (true, is_blocked) => {
                    assert!(!is_blocked);
                    reached += 1;
                }
                (false, true) => blocked += 1,
                (false, false) => missed += 1,
            }
        }
    }
    assert!(
        reached > 20 && blocked > 20 && missed > 20,
        "{reached} reached, {blocked} blocked, {missed} missed"
    );
}

#[test]
fn what_is_taken_not_to_be_there_is_in_no_hand_s_way() {
    let kitchen = set_table();
    let mut without = kitchen.world.clone();
    without.remove("cup-1").unwrap();
    let world = &kitchen.world;
    let robot = world.robot_configuration().clone();
    let absent = ["cup-1".to_owned()];
    let mut changed = 0;
    for side in [Side::Left, Side::Right] {
        let mut with = HandReach::new(world, robot.clone(), side, &[]);
        let mut hand = HandReach::new(world, robot.clone(), side, &absent);
        let mut other = HandReach::new(&without, robot.clone(), side, &[]);
        let base = robot.base.inverse();
        for step in 0..180 {
            let (x, z, pitch) = (step % 20, step / 20 % 3, step / 60);
            let place = [
                -1.68 + 0.02 * f64::from(x),
                -0.85,
                0.74 + 0.04 * f64::from(z),
            ];
            let tool = base * from_xyz_rpy(place, [0.0, 0.75 * f64::from(pitch), -1.5]);
            let way = [(tool, CollisionMode::AvoidAll)];
            let told = hand.reaches(&way, None);
            assert_eq!(told, other.reaches(&way, None), "{side:?} {place:?}");
            changed += usize::from(told != with.reaches(&way, None));
        }
    }
    assert!(changed > 0, "the cup was in no way");
}
