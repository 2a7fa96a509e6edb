//! A robot that does what it is told to do.

use super::{DRIVE, Driver, LIFT, LOOK, OPEN, REACH};

#[test]
fn each_part_reaches_its_goal_and_belief_follows() {
    let mut driver = Driver::new();
    driver.done(&[LIFT, LOOK, DRIVE, OPEN].join("\n"));
    let base = driver.believed_base().translation;
    assert!(
        (base.x + 0.3).abs() < 1e-6 && (base.y - 0.4).abs() < 1e-6,
        "{base}"
    );
    assert!((driver.believed("torso_lift_joint") - 0.1).abs() < 1e-6);
    let told = driver.robot.get().told.join(", ");
    assert_eq!(told, "torso goes, neck goes, base goes, left-gripper goes");
    driver.assert_rest();
}

#[test]
fn an_arm_is_where_its_trajectory_ends() {
    let mut driver = Driver::new();
    driver.done(REACH);
    assert!((driver.believed("l_shoulder_pan_joint") - 1.9).abs() < 1e-4);
    driver.assert_rest();
}

#[test]
fn a_robot_that_was_moved_by_others_is_believed_before_anything_is_tried() {
    let mut driver = Driver::new();
    driver.robot.change().base = spatial::Pose::translation(-0.25, 0.35, 0.0);
    driver.done(DRIVE);
    let base = driver.robot.get().base.translation;
    assert!(
        (base.x + 0.3).abs() < 1e-6 && (base.y - 0.4).abs() < 1e-6,
        "{base}"
    );
}

#[test]
fn what_fails_when_it_is_tried_is_never_sent() {
    let mut driver = Driver::new();
    driver.fails(
        "navigation-pose-unreachable",
        &["overlap"],
        "(let ((?pose (make-pose \"map\" '((-1.3 2.0 0) (0 0 0 1)))))
           (perform (a motion (type going) (target (a location (pose ?pose))))))",
    );
    assert!(driver.robot.get().told.is_empty());
}
