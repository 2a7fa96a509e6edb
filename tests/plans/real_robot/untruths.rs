//! A robot that tells of itself what cannot be, or nothing.

use super::{DRIVE, Driver, LIFT, REACH, Untruth};

const JOINT: &str = "torso_lift_joint";

fn untruths() -> Vec<(Untruth, &'static str)> {
    let joint = || JOINT.to_owned();
    vec![
        (Untruth::Stale, "no joint states for 0.7 s"),
        (
            Untruth::Lacks(joint()),
            "the joint states lack torso_lift_joint",
        ),
        (
            Untruth::NoNumber(joint()),
            "no finite position of torso_lift_joint",
        ),
        (Untruth::NoPlace, "the place of the base is no number"),
        (Untruth::TooFew, "positions for"),
    ]
}

#[test]
fn nothing_is_sent_to_a_robot_of_which_it_is_not_known_how_it_is() {
    let mut driver = Driver::new();
    for (untruth, words) in untruths() {
        for (motion, class) in [
            (DRIVE, "navigation-low-level-failure"),
            (LIFT, "torso-low-level-failure"),
            (REACH, "manipulation-low-level-failure"),
        ] {
            driver.lies_after(0.0, untruth.clone());
            driver.fails(class, &[words], motion);
        }
    }
    assert!(
        driver.robot.get().told.is_empty(),
        "{:?}",
        driver.robot.get().told
    );
    driver.robot.change().untruth = None;
    driver.done(LIFT);
}

#[test]
fn a_robot_that_falls_silent_on_the_way_is_stopped() {
    for (untruth, words) in untruths() {
        let mut driver = Driver::new();
        driver.lies_after(0.3, untruth);
        driver.fails("navigation-low-level-failure", &[words], DRIVE);
        assert_eq!(driver.robot.get().told, ["base goes", "base stops"]);
        assert!(!driver.robot.get().moves());
        // It is heard again, and goes on from where it is.
        driver.robot.change().untruth = None;
        driver.done(DRIVE);
    }
}

#[test]
fn a_robot_that_moves_by_itself_gets_no_goal() {
    let mut driver = Driver::new();
    driver.robot.change().drifts = true;
    driver.fails(
        "torso-low-level-failure",
        &["the robot moves by itself"],
        LIFT,
    );
    assert!(driver.robot.get().told.is_empty());
}
