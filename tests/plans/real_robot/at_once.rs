//! Motions that a plan begins at once.

use robotics::motion::RobotTrouble;
use robotics::robot::{RobotPart, Side};
use session::outside::RobotEnd;

use super::{Conduct, DRIVE, Driver, LEFT_ARM, LIFT, LOOK, OPEN, REACH};

const PARK: &str = "(perform (an action (type parking-arms)))";

#[test]
fn parts_that_differ_move_at_once() {
    let mut driver = Driver::new();
    driver.done(&format!("(cpl:par {DRIVE} {LIFT} {LOOK})"));
    let robot = driver.robot.get();
    assert_eq!(robot.at_once, 3, "{:?}", robot.told);
    let base = driver.believed_base().translation;
    assert!(
        (base.x + 0.3).abs() < 1e-6 && (base.y - 0.4).abs() < 1e-6,
        "{base}"
    );
    assert!((driver.believed("torso_lift_joint") - 0.1).abs() < 1e-6);
    driver.assert_rest();
}

#[test]
fn parts_of_the_upper_body_move_one_after_the_other() {
    let mut driver = Driver::new();
    driver.done(&format!("(cpl:par {LIFT} {REACH} {OPEN})"));
    let robot = driver.robot.get();
    assert_eq!(robot.at_once, 1);
    assert_eq!(
        robot.told,
        ["torso goes", "left-arm goes", "left-gripper goes"]
    );
}

#[test]
fn a_motion_that_moves_nothing_keeps_nobody_waiting() {
    let mut driver = Driver::new();
    driver.done(&format!("{OPEN} {OPEN} (cpl:par {OPEN} {DRIVE} {REACH})"));
    let told = driver.robot.get().told.join(", ");
    assert_eq!(told, "left-gripper goes, base goes, left-arm goes");
}

#[test]
fn an_arm_moves_while_the_base_drives() {
    let mut driver = Driver::new();
    driver.done(&format!("(cpl:par {DRIVE} {REACH})"));
    assert_eq!(driver.robot.get().at_once, 2);
    assert!((driver.believed("l_shoulder_pan_joint") - 1.9).abs() < 1e-3);
    let base = driver.believed_base().translation;
    assert!((base.x + 0.3).abs() < 1e-6, "{base}");
}

#[test]
fn both_arms_get_their_goals_together() {
    let mut driver = Driver::new();
    driver.done(REACH);
    driver.done(PARK);
    let told = driver.robot.get().told.join(", ");
    assert!(told.contains("left-arm goes"), "{told}");
}

#[test]
fn what_fails_alone_stops_alone_and_is_not_taken_for_a_robot_that_does_not_stand() {
    let mut driver = Driver::new();
    let trouble = RobotTrouble::Aborted {
        name: "/left_gripper_controller/gripper_cmd".to_owned(),
        text: "jammed".to_owned(),
    };
    let end = RobotEnd {
        trouble: Some(trouble),
        ..RobotEnd::default()
    };
    driver.set(RobotPart::Gripper(Side::Left), Conduct::Ends(end));
    driver.done(&format!(
        "(cpl:par {DRIVE}
           (cpl:with-failure-handling
               ((cram-common-failures:gripper-goal-not-reached () (return nil)))
             {OPEN}))"
    ));
    let base = driver.believed_base().translation;
    assert!((base.x + 0.3).abs() < 1e-6, "{base}");
    driver.assert_rest();
}

#[test]
fn the_end_of_a_plan_stops_all_parts() {
    let mut driver = Driver::new();
    driver.set(LEFT_ARM, Conduct::NeverEnds);
    driver.set(RobotPart::Base, Conduct::NeverEnds);
    driver.done(&format!(
        "(cpl:pursue (cpl:par {DRIVE} {REACH}) (cpl:sleep 0.6))"
    ));
    let told = driver.robot.get().told.clone();
    assert!(told.contains(&"base stops".to_owned()), "{told:?}");
    assert!(told.contains(&"left-arm stops".to_owned()), "{told:?}");
    driver.assert_rest();
}

#[test]
fn without_prospection_the_robot_finds_its_own_way() {
    let mut driver = Driver::new();
    // In the island.
    let occupied = DRIVE.replace("-0.3 0.4", "-1.3 2.0");
    driver.fails("navigation-pose-unreachable", &["overlap"], &occupied);
    assert!(driver.robot.get().told.is_empty());
    driver.cook.done(&format!(
        "(let ((pr2-pms:*prospection* nil)) (with-real-robot {occupied} {LOOK}))"
    ));
    assert_eq!(driver.robot.get().told, ["base goes", "neck goes"]);
    let base = driver.believed_base().translation;
    assert!((base.x + 1.3).abs() < 1e-6, "{base}");
    // Only for as long as that was wanted.
    driver.fails(
        "navigation-pose-unreachable",
        &["overlap"],
        &occupied.replace("2.0", "1.9"),
    );
}
