//! Trajectories that somebody else has planned: followed in time, or refused with what is wrong.

use super::fixture::Kitchen;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::wrong_trajectory::WrongTrajectory;
use crate::motion::jobs::follow_trajectory::{FollowArm, FollowTorso};
use crate::motion::trajectories::timed_path::TimedPoint;
use crate::motion::{Motion, MotionOutcome, MotionStatus};
use crate::robot::Side;

fn point(time: f64, positions: &[f64]) -> TimedPoint {
    TimedPoint {
        time,
        positions: positions.to_vec(),
        velocities: None,
    }
}

fn arm(kitchen: &Kitchen) -> Vec<f64> {
    let arm = kitchen.world.models().description.arm(Side::Right);
    let joints = &kitchen.world.robot_configuration().joints;
    arm.joints()
        .iter()
        .map(|joint| joints.get(*joint))
        .collect()
}

/// Where the arm is with one joint moved by an angle (rad).
fn moved(from: &[f64], joint: usize, by: f64) -> Vec<f64> {
    let mut to = from.to_vec();
    to[joint] += by;
    to
}

fn wrong(points: Vec<TimedPoint>) -> WrongTrajectory {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let before = arm(&kitchen);
    let failure = kitchen.run_one(FollowArm::new(&[Side::Right], points));
    assert_eq!(arm(&kitchen), before, "it has moved");
    match failure {
        Err(failure @ MotionFailure::WrongTrajectory(_)) => {
            assert_eq!(failure.class_name(), "MANIPULATION-POSE-UNREACHABLE");
            let MotionFailure::WrongTrajectory(wrong) = failure else {
                unreachable!()
            };
            *wrong
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_arm_is_where_the_trajectory_says_when_it_says_so() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let start = arm(&kitchen);
    let middle = moved(&start, 3, 0.3);
    let end = moved(&middle, 5, -0.4);
    let points = vec![point(1.0, &middle), point(2.5, &end)];
    let mut motion = FollowArm::new(&[Side::Right], points);
    let mut seconds = 0.0;
    loop {
        match motion.tick(&mut kitchen.world) {
            MotionStatus::Running => {}
            MotionStatus::Done(outcome) => {
                assert_eq!(outcome, MotionOutcome::Arrived);
                break;
            }
            MotionStatus::Failed(failure) => panic!("{failure}"),
        }
        kitchen.world.step();
        seconds += 1.0 / 240.0;
        let now = arm(&kitchen);
        let part = (seconds / 1.0_f64).min(1.0);
        let lag = (now[3] - (start[3] + 0.3 * part)).abs();
        assert!(lag < 0.3 * 0.08, "{seconds}: {lag}");
        assert!(seconds < 3.0);
    }
    assert!((2.5..2.65).contains(&seconds), "{seconds}");
    assert_eq!(arm(&kitchen), end);
}

#[test]
fn the_torso_follows_one_too() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.1);
    let points = vec![point(4.0, &[0.14])];
    let outcome = kitchen.run_one(FollowTorso::new(points));
    assert_eq!(outcome, Ok(MotionOutcome::Arrived));
    let torso = &kitchen.world.models().description.torso;
    let height = torso.height(&kitchen.world.robot_configuration().joints);
    assert!((height - 0.14).abs() < 1e-9, "{height}");
}

#[test]
fn a_trajectory_that_no_robot_can_follow_is_refused_before_it_moves() {
    let here = arm(&Kitchen::parked(0.0, 0.0, 0.0, 0.3));
    assert_eq!(wrong(vec![]), WrongTrajectory::Empty);
    for (points, said) in [
        (
            vec![point(1.0, &here[..5])],
            "point 0 of the trajectory has 5 numbers: 7 were expected",
        ),
        (
            vec![point(1.0, &moved(&here, 2, f64::NAN))],
            "has a number that is not finite",
        ),
        (vec![point(f64::NAN, &here)], "the time of point 0"),
        (vec![point(-1.0, &here)], "the time of point 0"),
        (
            vec![point(1.0, &here), point(1.0, &here)],
            "the time of point 1",
        ),
        (vec![point(1e9, &here)], "takes longer than 600 s"),
        (
            vec![point(0.0, &moved(&here, 0, 0.5))],
            "plan it from where the robot is",
        ),
        (
            vec![point(9.0, &moved(&here, 0, 40.0))],
            "outside of its limits",
        ),
        (
            vec![point(0.1, &moved(&here, 3, 0.6))],
            "would have to move at",
        ),
    ] {
        let text = wrong(points).to_string();
        assert!(text.contains(said), "{said}: {text}");
    }
    let moving = TimedPoint {
        velocities: Some(vec![0.1; 7]),
        ..point(2.0, &moved(&here, 3, 0.1))
    };
    let text = wrong(vec![moving]).to_string();
    assert!(text.contains("ends with a velocity"), "{text}");
}

#[test]
fn an_arm_stops_where_something_is_in_the_way_and_when_it_is_cancelled() {
    // At the end the left arm would be in the robot's own body.
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.1);
    let start = arm(&kitchen);
    let inside = [-0.7, 1.2, 3.5, -2.2, 0.0, -0.2, 0.0];
    let failure = kitchen.run_one(FollowArm::new(&[Side::Left], vec![point(12.0, &inside)]));
    let failure = failure.unwrap_err();
    assert!(
        matches!(failure, MotionFailure::ArmBlocked { .. }),
        "{failure}"
    );
    assert_eq!(failure.class_name(), "MANIPULATION-GOAL-NOT-REACHED");

    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let goal = moved(&start, 5, -0.8);
    let mut motion = FollowArm::new(&[Side::Right], vec![point(2.0, &goal)]);
    for _ in 0..240 {
        assert_eq!(motion.tick(&mut kitchen.world), MotionStatus::Running);
        kitchen.world.step();
    }
    motion.cancel();
    let mut steps = 0;
    while motion.is_moving() {
        motion.brake(&mut kitchen.world);
        kitchen.world.step();
        steps += 1;
        assert!(steps < 120);
    }
    let rest = arm(&kitchen);
    kitchen.world.step();
    assert_eq!(arm(&kitchen), rest);
    assert!(rest[5] > goal[5] + 0.2, "{rest:?}");
}
