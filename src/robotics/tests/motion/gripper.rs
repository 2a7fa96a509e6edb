//! Fingers: positions, limits, gripping something, nothing and something else.

use super::fixture::Kitchen;
use crate::motion::jobs::gripper::GripperCommand;
use crate::motion::{
    LetGo, Motion, MotionFailure, MotionOutcome, MotionStatus, held_objects, take_hold,
};
use crate::robot::Side;
use spatial::pose::from_xyz_rpy;

fn finger(kitchen: &Kitchen, side: Side) -> f64 {
    let joint = kitchen.world.models().description.arm(side).gripper.joint;
    kitchen.world.robot_configuration().joints.get(joint)
}

fn command(kitchen: &mut Kitchen, command: GripperCommand) -> Result<MotionOutcome, MotionFailure> {
    let gripper = kitchen.gripper(Side::Right, command);
    kitchen.run_one(gripper)
}

#[test]
fn opening_goes_to_the_limit_closing_to_zero_and_positions_in_between() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    for (order, position) in [
        (GripperCommand::Open, 0.548),
        (GripperCommand::Position(0.04), 0.2),
        (GripperCommand::Close, 0.0),
    ] {
        assert_eq!(command(&mut kitchen, order), Ok(MotionOutcome::Arrived));
        assert!((finger(&kitchen, Side::Right) - position).abs() < 1e-12);
        assert_eq!(finger(&kitchen, Side::Left), 0.0);
    }
}

#[test]
fn an_opening_that_is_too_wide_goes_as_far_as_possible_and_fails() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let failure = command(&mut kitchen, GripperCommand::Position(0.2)).unwrap_err();
    assert_eq!(failure.class_name(), "GRIPPER-GOAL-NOT-REACHED");
    assert!((finger(&kitchen, Side::Right) - 0.548).abs() < 1e-12);
}

#[test]
fn gripping_nothing_closes_completely() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    command(&mut kitchen, GripperCommand::Open).unwrap();
    let failure = command(
        &mut kitchen,
        GripperCommand::Grip {
            object: None,
            effort: None,
            together: false,
        },
    )
    .unwrap_err();
    assert_eq!(failure, MotionFailure::NothingGripped { side: Side::Right });
    assert_eq!(
        failure.to_string().lines().next(),
        Some("There was no object to grip")
    );
    assert_eq!(failure.class_name(), "GRIPPER-CLOSED-COMPLETELY");
}

/// The open right hand with a cube on the table between its fingers.
fn cube_in_hand() -> Kitchen {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(-1.6, -0.9, 0.86);
    let bottle = kitchen.in_base("bottle-1");
    let poses = kitchen.grasp_poses(Side::Right, "left-side", &bottle);
    use crate::motion::{CollisionMode, TcpPath};
    command(&mut kitchen, GripperCommand::Position(0.10)).unwrap();
    kitchen.declare_grasp(Side::Right, "bottle-1");
    for (pose, path, mode) in [
        (poses.pregrasp, TcpPath::Free, CollisionMode::AvoidAll),
        (
            poses.second_pregrasp,
            TcpPath::Free,
            CollisionMode::AvoidAll,
        ),
        (poses.grasp, TcpPath::Straight, CollisionMode::AllowHand),
    ] {
        let motion = kitchen.tcp(Side::Right, pose, path, mode);
        kitchen.run_one(motion).unwrap_or_else(|f| panic!("{f}"));
    }
    kitchen
}

#[test]
fn another_object_between_the_fingers_is_named() {
    let mut kitchen = cube_in_hand();
    let grip = GripperCommand::Grip {
        object: Some("cup-1".to_owned()),
        effort: None,
        together: false,
    };
    let failure = command(&mut kitchen, grip).unwrap_err();
    assert_eq!(
        failure.to_string(),
        "the right hand has bottle-1 between its fingers, not cup-1"
    );
    assert_eq!(failure.class_name(), "GRIPPER-CLOSED-COMPLETELY");
}

#[test]
fn what_is_let_go_stays_where_it_stands() {
    let mut kitchen = cube_in_hand();
    let before = kitchen.world.object_pose("bottle-1").unwrap();
    let gripped = command(
        &mut kitchen,
        GripperCommand::Grip {
            object: None,
            effort: None,
            together: false,
        },
    )
    .unwrap();
    assert_eq!(
        gripped,
        MotionOutcome::Gripped {
            object: "bottle-1".to_owned()
        }
    );
    take_hold(&mut kitchen.world, Side::Right, "bottle-1").unwrap();
    assert_eq!(held_objects(&kitchen.world, Side::Right), ["bottle-1"]);

    let end = kitchen.run_one(LetGo::new(Side::Right, None)).unwrap();
    assert_eq!(
        end,
        MotionOutcome::Released {
            object: "bottle-1".to_owned(),
            at_rest: true
        }
    );
    command(&mut kitchen, GripperCommand::Open).unwrap();
    kitchen.world.settle(2.0);
    let after = kitchen.world.object_pose("bottle-1").unwrap();
    let moved = (after.translation.vector - before.translation.vector).norm();
    assert!(moved < 0.002, "moved by {moved} m");
}

#[test]
fn a_hand_that_holds_nothing_cannot_let_go() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let failure = kitchen.run_one(LetGo::new(Side::Left, None)).unwrap_err();
    assert_eq!(failure, MotionFailure::HoldsNothing { side: Side::Left });
}

#[test]
fn a_sausage_on_the_floor_is_no_object_to_grip() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let at = from_xyz_rpy([1.0, -1.0, 0.1], [0.0; 3]);
    kitchen
        .world
        .spawn("wurst-1", "weisswurst", &at, None, None)
        .unwrap();
    command(&mut kitchen, GripperCommand::Open).unwrap();
    let failure = command(
        &mut kitchen,
        GripperCommand::Grip {
            object: Some("wurst-1".to_owned()),
            effort: None,
            together: false,
        },
    );
    assert_eq!(
        failure,
        Err(MotionFailure::NothingGripped { side: Side::Right })
    );
}

#[test]
fn gripping_fingers_speed_up_and_slow_down_within_their_acceleration() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    command(&mut kitchen, GripperCommand::Open).unwrap();
    let grip = GripperCommand::Grip {
        object: None,
        effort: None,
        together: false,
    };
    let mut grip = kitchen.gripper(Side::Right, grip);
    let (mut before, mut velocity, mut most) = (finger(&kitchen, Side::Right), 0.0, 0.0_f64);
    while grip.tick(&mut kitchen.world) == MotionStatus::Running {
        kitchen.world.step();
        let now = finger(&kitchen, Side::Right);
        let next = (now - before) * 240.0;
        most = most.max((next - velocity).abs() * 240.0);
        (before, velocity) = (now, next);
    }
    assert!(most < 4.5, "{most} rad/s²");
}
