//! A program that embeds planwright, through nothing but what the library offers: it runs a
//! plan, listens to what happens, and asks where things are in the end.

#[path = "embedding/outside.rs"]
mod outside;

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use planwright::{
    Datum, Evaluate, Event, Failure, FramedPose, InterruptHandle, Limit, Limits, Outcome, Picture,
    PlanEvent, PlanEventKind, Pose, RestoreError, Session, SessionOptions, Side, TaskId, TaskNode,
    TaskState, View,
};

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
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    assert_eq!((session.time(), session.objects().len()), (0.0, 0));
    let (outcome, printed) = run(&mut session, PICKING_UP);
    assert_eq!(outcome, Outcome::Finished, "{printed}");
    assert!(printed.contains("8.629: Lifting"), "{printed}");

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

fn session() -> Session {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.run("setup", "(in-package :pp-tut)").unwrap();
    session
}

#[test]
fn values_are_data_in_both_directions() {
    let mut session = session();
    let symbol = Datum::Symbol {
        package: Some("CRAM-PICK-PLACE-TUTORIAL".to_owned()),
        name: "BOTTLE-1".to_owned(),
    };
    let turned = planwright::pose::from_xy_yaw(1.0, 2.0, 0.5);
    for (text, datum) in [
        ("nil", Datum::Nil),
        ("t", Datum::True),
        ("-7", Datum::Integer(-7)),
        ("(expt 2 64)", Datum::Big("18446744073709551616".to_owned())),
        ("-2/6", Datum::Ratio("-1".to_owned(), "3".to_owned())),
        ("0.5", Datum::Single(0.5)),
        ("0.1d0", Datum::Float(0.1)),
        ("#\\x", Datum::Character('x')),
        ("\"a \\\"text\\\"\"", Datum::from("a \"text\"")),
        (":left", Datum::keyword("left")),
        ("'bottle-1", symbol),
        (
            "'(1 (nil))",
            Datum::list([1.into(), Datum::list([Datum::Nil])]),
        ),
        (
            "'(1 2 . 3)",
            Datum::Dotted(vec![1.into(), 2.into()], Box::new(3.into())),
        ),
        (
            "(vector 1 \"b\")",
            Datum::Vector(vec![1.into(), "b".into()]),
        ),
        (
            "(cl-transforms-stamped:pose->pose-stamped \"base_footprint\" 0.0
               (cl-transforms:make-pose (cl-transforms:make-3d-vector 1 2 0)
                                        (cl-transforms:euler->quaternion :az 0.5d0)))",
            FramedPose::new("base_footprint", turned).into(),
        ),
        (
            "(an object (type bottle) (name bottle-1))",
            Datum::Object("BOTTLE-1".to_owned()),
        ),
    ] {
        let data = [datum];
        assert_eq!(session.run("value", text).unwrap(), data, "{text}");
        assert_eq!(session.call("identity", &data).unwrap(), data, "{text}");
    }
    let values = session.run("value", "1 (values) (values 2 3)");
    assert_eq!(values.unwrap(), [Datum::from(2), Datum::from(3)]);
    let other = session.run("value", "(make-hash-table)").unwrap();
    assert!(matches!(&other[..], [Datum::Other(text)] if text.starts_with("#<HASH-TABLE")));
    let failure = session.call("identity", &other).unwrap_err();
    assert!(failure.to_string().contains("cannot be an argument"));
    let digits = session.call("identity", &[Datum::Big("0x7".to_owned())]);
    assert!(matches!(digits, Err(Failure::Invalid(_))));
}

#[test]
fn data_of_lists_without_end_have_one() {
    let mut session = session();
    let circle = session.run("value", "(let ((l (list 1 2))) (setf (cdr (last l)) l) l)");
    let circle = circle.unwrap();
    let items = circle[0].as_items().unwrap();
    assert_eq!(items.len(), 1_000_001);
    assert_eq!(items.last(), Some(&Datum::Other("…".to_owned())));
    let deep = session.run(
        "value",
        "(let ((l nil)) (dotimes (i 1000 l) (setf l (list l))))",
    );
    let mut level = &deep.unwrap()[0];
    let mut depth = 0;
    while let Some([inner]) = level.as_items() {
        level = inner;
        depth += 1;
    }
    assert_eq!((depth, level), (100, &Datum::Other("…".to_owned())));
}

#[test]
fn functions_are_called_and_variables_read_without_text() {
    let mut session = session();
    let sum = session.call("+", &[1.into(), Datum::Float(0.5)]).unwrap();
    assert_eq!(sum, [Datum::Float(1.5)]);
    // Arguments are not evaluated.
    let list = Datum::list([Datum::symbol("car"), 5.into()]);
    assert_eq!(
        session.call("cl:length", &[list]).unwrap(),
        [Datum::from(2)]
    );

    assert_eq!(session.get("*shift*"), None);
    session.set("*shift*", &Datum::from("a (b")).unwrap();
    assert_eq!(session.get("pp-tut::*shift*"), Some(Datum::from("a (b")));
    assert_eq!(session.get("*no-such-variable*"), None);
    let constant = session.set("cl:pi", &3.into()).unwrap_err();
    assert!(
        constant
            .unhandled()
            .is_some_and(|condition| condition.is_a("ERROR"))
    );

    for (name, report) in [
        (
            "no-such-function",
            "There is no symbol NO-SUCH-FUNCTION in package CRAM-PICK-PLACE-TUTORIAL.",
        ),
        ("no-such-package:f", "There is no package no-such-package."),
    ] {
        let failure = session.call(name, &[]).unwrap_err();
        assert!(matches!(&failure, Failure::Invalid(_)), "{failure:?}");
        assert_eq!(failure.to_string(), report);
    }
}

#[test]
fn failures_are_typed() {
    let mut session = session();
    let failure = session
        .run("mine", "(list 1)\n(list\n  (car 5))")
        .unwrap_err();
    assert_eq!(
        failure.to_string(),
        "The value\n  5\nis not of type\n  LIST"
    );
    let condition = failure.unhandled().unwrap();
    assert_eq!(condition.classes[0], "TYPE-ERROR");
    assert!(condition.is_a("ERROR") && condition.is_a("CONDITION") && !condition.is_a("WARNING"));
    assert_eq!(condition.slot("DATUM"), Some(&Datum::from(5)));
    let place = condition.abort.place.as_ref().map(ToString::to_string);
    assert_eq!(place.as_deref(), Some("mine:3:3"));

    let plan = "(with-simulated-robot
                  (perform (an action (type setting-gripper) (gripper left) (position 0.1)))
                  (perform (a motion (type moving-torso) (joint-angle 7.0))))";
    let failure = session.run("plan", plan).unwrap_err();
    let condition = failure.unhandled().unwrap();
    assert!(condition.is_a("PLAN-FAILURE"), "{condition:?}");
    assert_eq!(condition.abort.class, condition.classes[0]);

    assert_eq!(session.run("quit", "(quit 3)"), Err(Failure::Quit(3)));
    assert_eq!(session.run("on", "1").unwrap(), [Datum::from(1)]);
    let unread = session.run("text", "1 (list").unwrap_err();
    assert!(
        unread
            .unhandled()
            .is_some_and(|condition| condition.is_a("END-OF-FILE")),
        "{unread:?}"
    );
    let missing = session.run_file("/no/such/file.plan").unwrap_err();
    assert!(
        missing
            .to_string()
            .starts_with("cannot read /no/such/file.plan: "),
        "{missing}"
    );
}

#[test]
fn files_are_run() {
    let file = std::env::temp_dir().join(format!("planwright-face-{}.plan", std::process::id()));
    std::fs::write(&file, "(defun twice (x) (* 2 x))\n(twice 21)").unwrap();
    let mut session = session();
    let values = session.run_file(&file);
    std::fs::remove_file(&file).unwrap();
    assert_eq!(values.unwrap(), [Datum::from(42)]);
    assert_eq!(
        session.call("twice", &[4.into()]).unwrap(),
        [Datum::from(8)]
    );
}

/// The number of the named limit that ends an endless form, and how long that took.
fn ended(limits: Limits, form: &str) -> (Failure, Duration) {
    let mut session = session();
    let begin = Instant::now();
    let failure = session.within(limits).run("endless", form).unwrap_err();
    let taken = begin.elapsed();
    // The session goes on.
    assert_eq!(session.run("on", "(+ 1 2)").unwrap(), [Datum::from(3)]);
    (failure, taken)
}

#[test]
fn what_has_no_end_ends_at_its_limits() {
    let wall_clock = Limits {
        wall_clock: Some(Duration::from_millis(200)),
        grace: Duration::from_millis(100),
        ..Limits::NONE
    };
    let looks = Limits {
        looks: Some(2_000),
        ..Limits::NONE
    };
    let simulated_time = Limits {
        simulated_time: Some(5.0),
        ..Limits::NONE
    };
    for (limits, form, limit) in [
        (wall_clock, "(loop)", Limit::WallClock),
        (
            wall_clock,
            "(unwind-protect (loop) (loop))",
            Limit::WallClock,
        ),
        (
            wall_clock,
            "(unwind-protect (unwind-protect (unwind-protect (loop) (loop)) (loop)) (loop))",
            Limit::WallClock,
        ),
        (
            wall_clock,
            "(top-level (par (unwind-protect (loop (sleep 1)) (loop (sleep 1)))
                             (unwind-protect (loop) (loop))))",
            Limit::WallClock,
        ),
        (looks, "(loop)", Limit::Looks),
        (looks, "(unwind-protect (loop) (loop))", Limit::Looks),
        (simulated_time, "(loop (sleep 1))", Limit::SimulatedTime),
        (simulated_time, "(sleep 1000000)", Limit::SimulatedTime),
        (
            simulated_time,
            "(unwind-protect (sleep 6) (loop (sleep 1)))",
            Limit::SimulatedTime,
        ),
    ] {
        let (failure, taken) = ended(limits, form);
        assert_eq!(failure, Failure::LimitReached(limit), "{form}");
        assert!(taken < Duration::from_secs(20), "{form} took {taken:?}");
    }
}

#[test]
fn limits_end_motions_at_the_same_place_every_time() {
    let raise = "(with-simulated-robot
                   (perform (a motion (type moving-torso) (joint-angle 0.3))))";
    let run = |limits: Limits| {
        let mut session = session();
        let ended = session.within(limits).run("plan", raise);
        (ended, session.time(), session.world_hash())
    };
    let limits = Limits {
        steps: Some(120),
        ..Limits::NONE
    };
    let (ended, time, hash) = run(limits);
    assert_eq!(ended, Err(Failure::LimitReached(Limit::Steps)));
    // Half a second, and what braking takes.
    assert!((0.5..0.8).contains(&time), "{time}");
    assert_eq!(run(limits), (ended, time, hash));

    let limits = Limits {
        simulated_time: Some(0.5),
        ..Limits::NONE
    };
    let (ended, at, _) = run(limits);
    assert_eq!(ended, Err(Failure::LimitReached(Limit::SimulatedTime)));
    assert_eq!(at, time);
    let (ended, _, _) = run(Limits {
        simulated_time: Some(60.0),
        steps: Some(60 * 240),
        wall_clock: Some(Duration::from_secs(600)),
        looks: Some(1_000_000),
        ..Limits::NONE
    });
    assert!(ended.is_ok(), "{ended:?}");
}

#[test]
fn cleanup_forms_run_after_a_limit() {
    let mut session = session();
    let limits = Limits {
        simulated_time: Some(2.0),
        ..Limits::NONE
    };
    let plan = "(setf *state* :begun)
                (unwind-protect (sleep 10) (sleep 1) (setf *state* :cleaned-up))";
    session.set("*state*", &Datum::Nil).unwrap();
    let ended = session.within(limits).run("plan", plan);
    assert_eq!(ended, Err(Failure::LimitReached(Limit::SimulatedTime)));
    assert_eq!(session.get("*state*"), Some(Datum::keyword("cleaned-up")));
    assert_eq!(session.time(), 3.0);
}

#[test]
fn another_thread_interrupts() {
    let mut session = session();
    let handle = session.interrupter();
    assert!(!handle.interrupt());
    assert_eq!(session.run("on", "1").unwrap(), [Datum::from(1)]);
    for form in ["(loop)", "(unwind-protect (loop) (loop))"] {
        let handle = handle.clone();
        let limits = Limits {
            grace: Duration::from_millis(50),
            ..Limits::NONE
        };
        let other = std::thread::spawn(move || {
            while !handle.interrupt() {
                std::thread::yield_now();
            }
        });
        let ended = session.within(limits).run("endless", form);
        other.join().unwrap();
        assert_eq!(ended, Err(Failure::Interrupted), "{form}");
        assert_eq!(session.run("on", "1").unwrap(), [Datum::from(1)]);
    }
}

#[test]
fn observers_are_told_of_tasks_motions_and_hands() {
    let mut session = session();
    let events: Rc<RefCell<Vec<PlanEvent>>> = Rc::default();
    let seen = Rc::clone(&events);
    let observer = session.on_event(move |event| seen.borrow_mut().push(event.clone()));
    let log = session.log_tasks();
    session.run("plan", PICKING_UP).unwrap();
    session.remove_observer(observer);
    let told = events.borrow().len();
    session.run("on", "(format t \"unheard\")").unwrap();
    assert_eq!(events.borrow().len(), told);

    let events = events.borrow();
    let held = events.iter().filter_map(|event| match &event.kind {
        PlanEventKind::Held { object, side } => Some((object.as_str(), *side)),
        _ => None,
    });
    assert_eq!(held.collect::<Vec<_>>(), [("BOTTLE-1", Side::Right)]);
    let printed = events.iter().filter_map(|event| match &event.kind {
        PlanEventKind::Printed(text) => Some(text.as_str()),
        _ => None,
    });
    assert!(printed.collect::<String>().contains("8.629: Lifting"));

    let tree = log.tree();
    let all: Vec<&TaskNode> = tree.iter().flat_map(TaskNode::all).collect();
    let begun = events
        .iter()
        .filter(|event| matches!(event.kind, PlanEventKind::Began(_)));
    let ended = events
        .iter()
        .filter(|event| matches!(event.kind, PlanEventKind::Ended(_)));
    assert_eq!([begun.count(), ended.count()], [all.len(), all.len()]);
    let picking = all.iter().find(|node| node.name == "picking-up").unwrap();
    assert!(matches!(picking.id, TaskId::Action(_)));
    assert_eq!(
        (picking.state, &picking.failure),
        (TaskState::Succeeded, &None)
    );
    let about = picking.about.as_ref().unwrap();
    assert!(
        about.keys.contains(&("arm".to_owned(), "RIGHT".to_owned())),
        "{about:?}"
    );
    let inner = picking
        .all()
        .filter(|node| matches!(node.id, TaskId::Motion(_)));
    let names: Vec<&str> = inner.map(|node| node.name.as_str()).collect();
    assert!(
        names.contains(&"gripping") && names.contains(&"moving-tcp"),
        "{names:?}"
    );
    assert!(picking.began < picking.ended.unwrap());

    log.clear();
    let plan = "(with-simulated-robot
                  (perform (a motion (type moving-torso) (joint-angle 7.0))))";
    session.run("plan", plan).unwrap_err();
    let tree = log.tree();
    let failed = tree
        .iter()
        .flat_map(TaskNode::all)
        .filter(|node| node.failure.is_some());
    let failed: Vec<_> = failed
        .map(|node| (node.id, node.failure.clone().unwrap()))
        .collect();
    assert!(
        failed.iter().any(|(id, _)| matches!(id, TaskId::Motion(_))),
        "{failed:?}"
    );
    for (_, (class, report)) in failed {
        assert_eq!(class, "TORSO-GOAL-NOT-REACHED", "{report}");
        assert!(!report.is_empty());
    }
}

#[test]
fn worlds_are_edited_and_taken_back() {
    let mut session = session();
    let table = Pose::translation(-1.6, -0.9, 0.82);
    session.spawn("bottle", "bottle-1", table).unwrap();
    assert_eq!(session.objects(), ["BOTTLE-1"]);
    let before = session.world_hash();
    let snapshot = session.snapshot();

    let aside = Pose::translation(-1.4, -0.6, 0.82);
    session.move_object("bottle-1", aside).unwrap();
    let bottle = session.object_pose("BOTTLE-1").unwrap().translation;
    assert!((bottle.x - -1.4).hypot(bottle.y - -0.6) < 0.01, "{bottle}");
    session
        .move_robot(planwright::pose::from_xy_yaw(0.5, 0.0, 0.0))
        .unwrap();
    // In front of the robot, which has moved.
    let ahead = FramedPose::new("base_footprint", Pose::translation(1.0, 0.0, 0.0));
    assert_eq!(session.in_map(&ahead).unwrap().translation.x, 1.5);
    assert_eq!(session.in_map(&FramedPose::new("nowhere", table)), None);
    session.spawn("cup", "cup-1", ahead).unwrap();
    let cup = session.object_pose("CUP-1").unwrap().translation;
    assert!((cup.x - 1.5).abs() < 0.05, "{cup}");
    session.remove_object("bottle-1").unwrap();
    assert_eq!(session.objects(), ["CUP-1"]);

    session.restore(&snapshot).unwrap();
    assert_eq!(
        (session.objects(), session.world_hash()),
        (vec!["BOTTLE-1"], before)
    );
    // The plan finds the object by its symbol.
    let found = session
        .run("find", "(btr-utils:object-exists 'bottle-1)")
        .unwrap();
    assert_eq!(found, [Datum::True]);

    let mut other = self::session();
    assert_eq!(other.restore(&snapshot), Err(RestoreError::OtherSession));
    let failure = session.spawn("botle", "bottle-2", table).unwrap_err();
    assert!(
        failure.to_string().contains("did you mean :BOTTLE?"),
        "{failure}"
    );
}

#[test]
fn pictures_are_data() {
    let folder = std::env::current_dir().unwrap();
    let files = || std::fs::read_dir(&folder).unwrap().count();
    let before = files();
    let session = session();
    let view = View::Free {
        from: [-1.0, -2.0, 2.0].into(),
        at: [0.0, 0.0, 0.8].into(),
        vertical_fov: 0.7,
    };
    let picture: Picture = session.picture(&view, [64, 48]).unwrap();
    assert_eq!((picture.width(), picture.height()), (64, 48));
    assert!(picture.to_png().unwrap().starts_with(b"\x89PNG"));
    assert!(session.picture(&View::Kitchen, [0, 48]).is_err());
    assert!(session.picture(&View::Kitchen, [64, 1 << 40]).is_err());
    assert_eq!(files(), before);
}

#[test]
fn recordings_are_files_that_the_program_names() {
    let file = std::env::temp_dir().join(format!("planwright-face-{}.mcap", std::process::id()));
    let mut session = session();
    session.begin_recording(&file).unwrap();
    session
        .run("wait", "(with-simulated-robot (sleep 0.1))")
        .unwrap();
    session.end_recording().unwrap();
    let recording = std::fs::read(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    assert!(recording.starts_with(b"\x89MCAP0\r\n"));
}

#[test]
fn all_but_the_session_goes_to_other_threads() {
    fn shared<T: Send + Sync + 'static>() {}
    shared::<SessionOptions>();
    shared::<InterruptHandle>();
    shared::<Datum>();
    shared::<Failure>();
    shared::<Limits>();
    shared::<PlanEvent>();
    shared::<TaskNode>();
    shared::<Picture>();
}

#[test]
fn a_session_may_be_a_variable_of_its_thread() {
    thread_local! {
        static SESSION: RefCell<Option<Session>> = const { RefCell::new(None) };
    }
    let thread = std::thread::spawn(|| {
        SESSION.set(Some(session()));
        SESSION.with_borrow_mut(|session| {
            // With values that hold each other, and work that calls functions.
            let text = "(defvar *circle* (let ((l (list 1 2))) (setf (cdr (last l)) l)))
                        (mapcar #'1+ '(1 2))";
            session.as_mut().unwrap().run("text", text).unwrap()
        })
    });
    let values = thread.join().unwrap();
    assert_eq!(values, [Datum::list([2.into(), 3.into()])]);
}
