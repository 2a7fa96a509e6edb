//! Arms: joint goals, hand goals of one and of both arms, putting down, and what is refused.

use nalgebra::Translation3;

use super::fixture::{Kitchen, Outcome};
use crate::motion::planning::cartesian_path::tcp_in_base;
use crate::motion::{
    CollisionMode, Motion, MotionFailure, MotionOutcome, MotionStatus, MoveJoints, MoveTcp,
    PoseGoal, Put, TcpPath, UnreachableReason,
};
use crate::robot::{ArmPositions, Side};
use spatial::Pose;
use spatial::pose::{angle_between, distance_between, from_xyz_rpy};

const ARRIVED: Result<MotionOutcome, MotionFailure> = Ok(MotionOutcome::Arrived);

fn positions(kitchen: &Kitchen, side: Side) -> ArmPositions {
    let arm = kitchen.world.models().description.arm(side);
    arm.positions(&kitchen.world.robot_configuration().joints)
}

#[test]
fn arms_end_where_they_were_asked_to_and_continuous_joints_do_not_jump_by_turns() {
    let mut kitchen = Kitchen::new();
    let mut park = kitchen.park(true, true);
    let mut before = Side::BOTH.map(|side| positions(&kitchen, side));
    while park.tick(&mut kitchen.world) == MotionStatus::Running {
        kitchen.world.step();
        for (side, before) in Side::BOTH.into_iter().zip(&mut before) {
            let now = positions(&kitchen, side);
            for (a, b) in before.iter().zip(now) {
                // The fastest joints move at 1.5 rad/s.
                assert!((a - b).abs() < 1.6 / 240.0, "{side}: {before:?} to {now:?}");
            }
            *before = now;
        }
    }
    for side in Side::BOTH {
        let wanted = *kitchen
            .world
            .models()
            .description
            .arm(side)
            .posture("park")
            .unwrap();
        for (is, wanted) in positions(&kitchen, side).into_iter().zip(wanted) {
            let turns = (is - wanted) / std::f64::consts::TAU;
            assert!((turns - turns.round()).abs() < 1e-12, "{is} for {wanted}");
        }
    }
}

#[test]
fn one_arm_moves_without_the_other() {
    let mut kitchen = Kitchen::new();
    let left = positions(&kitchen, Side::Left);
    let park = kitchen.park(false, true);
    assert_eq!(kitchen.run_one(park), ARRIVED);
    assert_eq!(positions(&kitchen, Side::Left), left);
}

#[test]
fn six_numbers_are_no_goal_for_an_arm() {
    let mut kitchen = Kitchen::new();
    let failure = kitchen
        .run_one(MoveJoints::new(Some(vec![0.0; 6]), None))
        .unwrap_err();
    assert_eq!(
        failure.to_string(),
        "length of joints list is incorrect: the left arm has 7 joints, not 6"
    );
}

#[test]
fn a_goal_beyond_a_hard_limit_names_the_joint_and_its_range() {
    let mut kitchen = Kitchen::new();
    let goal = vec![0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0];
    let failure = kitchen
        .run_one(MoveJoints::new(None, Some(goal)))
        .unwrap_err();
    assert_eq!(
        failure.to_string(),
        "r_elbow_flex_joint would have to be at 0.500 rad, 0.500 rad outside of its limits -2.321..0.000"
    );
}

#[test]
fn an_arm_does_not_go_through_the_own_body() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.1);
    let goal = vec![-0.7, 1.2, 3.5, -2.2, 0.0, -0.2, 0.0];
    let failure = kitchen
        .run_one(MoveJoints::new(Some(goal), None))
        .unwrap_err();
    assert!(
        matches!(failure, MotionFailure::ArmGoalInCollision { .. }),
        "{failure}"
    );
}

#[test]
fn both_hands_reach_their_goals_at_the_same_time() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.2);
    let goal = |y: f64| from_xyz_rpy([0.7, y, 0.9], [0.0; 3]);
    let motion = MoveTcp::new(
        Some(PoseGoal::InBase(goal(0.25))),
        Some(PoseGoal::InBase(goal(-0.25))),
        TcpPath::Free,
        CollisionMode::AvoidAll,
    );
    assert_eq!(kitchen.run_one(motion), ARRIVED);
    for (side, y) in [(Side::Left, 0.25), (Side::Right, -0.25)] {
        let hand = tcp_in_base(&kitchen.world, side);
        assert!(distance_between(&hand, &goal(y)) < 1e-9, "{hand}");
        assert!(angle_between(&hand, &goal(y)) < 1e-7, "{hand}");
    }
}

#[test]
fn a_goal_in_the_map_is_reached_in_the_map() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.2);
    let goal = from_xyz_rpy([0.7, 0.2, 0.9], [0.0; 3]);
    let goals = (None, Some(PoseGoal::InMap(goal)));
    let motion = MoveTcp::new(goals.0, goals.1, TcpPath::Free, CollisionMode::AvoidAll);
    assert_eq!(kitchen.run_one(motion), ARRIVED);
    let hand = kitchen.world.robot_configuration().base * tcp_in_base(&kitchen.world, Side::Right);
    assert!(distance_between(&hand, &goal) < 1e-9, "{hand}");
}

#[test]
fn hands_that_need_different_heights_of_the_torso_say_which() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.2);
    let goal = |y: f64, z: f64| Some(PoseGoal::InBase(from_xyz_rpy([0.8, y, z], [0.0; 3])));
    let motion = MoveTcp::new(
        goal(0.2, 1.5),
        goal(-0.2, 0.35),
        TcpPath::Free,
        CollisionMode::AvoidAll,
    );
    let failure = kitchen.run_one(motion).unwrap_err();
    let text = failure.to_string();
    assert!(
        text.starts_with("In MOVE-TCP goals for the two arms require different torso angles).\n"),
        "{text}"
    );
    assert_eq!(failure.class_name(), "MANIPULATION-POSE-UNREACHABLE");
}

#[test]
fn a_pose_out_of_reach_says_by_how_much() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.2);
    let far = from_xyz_rpy([2.0, 0.0, 1.0], [0.0; 3]);
    let motion = kitchen.tcp(Side::Left, far, TcpPath::Free, CollisionMode::AvoidAll);
    let failure = kitchen.run_one(motion).unwrap_err();
    let MotionFailure::PoseUnreachable(unreachable) = &failure else {
        panic!("{failure}")
    };
    assert!(matches!(unreachable.reason, UnreachableReason::Arm { .. }));
    assert!(
        failure.to_string().contains("))> is unreachable for EE.\n"),
        "{failure}"
    );
}

#[test]
fn a_pose_inside_furniture_says_what_is_there() {
    let mut kitchen = Kitchen::parked(-0.15, 2.0, 180.0, 0.1);
    let inside = from_xyz_rpy([0.6, 0.0, 0.8], [0.0; 3]);
    let motion = kitchen.tcp(Side::Right, inside, TcpPath::Free, CollisionMode::AllowAll);
    let failure = kitchen.run_one(motion).unwrap_err();
    let MotionFailure::PoseUnreachable(unreachable) = &failure else {
        panic!("{failure}")
    };
    let UnreachableReason::Collisions { hit, .. } = &unreachable.reason else {
        panic!("{failure}")
    };
    assert!(hit.other.to_string().contains("island"), "{failure}");
}

#[test]
fn a_straight_path_stays_on_the_line() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.2);
    let [from, to] = [[0.6, -0.2, 0.9], [0.7, -0.2, 1.1]].map(|p| from_xyz_rpy(p, [0.0; 3]));
    let reach = kitchen.tcp(Side::Right, from, TcpPath::Free, CollisionMode::AvoidAll);
    assert_eq!(kitchen.run_one(reach), ARRIVED);
    let mut line = kitchen.tcp(Side::Right, to, TcpPath::Straight, CollisionMode::AvoidAll);
    let mut farthest = 0.0_f64;
    while line.tick(&mut kitchen.world) == MotionStatus::Running {
        kitchen.world.step();
        let hand = tcp_in_base(&kitchen.world, Side::Right).translation.vector;
        let (a, b) = (from.translation.vector, to.translation.vector);
        let along = (hand - a).dot(&(b - a).normalize());
        farthest = farthest.max((hand - a - (b - a).normalize() * along).norm());
    }
    assert!(distance_between(&tcp_in_base(&kitchen.world, Side::Right), &to) < 1e-9);
    assert!(farthest < 0.004, "{farthest} m beside the line");
}

/// The robot at the table with the bottle that it has picked up.
fn bottle_in_hand() -> Kitchen {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(-1.6, -0.9, 0.83);
    let bottle = kitchen.in_base("bottle-1");
    let end = kitchen.pick(Side::Right, "left-side", "bottle-1", &bottle);
    assert!(end.is_ok(), "{end:?}");
    kitchen
}

/// Puts the bottle down for a target at a height (m).
fn try_to_put_at(kitchen: &mut Kitchen, z: f64) -> Outcome {
    let base = kitchen.world.robot_configuration().base;
    let target = base.inverse() * from_xyz_rpy([-1.55, -0.92, z], [0.0; 3]);
    let goal = kitchen.grasp_poses(Side::Right, "left-side", &target).grasp;
    kitchen.run_one(Put::new(Side::Right, PoseGoal::InBase(goal)))
}

/// As above; tells how it ended and the bottle's height.
fn put_at(kitchen: &mut Kitchen, z: f64) -> (MotionOutcome, f64) {
    let end = try_to_put_at(kitchen, z).unwrap_or_else(|f| panic!("{f}"));
    (
        end,
        kitchen.world.object_pose("bottle-1").unwrap().translation.z,
    )
}

#[test]
fn a_target_inside_the_table_ends_on_the_table() {
    let mut kitchen = bottle_in_hand();
    let (end, height) = put_at(&mut kitchen, 0.75);
    let MotionOutcome::Put {
        support: Some(support),
        raised,
    } = end
    else {
        panic!("{end:?}")
    };
    assert_eq!(support.to_string(), "table_area_main");
    assert!(
        (height - 0.8208).abs() < 0.003 && (raised - 0.07).abs() < 0.006,
        "{height} {raised}"
    );
}

#[test]
fn a_target_above_the_table_ends_on_the_table() {
    let mut kitchen = bottle_in_hand();
    let (end, height) = put_at(&mut kitchen, 0.865);
    assert!(
        matches!(
            end,
            MotionOutcome::Put {
                support: Some(_),
                ..
            }
        ),
        "{end:?}"
    );
    assert!((height - 0.8208).abs() < 0.003, "{height}");
}

#[test]
fn a_target_high_in_the_air_is_refused_and_the_hand_stays() {
    let mut kitchen = bottle_in_hand();
    let before = kitchen.world.object_pose("bottle-1").unwrap();
    let failure = try_to_put_at(&mut kitchen, 0.96).unwrap_err();
    assert_eq!(
        failure.to_string(),
        "nothing carries bottle-1 at (-1.550 -0.920 0.959) or within 5 cm below it: \
         table_area_main is 13.8 cm below"
    );
    let after = kitchen.world.object_pose("bottle-1").unwrap();
    assert!(distance_between(&before, &after) < 1e-3);
}

#[test]
fn a_hand_without_an_object_cannot_put_it_down() {
    let mut kitchen = Kitchen::parked(-0.15, 2.0, 180.0, 0.3);
    let goal = PoseGoal::InBase(from_xyz_rpy([0.6, -0.1, 1.0], [0.0; 3]));
    let failure = kitchen.run_one(Put::new(Side::Right, goal)).unwrap_err();
    assert_eq!(failure, MotionFailure::HoldsNothing { side: Side::Right });
}

#[test]
fn a_lifted_object_may_be_set_back_where_it_stood() {
    let mut kitchen = bottle_in_hand();
    let hand = tcp_in_base(&kitchen.world, Side::Right);
    let low = Pose::translation(0.0, 0.0, -0.15) * hand;
    let back = kitchen.tcp(
        Side::Right,
        low,
        TcpPath::Straight,
        CollisionMode::AllowHand,
    );
    assert_eq!(kitchen.run_one(back), ARRIVED);
}

#[test]
fn an_object_that_is_pressed_into_the_table_stops_the_motion() {
    let mut kitchen = bottle_in_hand();
    let hand = tcp_in_base(&kitchen.world, Side::Right);
    let low = Pose::translation(0.0, 0.0, -0.18) * hand;
    let press = kitchen.tcp(Side::Right, low, TcpPath::Straight, CollisionMode::AllowAll);
    kitchen.checked = false;
    let failure = kitchen.run_one(press).unwrap_err();
    let MotionFailure::HeldObjectStuck(stuck) = &failure else {
        panic!("{failure}")
    };
    assert_eq!(stuck.object, "bottle-1");
    assert_eq!(
        stuck.against.as_ref().map(ToString::to_string).as_deref(),
        Some("table_area_main")
    );
    assert!(stuck.lag < 0.015, "{failure}");
}

#[test]
fn a_hand_goal_holds_although_the_torso_moves_at_the_same_time() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.05);
    let goal = from_xyz_rpy([0.7, -0.2, 1.0], [0.0; 3]);
    let mut reach = kitchen.tcp(Side::Right, goal, TcpPath::Free, CollisionMode::AvoidAll);
    let mut torso = kitchen.torso(0.3);
    for end in kitchen.run(&mut [&mut torso, &mut reach]) {
        assert_eq!(end, ARRIVED);
    }
    assert!(distance_between(&tcp_in_base(&kitchen.world, Side::Right), &goal) < 1e-3);
}

/// What a hand holds gives way where it grazes an edge, and is torn out of the hand.
#[test]
fn what_is_carried_is_clear_of_furniture_in_a_posture_or_does_not_get_there() {
    // Facing the island, with the milk before the right hand.
    let mut kitchen = Kitchen::parked(0.0, 0.9, 180.0, 0.0);
    let arm = kitchen.world.models().description.arm(Side::Right);
    let (palm, lift, park) = (
        arm.gripper.palm,
        arm.joints()[1],
        arm.posture("park").unwrap()[1],
    );
    let at = kitchen.world.link_pose(palm) * from_xyz_rpy([0.2, 0.0, 0.0], [0.0; 3]);
    kitchen
        .world
        .spawn("milk-1", "milk", &at, None, None)
        .unwrap();
    kitchen.world.attach("milk-1", palm).unwrap();
    let parked = kitchen.world.robot_configuration().clone();
    let at = |x: f64| {
        let mut robot = parked.clone();
        robot.base.translation.x = x;
        robot
    };
    let gap = |kitchen: &Kitchen, x: f64| kitchen.room(&at(x), 0.01);
    // Where the two touch.
    let (mut touching, mut clear) = (-0.4, 0.0);
    assert!(gap(&kitchen, touching) < 0.0 && gap(&kitchen, clear) > 0.0);
    while clear - touching > 1e-6 {
        let middle = (clear + touching) / 2.0;
        *match gap(&kitchen, middle) > 0.0 {
            true => &mut clear,
            false => &mut touching,
        } = middle;
    }
    for (beside, arrives) in [
        (-0.0004, false),
        (0.0005, false),
        (0.0015, true),
        (0.006, true),
    ] {
        let x = clear + beside;
        let mut raised = at(x);
        raised.joints.set(lift, park - 0.1);
        kitchen.world.teleport_robot(&raised);
        let end = kitchen.run_one(kitchen.park(false, true));
        assert_eq!(
            end.is_ok(),
            arrives,
            "{beside} m beside: {end:?}, {}",
            gap(&kitchen, x)
        );
        assert_eq!(kitchen.world.support_force("milk-1").unwrap(), 0.0);
    }
}

#[test]
fn what_is_put_down_from_just_above_its_place_gets_there() {
    let mut kitchen = Kitchen::parked(0.0, 0.9, 180.0, 0.2);
    kitchen.spawn_bottle(-0.75, 1.1, 0.96);
    let arm = kitchen.world.models().description.arm(Side::Right);
    let (palm, wrist) = (arm.gripper.palm, arm.wrist);
    let stands = arm.tool_for_wrist(&kitchen.world.link_pose(wrist));
    kitchen.world.attach("bottle-1", palm).unwrap();
    for (above, is_carried) in [(0.003, false), (0.0, true)] {
        let goal = PoseGoal::InMap(Translation3::new(0.0, 0.0, above) * stands);
        let motion = MoveTcp::new(
            None,
            Some(goal),
            TcpPath::Straight,
            CollisionMode::AllowHand,
        );
        assert_eq!(kitchen.run_one(motion), ARRIVED);
        let force = kitchen.world.support_force("bottle-1").unwrap();
        assert_eq!(force > 0.0, is_carried, "{above} m above: {force} N");
    }
}
