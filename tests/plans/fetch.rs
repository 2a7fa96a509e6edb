//! Fetch: a robot with one arm, whose inverse kinematics is numeric, and a base that drives ahead only.

use super::cook::Cook;
use descriptions::FETCH_DESCRIPTION;
use nalgebra::Point3;
use session::SessionOptions;
use spatial::pose::{distance_between, from_xyz_rpy};

fn fetch() -> SessionOptions {
    let mut options = SessionOptions::default();
    options.set_shipped_robot("fetch").unwrap();
    options
}

const BOTTLE: &str =
    "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))";

#[test]
fn fetch_brings_a_bottle_to_the_island() {
    let mut cook = Cook::watched_with(&fetch());
    cook.done(BOTTLE);
    cook.done(
        "(with-simulated-robot
           (let ((?spot (make-pose \"map\" '((-0.8 2 0.96) (0 0 0 1)))))
             (perform (an action (type transporting) (object (an object (type bottle)))
                                 (target (a location (pose ?spot)))))
             (park-arms)))",
    );
    let there = from_xyz_rpy([-0.8, 2.0, 0.96], [0.0; 3]);
    let away = distance_between(&cook.pose("BOTTLE-1"), &there);
    assert!(away < 0.01, "{away}");
    assert_eq!(cook.done("(pw:arms-parked-p)").trim(), "T");
    cook.assert_no_overlap();
}

/// The plan that the tutorial writes for the PR2 names its place to stand, its arm and its grasp.
#[test]
fn the_first_plan_of_the_tutorial_runs_with_fetch() {
    let mut cook = Cook::with(&fetch());
    cook.done("(load \"plans/tutorial/move-bottle.plan\")");
    let support = cook.done("(pp-plans::support-of 'bottle-1)");
    assert_eq!(support.trim(), "\"kitchen_island_surface\"");
}

#[test]
fn fetch_opens_and_closes_a_drawer() {
    let mut cook = Cook::watched_with(&fetch());
    cook.done("(defparameter *there* (a location (in (an object (type drawer) (urdf-name sink_area_left_upper_drawer_main)))))");
    let mut perform = |kind: &str| {
        cook.done(&format!(
            "(with-simulated-robot
               (let ((?there *there*)) (perform (an action (type {kind}) (location ?there)))))"
        ));
        let world = cook.session.simulation().world();
        let joint = world.kitchen_joint("sink_area_left_upper_drawer_main_joint");
        joint.unwrap()
    };
    let (opened, closed) = (perform("accessing"), perform("sealing"));
    assert!(opened > 0.45 && closed < 0.01, "{opened} {closed}");
    cook.assert_no_overlap();
}

#[test]
fn an_arm_that_is_not_there_is_refused_wherever_it_is_named() {
    let mut cook = Cook::with(&fetch());
    cook.done(BOTTLE);
    for form in [
        "(perform (a motion (type opening) (gripper left)))",
        "(perform (an action (type parking-arms) (arms (left right))))",
        "(pp-plans::objects-in-hand :left)",
        "(rob-int::hand-opening :left)",
        "(park-arm :left)",
    ] {
        let said = match cook.say(&format!("(with-simulated-robot {form})")) {
            Err((report, _)) => report,
            Ok(said) => panic!("{form}: {said}"),
        };
        assert!(
            said.contains(":LEFT is no arm: the robot has the arm :RIGHT."),
            "{form}: {said}"
        );
    }
    let facts = cook.done("(cut:force-ll (prolog:prolog '(rob-int:arms ?robot ?arms)))");
    assert!(facts.contains("(?ARMS :RIGHT)"), "{facts}");
}

#[test]
fn handing_over_needs_two_arms() {
    let mut cook = Cook::with(&fetch());
    cook.done(BOTTLE);
    cook.done(
        "(with-simulated-robot (perform (an action (type fetching) (object (an object (type bottle))))))",
    );
    let said = cook.say(
        "(with-simulated-robot
           (perform (an action (type handing-over) (object (an object (name bottle-1))))))",
    );
    let (report, _) = said.expect_err("it has one arm");
    assert!(
        report.contains("that takes two arms, and the robot has one"),
        "{report}"
    );
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
}

#[test]
fn another_robot_takes_the_place_of_the_first_and_goes_again() {
    let mut cook = Cook::new();
    cook.done(BOTTLE);
    let said =
        cook.done("(list (use-robot :fetch) (rob-int::robot-name) cram-tf:*robot-base-frame*)");
    assert_eq!(said.trim(), "(:FETCH :FETCH \"base_link\")");
    assert!(!cook.session.simulation().world().objects().any(|_| true));
    let said = cook.done("(rewind) (list (rob-int::robot-name) (pp-plans::objects-in-hand :left))");
    assert_eq!(said.trim().lines().last(), Some("(:PR2 NIL)"));
    assert!(cook.session.simulation().world().object("BOTTLE-1").is_ok());
    for (name, said) in [
        (":fitch", "did you mean :FETCH?"),
        (":hrs", "did you mean :HSR?"),
        (":toaster", "it has :PR2, :FETCH, :HSR"),
    ] {
        let (report, _) = cook
            .say(&format!("(use-robot {name})"))
            .expect_err("there is none");
        assert!(report.contains(said), "{report}");
    }
}

#[test]
fn fetch_does_the_same_twice_to_the_bit() {
    let hash = || {
        let mut cook = Cook::with(&fetch());
        cook.done(BOTTLE);
        cook.done(
            "(with-simulated-robot (perform (an action (type fetching) (object (an object (type bottle))))))",
        );
        cook.session.simulation().world().hash()
    };
    assert_eq!(hash(), hash());
}

/// Fetch with another description: without a record, or with another one in its place.
fn described(head: &str, instead: &str) -> SessionOptions {
    let begin = FETCH_DESCRIPTION.find(head).expect("it has the record");
    let end = begin + FETCH_DESCRIPTION[begin..].find("\n\n").expect("it ends");
    let text = [
        &FETCH_DESCRIPTION[..begin],
        instead,
        &FETCH_DESCRIPTION[end..],
    ]
    .concat();
    SessionOptions {
        robot_description: Some(("fetch.sexp".to_owned(), text)),
        ..fetch()
    }
}

const LOOKS_AT: &str = "(with-simulated-robot
    (let ((?there (make-pose \"map\" '((1.2 0.4 0.6) (0 0 0 1)))))
      (perform (an action (type looking) (target (a location (pose ?there)))))))";

#[test]
fn a_neck_of_any_joints_aims_the_axis_of_the_camera() {
    let neck = "(neck :joints (head_pan_joint head_tilt_joint))";
    let mut cook = Cook::with(&described("(neck ", neck));
    cook.done(LOOKS_AT);
    let world = cook.session.simulation().world();
    let camera = world
        .models()
        .robot
        .link_named("head_camera_rgb_optical_frame");
    let camera = world.link_pose(camera.expect("it has a camera"));
    let seen = camera.inverse_transform_point(&Point3::new(1.2, 0.4, 0.6));
    assert!(seen.z > 0.5, "{seen}");
    assert!(seen.x.abs() < 1e-6 && seen.y.abs() < 1e-6, "{seen}");
}

#[test]
fn a_camera_that_does_not_turn_looks_only_at_what_is_in_its_picture() {
    let mut cook = Cook::with(&described("(neck ", ""));
    let report = cook.fails(
        "PTU",
        "(let ((?behind (make-pose \"map\" '((-2 0 1) (0 0 0 1)))))
           (perform (a motion (type looking) (target (a location (pose ?behind))))))",
    );
    assert!(report.contains("its camera does not turn"), "{report}");
    let ahead = "(make-pose \"map\" '((3 0 1.1) (0 0 0 1)))";
    cook.done(&format!(
        "(with-simulated-robot
           (let ((?ahead {ahead}))
             (perform (a motion (type looking) (target (a location (pose ?ahead)))))))"
    ));
}

#[test]
fn a_robot_without_a_lift_picks_up_from_where_its_arm_is() {
    let mut options = described("(torso ", "");
    let (name, text) = options.robot_description.take().expect("it is given");
    let text = text
        .replace(
            "(speed torso_lift_joint :velocity 0.1 :acceleration 0.4)",
            "",
        )
        .replace("(idle-joints ", "(idle-joints torso_lift_joint ");
    options.robot_description = Some((name, text));
    let mut cook = Cook::with(&options);
    cook.done(BOTTLE);
    cook.done(
        "(with-simulated-robot (perform (an action (type fetching) (object (an object (type bottle))))))",
    );
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
    assert_eq!(
        cook.done("(list (rob-int::torso-joint) (rob-int::torso-height))")
            .trim(),
        "(NIL 0.0d0)"
    );
}
