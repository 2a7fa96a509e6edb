//! Driving: what is in the way, and what is said about it.

use super::fixture::Kitchen;
use crate::motion::{Motion, MotionFailure, MotionOutcome, MotionStatus, plan_drive};
use crate::robot::Side;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use spatial::pose::{from_xy_yaw, from_xyz_rpy, yaw};

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
fn a_cancelled_drive_brakes_and_leaves_the_robot_where_it_stops() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let mut drive = kitchen.drive(0.0, 1.0, 0.0);
    for _ in 0..240 {
        assert_eq!(drive.tick(&mut kitchen.world), MotionStatus::Running);
        kitchen.world.step();
    }
    drive.cancel();
    let began = place(&kitchen);
    assert!(began[1] > 0.1, "{began:?}");
    assert!(drive.is_moving());
    let mut steps = 0;
    while drive.is_moving() {
        drive.brake(&mut kitchen.world);
        kitchen.world.step();
        steps += 1;
    }
    // From 0.5 m/s at 1 m/s².
    assert!((60..=130).contains(&steps), "{steps} steps");
    let stopped = place(&kitchen);
    assert!(
        (0.05..0.14).contains(&(stopped[1] - began[1])),
        "{stopped:?}"
    );
    for _ in 0..24 {
        drive.tick(&mut kitchen.world);
        kitchen.world.step();
    }
    assert_eq!(place(&kitchen), stopped);
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

/// Ticks the drive to its end, or until `stop`; returns the greatest acceleration (m/s²) of the
/// base, and the drive's end.
fn drive_watching(
    kitchen: &mut Kitchen,
    drive: &mut impl Motion,
    mut disturb: impl FnMut(&mut Kitchen, u32),
) -> (f64, MotionStatus) {
    let at = |kitchen: &Kitchen| place(kitchen);
    let (mut before, mut velocity, mut most) = (at(kitchen), [0.0; 2], 0.0_f64);
    for step in 0..240 * 60 {
        disturb(kitchen, step);
        let status = drive.tick(&mut kitchen.world);
        kitchen.world.step();
        let now = at(kitchen);
        let next = [0, 1].map(|i| (now[i] - before[i]) * 240.0);
        let change = (next[0] - velocity[0]).hypot(next[1] - velocity[1]) * 240.0;
        most = most.max(change);
        (before, velocity) = (now, next);
        if status != MotionStatus::Running {
            return (most, status);
        }
    }
    panic!("the drive does not end");
}

/// The base's acceleration (m/s²), and what rounding adds to a difference of differences.
const MOST: f64 = 1.0 + 0.03;

#[test]
fn the_base_keeps_its_acceleration_from_start_to_end() {
    let mut kitchen = Kitchen::parked(-0.15, 1.0, 180.0, 0.0);
    let mut drive = kitchen.drive(-2.6, 1.0, 0.0);
    let (most, end) = drive_watching(&mut kitchen, &mut drive, |_, _| {});
    assert_eq!(end, MotionStatus::Done(MotionOutcome::Arrived));
    assert!(most < MOST, "{most} m/s²");
}

#[test]
fn the_base_brakes_for_what_appears_in_its_way() {
    let mut kitchen = Kitchen::parked(0.0, -0.5, 90.0, 0.3);
    let mut drive = kitchen.drive(0.0, 2.0, 90.0);
    let (most, end) = drive_watching(&mut kitchen, &mut drive, |kitchen, step| {
        if step == 360 {
            let [x, y, _] = place(kitchen);
            let at = from_xyz_rpy([x, y + 0.65, 0.1], [0.0; 3]);
            kitchen
                .world
                .spawn("cube-1", "cube", &at, None, None)
                .unwrap();
        }
    });
    // It goes around it, or says what is there.
    assert!(!matches!(end, MotionStatus::Running));
    assert!(most < MOST, "{most} m/s²");
}

#[test]
fn the_base_brakes_when_it_loses_what_it_carries() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let palm = kitchen
        .world
        .models()
        .description
        .arm(Side::Right)
        .gripper
        .palm;
    let at = kitchen.world.link_pose(palm) * from_xyz_rpy([0.3, 0.0, 0.0], [0.0; 3]);
    kitchen
        .world
        .spawn("bottle-1", "bottle", &at, None, None)
        .unwrap();
    kitchen.world.attach("bottle-1", palm).unwrap();
    let mut drive = kitchen.drive(0.0, 1.5, 0.0);
    let (most, end) = drive_watching(&mut kitchen, &mut drive, |kitchen, step| {
        // It becomes too heavy.
        if step == 400 {
            let pose = kitchen.world.object_pose("bottle-1").unwrap();
            let heavy = Some(30.0);
            let spawned = kitchen
                .world
                .spawn("bottle-1", "bottle", &pose, None, heavy);
            spawned.unwrap();
            kitchen.world.attach("bottle-1", palm).unwrap();
        }
    });
    assert!(matches!(end, MotionStatus::Failed(_)), "{end:?}");
    assert!(most < MOST, "{most} m/s²");
}

#[test]
fn a_tight_place_that_a_finer_search_reaches_is_reached() {
    let mut kitchen = Kitchen::new();
    let park = kitchen.park(true, true);
    assert_eq!(kitchen.run_one(park), Ok(MotionOutcome::Arrived));
    let heading = 2.0 * f64::atan2(0.98981, 0.14240);
    let drive = kitchen.drive(-0.39496, 0.63927, heading.to_degrees());
    assert_eq!(kitchen.run_one(drive), Ok(MotionOutcome::Arrived));
}

/// Random places on the kitchen's floor: x and y (m), heading (degrees).
fn places(seed: u64) -> impl FnMut() -> [f64; 3] {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut between = move |least: f64, most: f64| {
        least + (most - least) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
    };
    move || {
        [
            between(-2.9, 0.9),
            between(-0.9, 2.9),
            between(-180.0, 180.0),
        ]
    }
}

/// What is held is torn out of a hand that stops at once.
#[test]
fn no_drive_among_furniture_stops_at_once() {
    let mut places = places(1);
    let (mut arrived, mut worst) = (0, Vec::new());
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.0);
    for number in 0..150 {
        let goal = places();
        let mut drive = kitchen.drive(goal[0], goal[1], goal[2]);
        let start = place(&kitchen);
        let (most, end) = drive_watching(&mut kitchen, &mut drive, |_, _| {});
        arrived += u32::from(end == MotionStatus::Done(MotionOutcome::Arrived));
        if most > MOST {
            worst.push((number, most, start, goal, end));
        }
    }
    assert!(arrived > 40, "{arrived}");
    assert!(worst.is_empty(), "{worst:?}");
}

/// What is carried gives way, and so is torn out of a hand, if it grazes an edge less deeply than a step is refused for.
#[test]
fn a_drive_that_begins_and_ends_clear_of_furniture_is_so_on_its_whole_way() {
    let mut places = places(2);
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.0);
    let (mut drives, mut tight) = (0, Vec::new());
    for _ in 0..100 {
        // Close to furniture, but clear of it.
        let goal = loop {
            let [x, y, heading] = places();
            let mut there = kitchen.world.robot_configuration().clone();
            there.base = from_xy_yaw(x, y, heading.to_radians());
            if (0.0055..0.035).contains(&kitchen.room(&there, 0.04)) {
                break [x, y, heading];
            }
        };
        let start = place(&kitchen);
        let mut drive = kitchen.drive(goal[0], goal[1], goal[2]);
        let mut least = f64::INFINITY;
        let (_, end) = drive_watching(&mut kitchen, &mut drive, |kitchen, step| {
            if step.is_multiple_of(4) {
                let robot = kitchen.world.robot_configuration();
                least = least.min(kitchen.room(robot, 0.04));
            }
        });
        if end == MotionStatus::Done(MotionOutcome::Arrived) {
            drives += 1;
            if least < 0.002 {
                tight.push((start, goal, least));
            }
        }
    }
    assert!(drives > 40, "{drives}");
    assert!(tight.is_empty(), "of {drives}: {tight:?}");
}
