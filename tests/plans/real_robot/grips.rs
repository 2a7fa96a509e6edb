//! Hands that close on something, or not.

use robotics::motion::RobotTrouble;
use robotics::robot::{RobotPart, Side};
use session::outside::{FingersReport, RobotEnd};

use super::{Conduct, Driver};

const HAND: RobotPart = RobotPart::Gripper(Side::Right);

/// How far (m) apart the fingers are that hold the bottle.
const BOTTLE: f64 = 0.071;

/// A robot at the table, with a bottle that it has detected as *BOTTLE*.
fn at_bottle() -> Driver {
    let mut driver = Driver::new();
    driver.cook.done(
        "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))
         (with-simulated-robot (get-ready-at *place-at-table*))
         (defparameter *bottle* (with-simulated-robot (find-object :bottle)))",
    );
    driver.follow_simulation();
    driver
}

/// What is said while the bottle is picked up with the right hand, whatever comes of it.
fn pick(driver: &mut Driver) -> String {
    let said = driver.cook.done(
        "(handler-case (with-real-robot (pick-up-object *bottle* :right))
           (cram-common-failures:low-level-failure (failure) (format t \"~&LOW ~a\" failure))
           (cram-common-failures:high-level-failure (failure) (format t \"~&HIGH ~a\" failure)))",
    );
    driver.assert_rest();
    said
}

#[test]
fn fingers_that_something_stops_hold_it() {
    for gap in [BOTTLE - 0.01, BOTTLE, BOTTLE + 0.01] {
        let mut driver = at_bottle();
        driver.robot.change().between = gap;
        pick(&mut driver);
        assert_eq!(driver.cook.in_right_hand(), "(BOTTLE-1)");
        assert!(driver.cook.pose("BOTTLE-1").translation.z > 0.9);
    }
}

#[test]
fn a_server_that_gives_up_since_something_stops_the_fingers_has_gripped_it() {
    let mut driver = at_bottle();
    driver.robot.change().between = BOTTLE;
    let end = RobotEnd {
        trouble: Some(RobotTrouble::Aborted {
            name: "/right_gripper_controller/gripper_cmd".to_owned(),
            text: "stalled".to_owned(),
        }),
        fingers: Some(FingersReport {
            gap: BOTTLE,
            is_stalled: true,
        }),
        ..RobotEnd::default()
    };
    driver.set(HAND, Conduct::GivesUp(end));
    pick(&mut driver);
    assert_eq!(driver.cook.in_right_hand(), "(BOTTLE-1)");
}

/// Each of these is told, and the hand is not believed to hold anything.
fn assert_missed(between: f64, reported: Option<FingersReport>, words: &str) {
    let mut driver = at_bottle();
    driver.robot.change().between = between;
    if let Some(reported) = reported {
        driver.set(HAND, Conduct::Reports(reported));
    }
    let said = pick(&mut driver);
    assert!(said.contains(words), "{words:?} is not in {said}");
    assert_eq!(driver.cook.in_right_hand(), "NIL", "{said}");
}

#[test]
fn fingers_that_close_on_nothing_hold_nothing_whatever_they_report() {
    let words = "nothing is between them";
    assert_missed(0.0, None, words);
    let report = |gap, is_stalled| Some(FingersReport { gap, is_stalled });
    assert_missed(0.0, report(BOTTLE, true), words);
    assert_missed(BOTTLE, report(0.0, false), words);
}

#[test]
fn fingers_that_nothing_has_stopped_hold_nothing() {
    let report = FingersReport {
        gap: BOTTLE,
        is_stalled: false,
    };
    assert_missed(
        BOTTLE,
        Some(report),
        "without having been stopped by anything",
    );
}

/// Also when it is tried again, with fingers that are now where the bottle is believed to be.
#[test]
fn fingers_that_meet_something_of_another_size_do_not_hold_what_was_meant() {
    assert_missed(
        0.03,
        None,
        "with fingers 0.030 m apart, which were to meet what they grip at 0.071 m",
    );
}
