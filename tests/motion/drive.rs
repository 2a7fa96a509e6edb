//! Driving: what is in the way, and what is said about it.

use super::fixture::Kitchen;
use crate::motion::drive_plan::plan_drive;
use crate::motion::{Motion, MotionFailure, MotionOutcome, MotionStatus};
use crate::spatial::pose::{from_xyz_rpy, yaw};

/// Where the base is: x and y (m), heading (degrees).
fn place(kitchen: &Kitchen) -> [f64; 3] {
    let base = kitchen.world.robot_configuration().base;
    [
        base.translation.x,
        base.translation.y,
        yaw(&base).to_degrees(),
    ]
}

fn assert_place(kitchen: &Kitchen, wanted: [f64; 3]) {
    let place = place(kitchen);
    let turn = (place[2] - wanted[2] + 540.0).rem_euclid(360.0) - 180.0;
    let off = (place[0] - wanted[0]).abs() + (place[1] - wanted[1]).abs() + turn.abs();
    assert!(off < 1e-9, "{place:?} instead of {wanted:?}");
}

#[test]
fn parked_arms_are_carried_sideways_through_the_passage_at_the_table() {
    // The passage is 1.14 m wide, the robot with parked arms and lowered torso 1.49 m.
    let mut kitchen = Kitchen::parked(-0.15, 1.0, 180.0, 0.0);
    let drive = kitchen.drive(-2.6, 1.0, 0.0);
    assert_eq!(kitchen.run_one(drive), Ok(MotionOutcome::Arrived));
    assert_place(&kitchen, [-2.6, 1.0, 0.0]);
}

#[test]
fn all_places_of_the_tutorial_can_be_driven_to_one_after_the_other() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let places = [
        [-1.447, -0.15, -90.0],
        [-0.15, 2.0, 180.0],
        [0.0, 1.0, 0.0],
        [-2.6, 1.5, 45.0],
        [0.0; 3],
    ];
    for [x, y, yaw] in places {
        let drive = kitchen.drive(x, y, yaw);
        assert_eq!(kitchen.run_one(drive), Ok(MotionOutcome::Arrived));
        assert_place(&kitchen, [x, y, yaw]);
    }
}

#[test]
fn a_place_inside_furniture_is_refused_with_the_pair_and_the_nearest_free_place() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.0);
    let drive = kitchen.drive(-1.0, 0.5, 0.0);
    let failure = kitchen.run_one(drive).unwrap_err();
    assert_eq!(failure.class_name(), "NAVIGATION-POSE-UNREACHABLE");
    let MotionFailure::GoalOccupied {
        hit,
        nearest_free: Some(free),
        ..
    } = failure
    else {
        panic!("{failure}");
    };
    assert!(hit.moving.robot_link().is_some(), "{hit:?}");
    assert_eq!(place(&kitchen), [0.0; 3]);
    // The place that was proposed is free indeed.
    let drive = kitchen.drive(free[0], free[1], 0.0);
    assert_eq!(kitchen.run_one(drive), Ok(MotionOutcome::Arrived));
}

#[test]
fn objects_on_the_floor_are_driven_around() {
    let mut kitchen = Kitchen::parked(0.0, -0.2, 0.0, 0.3);
    let at = from_xyz_rpy([0.1, 0.8, 0.1], [0.0; 3]);
    kitchen
        .world
        .spawn("cube-1", "cube", &at, None, None)
        .unwrap();
    assert!(kitchen.world.settle(5.0));
    let before = kitchen.world.object_pose("cube-1").unwrap();
    let drive = kitchen.drive(0.1, 1.9, 0.0);
    assert_eq!(kitchen.run_one(drive), Ok(MotionOutcome::Arrived));
    let after = kitchen.world.object_pose("cube-1").unwrap();
    assert!((after.translation.vector - before.translation.vector).norm() < 1e-3);
}

#[test]
fn a_robot_behind_a_barrier_is_told_what_bars_the_way() {
    let mut kitchen = Kitchen::parked(-2.6, 1.5, 0.0, 0.0);
    // The only way out leads through the passage between table and island.
    for (i, y) in [-0.5, -0.2, 0.1, 0.4].into_iter().enumerate() {
        let at = from_xyz_rpy([-1.0, y, 0.1], [0.0; 3]);
        kitchen
            .world
            .spawn(&format!("cube-{i}"), "cube", &at, None, None)
            .unwrap();
    }
    assert!(kitchen.world.settle(5.0));
    let drive = kitchen.drive(0.3, 1.0, 0.0);
    let failure = kitchen.run_one(drive).unwrap_err();
    let MotionFailure::Enclosed { blockers, .. } = &failure else {
        panic!("{failure}")
    };
    assert!(blockers.iter().any(|b| b.object().is_some()), "{failure}");
}

#[test]
fn a_cancelled_drive_leaves_the_robot_where_it_is() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let mut drive = kitchen.drive(0.0, 1.0, 0.0);
    for _ in 0..240 {
        assert_eq!(drive.tick(&mut kitchen.world), MotionStatus::Running);
        kitchen.world.step();
    }
    drive.cancel();
    let before = place(&kitchen);
    assert!(before[1] > 0.1, "{before:?}");
    for _ in 0..24 {
        drive.tick(&mut kitchen.world);
        kitchen.world.step();
    }
    assert_eq!(place(&kitchen), before);
}

#[test]
fn the_same_drive_is_planned_with_the_same_bits() {
    let kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.0);
    let plan = || plan_drive(&kitchen.world, [-1.447, -0.15, -1.57]).unwrap();
    assert_eq!(plan(), plan());
}

#[test]
fn the_arms_may_be_spread_on_the_way_into_a_passage_that_is_too_narrow_for_them() {
    // Torso down: the parked arms are at the height of the island's top.
    let mut kitchen = Kitchen::new();
    let (mut drive, mut torso, mut park) = (
        kitchen.drive(-1.447, -0.15, -90.0),
        kitchen.torso(0.0),
        kitchen.park(true, true),
    );
    for end in kitchen.run(&mut [&mut drive, &mut torso, &mut park]) {
        assert_eq!(end, Ok(MotionOutcome::Arrived));
    }
    assert_place(&kitchen, [-1.447, -0.15, -90.0]);
}
