//! Servers that report what is not so, or nothing.

use robotics::motion::RobotTrouble;
use robotics::robot::RobotPart;
use session::dialogue::Repeat;
use session::outside::RobotEnd;

use super::{Conduct, DRIVE, Driver, LEFT_ARM, LEFT_GRIPPER, LIFT, LOOK, OPEN, REACH};

/// The parts, the motion of each, what its action is called, and what its failures begin with.
const PARTS: [(RobotPart, &str, &str, &str); 5] = [
    (RobotPart::Base, DRIVE, "/navigate_to_pose", "navigation"),
    (
        RobotPart::Torso,
        LIFT,
        "/torso_controller/follow_joint_trajectory",
        "torso",
    ),
    (
        RobotPart::Neck,
        LOOK,
        "/head_controller/point_head_action",
        "ptu",
    ),
    (
        LEFT_ARM,
        REACH,
        "/left_arm_controller/follow_joint_trajectory",
        "manipulation",
    ),
    (
        LEFT_GRIPPER,
        OPEN,
        "/left_gripper_controller/gripper_cmd",
        "gripper",
    ),
];

fn ends(trouble: RobotTrouble) -> Conduct {
    Conduct::Ends(RobotEnd {
        trouble: Some(trouble),
        ..RobotEnd::default()
    })
}

/// What a server reports that has not done anything, with the class of failure, and words that name it.
fn reports(name: &str) -> Vec<(RobotTrouble, &'static str, &'static str)> {
    let name = || name.to_owned();
    vec![
        (
            RobotTrouble::Aborted {
                name: name(),
                text: "the way is blocked (error 7)".to_owned(),
            },
            "goal-not-reached",
            "has given up: the way is blocked (error 7)",
        ),
        (
            RobotTrouble::CanceledElsewhere { name: name() },
            "goal-not-reached",
            "was cancelled by someone else",
        ),
        (
            RobotTrouble::NotBegun {
                name: name(),
                limit: 60.0,
                has_ended: true,
            },
            "goal-not-reached",
            "not begun it within 60 s",
        ),
        (
            RobotTrouble::NotEnding { name: name() },
            "goal-not-reached",
            "NOTHING SAYS THAT IT HAS ENDED",
        ),
        (
            RobotTrouble::Unserved {
                name: name(),
                waited: 10.0,
            },
            "low-level-failure",
            "(waited 10 s)",
        ),
        (
            RobotTrouble::NoAnswer {
                name: name(),
                waited: 5.0,
            },
            "low-level-failure",
            "has not answered (waited 5 s)",
        ),
        (
            RobotTrouble::Gone { name: name() },
            "low-level-failure",
            "is gone",
        ),
        (
            RobotTrouble::Forgotten { name: name() },
            "low-level-failure",
            "does not know the goal any more",
        ),
    ]
}

#[test]
fn what_servers_report_becomes_the_failure_of_the_part() {
    let mut driver = Driver::new();
    for (part, motion, name, class) in PARTS {
        for (trouble, kind, words) in reports(name) {
            // What belongs to arms has the class of arms.
            driver.set(part, ends(trouble));
            driver.fails(&format!("{class}-{kind}"), &[name, words], motion);
            driver.assert_rest();
        }
        driver.set(part, Conduct::Obeys);
        driver.done(motion);
    }
}

#[test]
fn a_goal_that_is_rejected_cannot_be_reached() {
    let mut driver = Driver::new();
    let classes = [
        "navigation-pose-unreachable",
        "torso-goal-unreachable",
        "ptu-goal-unreachable",
        "manipulation-pose-unreachable",
        "gripper-low-level-failure",
    ];
    for ((part, motion, name, _), class) in PARTS.into_iter().zip(classes) {
        let trouble = RobotTrouble::Rejected {
            name: name.to_owned(),
        };
        driver.set(part, ends(trouble));
        driver.fails(class, &[name, "has rejected the goal"], motion);
        driver.assert_rest();
    }
}

#[test]
fn success_without_a_motion_is_none() {
    let mut driver = Driver::new();
    for (part, motion, name, class) in PARTS {
        // Of the head there is no more than the server's word.
        if part == RobotPart::Neck {
            continue;
        }
        driver.set(part, Conduct::Ends(RobotEnd::default()));
        let class = format!("{class}-goal-not-reached");
        driver.fails(&class, &[name, "reported success"], motion);
        driver.assert_rest();
    }
}

#[test]
fn success_beside_the_goal_is_none() {
    let mut driver = Driver::new();
    let beside = [
        (0, 0.1, "reported success 0.10 m from the goal"),
        (
            1,
            0.01,
            "reported success 0.010 m from the goal of torso_lift_joint",
        ),
        (
            3,
            0.3,
            "reported success 0.300 rad from the goal of l_shoulder_pan_joint",
        ),
        (4, 0.004, "m from the gap of"),
    ];
    for (which, way, words) in beside {
        let (part, motion, name, class) = PARTS[which];
        driver.set(part, Conduct::Beside(way));
        let class = format!("{class}-goal-not-reached");
        driver.fails(&class, &[name, words], motion);
        driver.assert_rest();
    }
    // What is believed is where the robot is.
    let base = driver.believed_base().translation;
    let there = driver.robot.get().base.translation;
    assert!((base.x - there.x).abs() < 1e-4 && (base.y - there.y).abs() < 1e-4);
}

#[test]
fn a_little_beside_the_goal_is_there() {
    let mut driver = Driver::new();
    for (which, way) in [(0, 0.04), (1, 0.004), (3, 0.16), (4, 0.0008)] {
        let (part, motion, _, _) = PARTS[which];
        driver.set(part, Conduct::Beside(way));
        driver.done(motion);
    }
}

#[test]
fn without_a_result_in_time_the_goal_is_cancelled() {
    let mut driver = Driver::new();
    for (part, motion, name, class) in PARTS {
        driver.set(part, Conduct::NeverEnds);
        let class = format!("{class}-goal-not-reached");
        driver.fails(
            &class,
            &[name, "no result", "actionlib-action-timed-out"],
            motion,
        );
        driver.assert_rest();
    }
}

#[test]
fn a_link_that_never_tells_of_an_end_hangs_nothing() {
    let mut driver = Driver::new();
    driver.set(RobotPart::Base, Conduct::Mute);
    driver.fails(
        "navigation-goal-not-reached",
        &["/navigate_to_pose", "NOTHING SAYS THAT IT HAS ENDED"],
        DRIVE,
    );
    let robot = driver.robot.get();
    assert_eq!(robot.told, ["base goes", "base stops"]);
    assert!(
        robot.shouts[0].contains("DOES NOT STAND STILL"),
        "{:?}",
        robot.shouts
    );
}

#[test]
fn a_robot_that_does_not_stop_is_shouted_about_and_gets_no_new_goal() {
    let mut driver = Driver::new();
    driver.set(RobotPart::Base, Conduct::RunsAway);
    let plan = format!("(cpl:pursue {DRIVE} (cpl:sleep 0.5))");
    driver.done(&plan);
    let robot = driver.robot.get();
    assert_eq!(robot.told, ["base goes", "base stops"]);
    assert!(
        robot.shouts[0].contains("Use the emergency stop"),
        "{:?}",
        robot.shouts
    );
}

#[test]
fn what_evaporates_is_cancelled_and_stands_before_the_plan_goes_on() {
    let mut driver = Driver::new();
    driver.done(&format!("(cpl:pursue {DRIVE} (cpl:sleep 0.5)) {LIFT}"));
    assert_eq!(
        driver.robot.get().told,
        ["base goes", "base stops", "torso goes"]
    );
    driver.assert_rest();
    let there = driver.robot.get().base.translation;
    assert!((driver.believed_base().translation.vector - there.vector).norm() < 1e-3);
    assert!(there.x > -0.29, "it has arrived: {there}");
}

#[test]
fn ctrl_c_cancels_the_goals_and_waits_for_the_standstill() {
    let mut driver = Driver::new();
    driver.cook.session.interrupt_next_at(100);
    let (report, _) = driver
        .cook
        .say(&format!("(with-real-robot {DRIVE})"))
        .unwrap_err();
    assert_eq!(report, "Interrupted.");
    assert_eq!(driver.robot.get().told, ["base goes", "base stops"]);
    driver.assert_rest();
}

#[test]
fn an_arm_that_stops_elsewhere_is_not_there() {
    let mut driver = Driver::new();
    driver.set(LEFT_ARM, Conduct::Beside(-0.5));
    driver.fails(
        "manipulation-goal-not-reached",
        &["reported success 0.500 rad from the goal of l_shoulder_pan_joint"],
        REACH,
    );
    // The next motion begins where the arm is.
    let there = driver.robot.get().joints["l_shoulder_pan_joint"];
    assert!((driver.believed("l_shoulder_pan_joint") - there).abs() < 1e-3);
    driver.set(LEFT_ARM, Conduct::Obeys);
    driver.done(REACH);
}
