//! A program that embeds planwright, through nothing but what the library offers: it runs a
//! plan, listens to what happens, and asks where things are in the end.

#[cfg(target_os = "linux")]
#[path = "embedding/memory.rs"]
mod memory;

use std::sync::{Mutex, MutexGuard, PoisonError};

use planwright::{Evaluate, Event, Outcome, Session, SessionOptions, Side};

/// One test at a time: some measure the memory of the process.
fn alone() -> MutexGuard<'static, ()> {
    static ALONE: Mutex<()> = Mutex::new(());
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

const PICKING_UP: &str = include_str!("../plans/tutorial/picking-up.plan");

/// Evaluates a text; how it ended, and what it printed.
fn run(session: &mut Session, text: &str) -> (Outcome, String) {
    let mut printed = String::new();
    let outcome = session.evaluate("embedding", text, &mut |event| match event {
        Event::Output(text) => printed.push_str(&text),
        Event::Aborted(abort) => printed.push_str(&abort.report),
        _ => {}
    });
    (outcome, printed)
}

#[test]
fn a_plan_picks_up_a_bottle_and_the_world_tells_where_it_is() {
    let _alone = alone();
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    assert_eq!((session.time(), session.objects().len()), (0.0, 0));
    let (outcome, printed) = run(&mut session, PICKING_UP);
    assert_eq!(outcome, Outcome::Finished, "{printed}");
    assert!(printed.contains("8.679: Lifting"), "{printed}");

    assert!(session.time() > 5.0);
    assert_eq!(session.objects(), ["BOTTLE-1"]);
    let (left, right) = (Side::Left, Side::Right);
    assert_eq!(session.held_objects(right), ["BOTTLE-1"]);
    assert_eq!(session.held_objects(left), [] as [&str; 0]);
    // The robot stands before the table and holds the bottle in its right hand.
    let robot = session.robot_pose().translation;
    assert!((robot.x - -1.447).hypot(robot.y - -0.15) < 0.001, "{robot}");
    let bottle = session.object_pose("BOTTLE-1").unwrap();
    let hand = session.link_pose("r_gripper_tool_frame").unwrap();
    let apart = (bottle.translation.vector - hand.translation.vector).norm();
    assert!(apart < 0.1, "{apart}");
    assert!((session.joint_position("torso_lift_joint").unwrap() - 0.3).abs() < 0.001);
    assert_eq!(session.kitchen_joint_position("no_such_joint"), None);
    assert_eq!(session.object_pose("BOTTLE-2"), None);
}

#[test]
fn a_condition_that_nobody_handled_tells_where_and_why() {
    let _alone = alone();
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut aborts = Vec::new();
    let outcome = session.evaluate("embedding", "(+ 1\n   (car 5))", &mut |event| {
        if let Event::Aborted(abort) = event {
            aborts.push(*abort);
        }
    });
    assert_eq!((outcome, aborts.len()), (Outcome::Aborted, 1));
    assert_eq!(aborts[0].report, "The value\n  5\nis not of type\n  LIST");
    let place = aborts[0].place.as_ref().map(ToString::to_string);
    assert_eq!(place.as_deref(), Some("embedding:2:4"));
}

#[test]
fn the_same_texts_leave_the_same_world() {
    let _alone = alone();
    let hash = |seed: u64| {
        let options = SessionOptions {
            seed,
            ..SessionOptions::default()
        };
        let mut session = Session::new(&options).unwrap();
        let text = "(in-package :pp-tut)
                    (spawn-object '((-1.6 -0.9 0.9) (0 0 0 1)))
                    (with-simulated-robot (park-arms))";
        let (outcome, printed) = run(&mut session, text);
        assert_eq!(outcome, Outcome::Finished, "{printed}");
        session.world_hash()
    };
    assert_eq!(hash(1), hash(1));
}
