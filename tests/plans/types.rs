//! The table of types of actions and motions cannot lie: every row, with every name and every
//! key, is performed, and does what it says or ends in a failure of the world.

use cram::designator::schema::{self, Key, Kind, TypeRow};
use cram::designator::value::Class;
use robotics::robot::Side;
use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// A bottle on the table in front of the robot, which has seen it, and values that designators
/// refer to.
const SCENE: &str = "
    (in-package :pp-tut)
    (init-projection)
    (btr-utils:move-robot '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))
    (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle)
    (defparameter *found*
      (with-simulated-robot
        (perform (a motion (type moving-torso) (joint-angle 0.3)))
        (park-arms)
        (perform (a motion (type looking) (direction down)))
        (perform (an action (type detecting) (object (an object (type bottle)))))))
    (defun as-performed (designator)
      (handler-case (with-simulated-robot (perform designator) :performed)
        (cram-common-failures:low-level-failure () :failure-of-the-world)
        (cram-common-failures:high-level-failure () :failure-of-the-world)
        (condition (c) (princ-to-string c))))";

/// Variables of designators.
const VARIABLES: &str = "
    (?object *found*)
    (?pose (make-pose \"map\" '((-1.447 0 0) (0 0 -0.7071 0.7071))))
    (?hand-pose (make-pose \"base_footprint\" '((0.55 0.35 1.1) (0 0 0 1))))
    (?hand-poses (list ?hand-pose))
    (?spot (make-pose \"map\" '((-1.3 -0.85 0.83) (0 0 0 1))))
    (?times '(5)) (?positions '(0.29)) (?velocities '(0))
    (?left-configuration '(0.9 0.3 1.2 -1.6 0.9 -1.2 0.3))
    (?right-configuration '(-0.9 0.3 -1.2 -1.6 -0.9 -1.2 -0.3))";

/// A session at its prompt.
struct Table {
    session: Session,
}

impl Table {
    fn new() -> Table {
        let mut table = Table {
            session: Session::new(&SessionOptions::default()).expect("a session starts"),
        };
        table.values(SCENE);
        table
    }

    /// The values of the last form.
    fn values(&mut self, text: &str) -> String {
        let mut shown = String::new();
        self.session
            .evaluate("test", text, &mut |event| match event {
                Event::Values(values) => shown = values.join(" "),
                Event::Aborted(abort) => panic!("{text}\n{}", abort.report),
                _ => {}
            });
        shown
    }

    /// How a designator is performed.
    fn perform(&mut self, designator: &str) -> String {
        self.values(&format!("(let* ({VARIABLES}) (as-performed {designator}))"))
    }

    fn rows(&self, class: Class) -> Vec<TypeRow> {
        let rows = schema::all(self.session.image(), class);
        rows.iter().map(|row| TypeRow::clone(row)).collect()
    }
}

/// A value that the key may have, written under that name of it.
fn value(row: &TypeRow, key: &Key, written: &str) -> String {
    let pose = match (row.class, &*row.name) {
        (Class::Motion, "MOVING-TCP" | "PUTTING") => "?hand-pose",
        // Elsewhere many places to stand are tried.
        (Class::Action, "DELIVERING" | "TRANSPORTING") if &*key.name == "TARGET" => "?spot",
        _ => "?pose",
    };
    let text = match (&key.kind, &*key.name) {
        (Kind::Place, _) if written.ends_with("POSE") => pose,
        (Kind::Place, _) => return format!("(a location (pose {pose}))"),
        (Kind::Number | Kind::Anything, "JOINT-ANGLE" | "POSITION")
            if row.name == "MOVING-TORSO" =>
        {
            "0.2"
        }
        (Kind::Number, "JOINT-ANGLE" | "POSITION") => "0.05",
        (Kind::Number, "DISTANCE") => "0.2",
        (Kind::Number, "EFFORT") => "30",
        (Kind::Number, "RETRIES") => "1",
        (Kind::Number, "DURATION" | "WAIT-DURATION" | "AMOUNT" | "SPEED") => "0.5",
        (Kind::Number, "TILT-ANGLE") => "1",
        (Kind::Keywords, "SIDES" | "FROM" | "TO") => "left",
        (Kind::Anything, "TARGET") => "?object",
        (Kind::Anything, "SURFACE") => "kitchen-island-surface",
        (Kind::Anything, "AREA") => "(0.2 0.3)",
        (Kind::Anything, "POSE") => "?pose",
        (Kind::Anything, "COLLISION-MODE") => "allow-all",
        (Kind::Anything, "GRASP") => "left-side",
        (Kind::Number, "FORCE") => "5",
        (Kind::Number, "OVERLAP") => "0.2",
        (Kind::Number, "SLICE-THICKNESS") => "0.03",
        (Kind::Number, "CUTS" | "ROUNDS" | "SHAKES") => "2",
        (Kind::Keywords, "GRIPPER" | "ARM" | "ARMS" | "DIRECTION") => "left",
        (Kind::Keywords, "GRASP" | "GRASPS" | "LEFT-GRASP" | "RIGHT-GRASP") => "left-side",
        (Kind::Keyword, "CONTEXT") => "table-setting-counter",
        (Kind::Action, "PICK-UP-ACTION") => "(an action (type picking-up) (object ?object))",
        (Kind::Action, "PLACE-ACTION") => "(an action (type placing))",
        (Kind::Member(members), _) => return members[0].to_lowercase(),
        (Kind::Object | Kind::Objects, _) if row.name == "DETECTING" => "(an object (type bottle))",
        (Kind::Object, _) if row.variant.as_deref() == Some("CONTAINER") => {
            "(an object (urdf-name sink-area-left-upper-drawer-main))"
        }
        (Kind::Object, _) if row.name == "TURNING-KNOB" => {
            "(an object (type knob) (urdf-name oven-area-oven-knob-oven))"
        }
        (Kind::Object | Kind::DetectedObject, _) => "?object",
        (Kind::Anything, "FRAME") => "\"oven_area_oven_knob_oven\"",
        (Kind::Number, "ANGLE") => "1",
        (Kind::Text, "FRAME") => "\"l_gripper_tool_frame\"",
        (Kind::List | Kind::Anything, "LEFT-CONFIGURATION") => "?left-configuration",
        (Kind::List | Kind::Anything, "RIGHT-CONFIGURATION") => "?right-configuration",
        (Kind::List, "TIMES") => "?times",
        (Kind::List, "POSITIONS") => "?positions",
        (Kind::List, "VELOCITIES") => "?velocities",
        (Kind::Poses, _) => "?hand-poses",
        (kind, name) => panic!("{}: what is a value of {name}, {kind:?}?", row.name),
    };
    text.to_owned()
}

/// A designator of the row under one of its names, with those keys.
fn designator(row: &TypeRow, name: &str, keys: &[(&Key, &str)]) -> String {
    let article = match row.class {
        Class::Motion => "a motion",
        _ => "an action",
    };
    let mut text = format!("({article} (type {name})");
    for (key, written) in keys {
        text.push_str(&format!(" ({written} {})", value(row, key, written)));
    }
    text.push(')');
    text.to_lowercase()
}

/// Designators of the row: with what it needs, and so under each of its names; then with each
/// other key, and with each key under each of its names; and its example.
fn designators(row: &TypeRow) -> Vec<String> {
    let mut needed: Vec<(&Key, &str)> = row
        .keys
        .iter()
        .filter(|key| key.is_required)
        .map(|key| (key, &*key.name))
        .collect();
    if let Some(first) = row.one_of.first() {
        let key = row.key(first).expect("it is one of the keys");
        needed.push((key, &key.name));
    }
    let mut all: Vec<String> = row.names().map(|n| designator(row, n, &needed)).collect();
    for key in &row.keys {
        for written in key.names() {
            let mut keys: Vec<(&Key, &str)> = needed
                .iter()
                .filter(|(other, _)| other.name != key.name)
                .copied()
                .collect();
            if row.one_of.contains(&key.name) {
                keys.retain(|(other, _)| !row.one_of.contains(&other.name));
            }
            keys.push((key, written));
            all.push(designator(row, &row.name, &keys));
        }
    }
    all.extend(row.example.as_deref().map(str::to_owned));
    let mut seen: Vec<String> = Vec::new();
    for text in all {
        if !seen.contains(&text) {
            seen.push(text);
        }
    }
    seen
}

/// Performs all designators of all types of a class.
fn walk(class: Class) {
    let rows = Table::new().rows(class);
    assert!(rows.len() >= 12, "{}", rows.len());
    let mut lies = Vec::new();
    for row in &rows {
        assert!(row.example.is_some(), "{} has no example", row.name);
        let holds = matches!(
            &*row.name,
            "GRIPPING"
                | "PICKING-UP"
                | "HOLDING"
                | "PLACING"
                | "FETCHING"
                | "DELIVERING"
                | "TRANSPORTING"
        );
        let mut table = Table::new();
        for (index, designator) in designators(row).into_iter().enumerate() {
            // What a hand has taken is not on the table any more.
            if holds && index > 0 {
                table = Table::new();
            }
            if matches!(&*row.name, "PLACING" | "DELIVERING") {
                let picked =
                    table.perform("(an action (type picking-up) (object ?object) (arm left))");
                assert_eq!(picked, ":PERFORMED");
            }
            let outcome = table.perform(&designator);
            if !matches!(outcome.as_str(), ":PERFORMED" | ":FAILURE-OF-THE-WORLD") {
                lies.push(format!("{designator}: {outcome}"));
            }
        }
    }
    assert!(lies.is_empty(), "{}", lies.join("\n"));
}

#[test]
fn every_action_of_the_table_can_be_performed() {
    walk(Class::Action);
}

#[test]
fn every_motion_of_the_table_can_be_performed() {
    walk(Class::Motion);
}

#[test]
fn keys_do_what_they_say_under_each_of_their_names() {
    let mut table = Table::new();
    let height = |table: &Table| {
        let world = table.session.simulation().world();
        let torso = &world.models().description.torso;
        torso.height(&world.robot_configuration().joints)
    };
    for (name, wanted) in [("joint-angle", 0.25), ("position", 0.15)] {
        let motion = format!("(a motion (type moving-torso) ({name} {wanted}))");
        assert_eq!(table.perform(&motion), ":PERFORMED");
        assert!((height(&table) - wanted).abs() < 1e-6, "{motion}");
    }
    let opening = |table: &Table| {
        let world = table.session.simulation().world();
        let hand = &world.models().description.arm(Side::Left).gripper;
        world.robot_configuration().joints.get(hand.joint)
    };
    let mut last = opening(&table);
    for motion in [
        "(a motion (type opening) (arm left))",
        "(a motion (type moving-gripper-joint) (arm left) (position 0.02))",
        "(an action (type opening) (arms (left right)))",
        "(a motion (type closing) (arms left))",
    ] {
        assert_eq!(table.perform(motion), ":PERFORMED");
        assert!((opening(&table) - last).abs() > 0.05, "{motion}");
        last = opening(&table);
    }
    for (name, value) in [
        ("location", "(a location (pose ?pose))"),
        ("pose", "?pose"),
        ("target", "(a location (pose ?pose))"),
    ] {
        table.values("(btr-utils:move-robot '((-1.447 -0.15 0) (0 0 -0.7071 0.7071)))");
        let motion = format!("(a motion (type going) ({name} {value}))");
        assert_eq!(table.perform(&motion), ":PERFORMED", "{motion}");
        let base = table
            .session
            .simulation()
            .world()
            .robot_configuration()
            .base;
        assert!(base.translation.y.abs() < 1e-3, "{motion}");
    }
}

#[test]
fn waiting_takes_simulated_time_and_keeps_nobody_from_moving() {
    let mut table = Table::new();
    let took = |table: &mut Table, body: &str| {
        let before = table.session.simulation().now();
        table.values(&format!(
            "(let* ({VARIABLES}) (with-simulated-robot {body}))"
        ));
        table.session.simulation().now() - before
    };
    let wait = |seconds: f64| format!("(perform (a motion (type waiting) (duration {seconds})))");
    assert!((took(&mut table, &wait(2.0)) - 2.0).abs() < 1e-9);
    let both = format!("(cpl:par {} {})", wait(2.0), wait(3.0));
    assert!((took(&mut table, &both) - 3.0).abs() < 1e-9);
    let look = "(perform (a motion (type looking) (direction left)))";
    let alone = took(&mut table, look);
    table.values("(with-simulated-robot (perform (a motion (type looking) (direction down))))");
    let beside = took(&mut table, &format!("(cpl:pursue {} {look})", wait(60.0)));
    assert!((beside - alone).abs() < 0.01, "{beside} {alone}");
    // Time for which the task is suspended does not count.
    let suspended = format!(
        "(cpl:with-tags
           (cpl:par
             (:tag waiter {})
             (cpl:with-task-suspended (waiter) (cpl:sleep 5))))",
        wait(2.0)
    );
    assert!((took(&mut table, &suspended) - 7.0).abs() < 0.05);
    assert!(
        table
            .perform("(an action (type waiting) (duration -1))")
            .contains("(duration -1) is negative")
    );
}

#[test]
fn what_is_not_built_is_not_in_the_table() {
    let mut table = Table::new();
    for name in ["peeling", "ironing"] {
        let action = format!("(an action (type {name}) (object (an object (type bottle))))");
        let said = table.perform(&action);
        let wanted = format!("There is no action of type {}", name.to_uppercase());
        assert!(said.contains(&wanted), "{said}");
    }
    let drawer = "(an action (type opening) (arm left) (object (an object (type drawer))))";
    let said = table.perform(drawer);
    assert!(
        said.contains("cannot be opened or closed: it does not say which one it is"),
        "{said}"
    );
    let hand = "(an action (type releasing) (arm left) (object (an object (type drawer))))";
    let said = table.perform(hand);
    assert!(
        said.contains("The action RELEASING cannot act on an object: it was given #<A OBJECT"),
        "{said}"
    );
    let head = table.perform("(a motion (type moving-with-constraints) (constraints \"c\"))");
    assert!(
        head.contains("There is no motion of type MOVING-WITH-CONSTRAINTS."),
        "{head}"
    );
}

#[test]
fn an_action_of_the_users_own_is_known_at_once_everywhere() {
    let mut table = Table::new();
    table.values(
        "(def-action waving
             ((arm (member left right) \"the arm to wave with\" :aliases (hand))
              &optional (times number \"how often\" :default 2))
           \"Waves to somebody.\"
           (:aliases greeting)
           (:example (an action (type waving) (arm left)))
           (dotimes (i ?times ?arm)
             (perform (a motion (type moving-gripper-joint) (gripper ?arm) (position 0.05)))
             (perform (a motion (type closing) (gripper ?arm)))))",
    );
    assert_eq!(
        table.values(
            "(with-simulated-robot (perform (an action (type greeting) (hand left) (times 1))))"
        ),
        ":LEFT"
    );
    let complete = |text: &str| -> Vec<String> {
        let found = session::dialogue::Converse::completions(&table.session, text, text.len());
        found.candidates.into_iter().map(|c| c.text).collect()
    };
    assert_eq!(complete("(an action (type wav"), ["waving"]);
    assert_eq!(complete("(an action (type waving) (ti"), ["times"]);
    assert_eq!(
        complete("(an action (type waving) (arm "),
        ["left", "right"]
    );
    let mut described = String::new();
    table
        .session
        .evaluate("test", "(doc waving)", &mut |event| {
            if let Event::Output(text) = event {
                described.push_str(&text);
            }
        });
    for part in [
        "(an action (type waving) (arm …) [(times …)])",
        "Waves to somebody.",
        "arm: the arm to wave with, needed",
        "For example (an action (type waving) (arm left))",
    ] {
        assert!(described.contains(part), "{part}\n{described}");
    }
    let said = table.perform("(an action (type waving) (arm middle))");
    assert!(
        said.contains("[ACTION SPEC:PROPERTY]: :MIDDLE had to be of type (MEMBER"),
        "{said}"
    );
}
