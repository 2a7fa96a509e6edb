//! What hands hold, and when they do not: fingers hold, and nothing else does.

use std::cell::Cell;
use std::rc::Rc;

use super::cook::Cook;
use robotics::world::World;

/// Where the open hand of a robot with parked arms drops things.
fn fell(cook: &Cook) -> bool {
    cook.pose("BOTTLE-1").translation.z < 0.3
}

#[test]
fn a_flat_thing_is_not_pressed_into_the_table_while_it_is_gripped() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'fork-1 :fork :pose '((-1.55 -0.78 0.86) (0 0 0.728 0.685)))
         (with-simulated-robot (get-ready-at *place-at-table*))
         (defparameter *fork* (with-simulated-robot (find-object :fork)))",
    );
    let deepest = Rc::new(Cell::new(0.0_f64));
    let so_far = deepest.clone();
    cook.session.set_observer(Box::new(move |world: &World| {
        so_far.set(so_far.get().max(world.depth_of("FORK-1").unwrap().0));
    }));
    cook.done(
        "(with-simulated-robot
           (let ((?f *fork*))
             (perform (an action (type picking-up) (arm right) (grasp top) (object ?f)))))",
    );
    assert_eq!(cook.in_right_hand(), "(FORK-1)");
    assert!(deepest.get() < 0.001, "{} m", deepest.get());
}

#[test]
fn a_hand_opens_in_the_posture_at_the_start() {
    let mut cook = Cook::new();
    for hand in ["left", "right"] {
        cook.done(&format!(
            "(with-simulated-robot
               (perform (a motion (type opening-gripper) (gripper {hand}))))"
        ));
    }
}

#[test]
fn an_opened_hand_drops_what_it_held() {
    let mut cook = Cook::at_table_with_bottle();
    cook.take_bottle();
    let above = cook.pose("BOTTLE-1");
    assert!(above.translation.z > 1.0);
    cook.done(
        "(with-simulated-robot
           (perform (an action (type releasing) (gripper right)))
           (cpl:sleep 2))",
    );
    assert_eq!(cook.in_right_hand(), "NIL");
    assert!(cook.pose("BOTTLE-1").translation.z < above.translation.z - 0.3);
    let lies = cook.pose("BOTTLE-1");
    cook.done("(with-simulated-robot (go-to (make-pose \"map\" '((0 0 0) (0 0 0 1)))))");
    assert!(cook.distance("BOTTLE-1", &lies) < 0.5);
}

#[test]
fn every_way_of_opening_the_fingers_drops_what_they_hold() {
    for open in [
        "(an action (type opening) (gripper right))",
        "(an action (type setting-gripper) (gripper right) (position 0.1))",
        "(a motion (type opening) (gripper right))",
        "(a motion (type moving-gripper-joint) (gripper right) (joint-angle 0.1))",
    ] {
        let mut cook = Cook::at_table_with_bottle();
        cook.take_bottle();
        cook.done(&format!(
            "(with-simulated-robot (perform {open}) (cpl:sleep 2))"
        ));
        assert_eq!(cook.in_right_hand(), "NIL", "{open}");
        assert!(
            fell(&cook) || cook.pose("BOTTLE-1").translation.z < 0.9,
            "{open}"
        );
    }
}

#[test]
fn closing_the_fingers_further_drops_nothing() {
    let mut cook = Cook::watched_at_table_with_bottle();
    cook.take_bottle();
    cook.done(
        "(with-simulated-robot
           (perform (an action (type closing) (gripper right)))
           (perform (an action (type setting-gripper) (gripper right) (position 0.01)))
           (perform (a motion (type gripping) (gripper right) (effort 80)))
           (cpl:sleep 1))",
    );
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
    assert!(cook.pose("BOTTLE-1").translation.z > 1.0);
    cook.assert_no_overlap();
}

#[test]
fn what_the_fingers_do_not_hold_cannot_be_attached() {
    let mut cook = Cook::at_table_with_bottle();
    let stands = cook.pose("BOTTLE-1");
    let report = cook.fails(
        "GRIPPER-CLOSED-COMPLETELY",
        "(pp-plans::attach-object *bottle* :right :left-side)",
    );
    assert_eq!(
        report,
        "BOTTLE-1 is not between the fingers of the right hand, which press on it with 0.0 and \
         0.0 N: grip it first"
    );
    cook.done(
        "(with-simulated-robot (go-to (make-pose \"map\" '((-1.447 0.1 0) (0 0 -0.7071 0.7071)))))",
    );
    assert!(cook.distance("BOTTLE-1", &stands) < 1e-3);
}

/// Grips the bottle without picking it up: moves the hand around it and closes the fingers.
pub(super) const GRIP_ONLY: &str = "
    (destructuring-bind (pre pre2 grasp lift lift2)
        (pp-plans::grasping-poses *bottle* :right :left-side)
      (declare (ignore lift2))
      (defparameter *lift* lift)
      (with-simulated-robot
        (perform (a motion (type opening) (gripper right)))
        (dolist (?p (list pre pre2))
          (perform (a motion (type moving-tcp) (right-target (a location (pose ?p))))))
        (let ((?p grasp) (?b *bottle*))
          (perform (a motion (type moving-tcp) (right-target (a location (pose ?p)))
                      (collision-mode :allow-hand) (object ?b)))
          (perform (a motion (type gripping) (gripper right) (object ?b))))))";

/// Lifts the hand.
pub(super) const LIFT: &str = "(let ((?p *lift*))
    (perform (a motion (type moving-tcp) (right-target (a location (pose ?p)))
                (collision-mode :allow-hand))))";

#[test]
fn fingers_that_grip_hold_whatever_is_known_about_it() {
    let mut cook = Cook::watched_at_table_with_bottle();
    cook.done(GRIP_ONLY);
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
    let before = cook.pose("BOTTLE-1").translation.z;
    cook.done(&format!("(with-simulated-robot {LIFT})"));
    assert!(cook.pose("BOTTLE-1").translation.z > before + 0.14);
    cook.assert_no_overlap();
}

#[test]
fn a_weak_grip_loses_a_heavy_object_and_says_with_which_forces() {
    // A bottle of 1.5 kg weighs 14.7 N; fingers that press with 10 N hold 12 N by friction.
    let mut cook = Cook::at_table_with_bottle_of(":mass 1.5");
    cook.done(&GRIP_ONLY.replace("(gripper right) (object ?b)", "(gripper right) (effort 10)"));
    let report = cook.fails("GRIPPER-CLOSED-COMPLETELY", LIFT);
    assert!(
        report.starts_with("BOTTLE-1 has slipped out of the right hand:"),
        "{report}"
    );
    assert!(report.contains("the fingers hold up to 12.0 N"), "{report}");
    assert_eq!(cook.in_right_hand(), "NIL");
    // Fingers that press hard enough lift it.
    let mut cook = Cook::at_table_with_bottle_of(":mass 1.5");
    cook.done(&GRIP_ONLY.replace("(gripper right) (object ?b)", "(gripper right) (effort 60)"));
    cook.done(&format!("(with-simulated-robot {LIFT})"));
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
}

#[test]
fn an_effort_that_the_gripper_does_not_have_is_refused() {
    let mut cook = Cook::new();
    for effort in ["500", "0", "-3"] {
        let report = cook.fails(
            "GRIPPER-GOAL-NOT-REACHED",
            &format!("(perform (a motion (type gripping) (gripper right) (effort {effort})))"),
        );
        assert!(
            report.contains(&format!("cannot press with {effort} N")) && report.contains("100 N"),
            "{report}"
        );
    }
}

#[test]
fn what_is_too_heavy_stays_where_it_stands_and_the_figures_are_told() {
    for (mass, kilograms) in [("20", 20.0), ("4", 4.0)] {
        let mut cook = Cook::at_table_with_bottle_of(&format!(":mass {mass}"));
        let stands = cook.pose("BOTTLE-1");
        let report = cook.fails(
            "MANIPULATION-GOAL-NOT-REACHED",
            "(let ((?b *bottle*))
               (perform (an action (type picking-up) (arm right) (grasp left-side) (object ?b))))",
        );
        assert_eq!(
            report,
            format!(
                "BOTTLE-1 is too heavy for the right arm: it has {kilograms} kg, and the maker of \
                 the arm allows 1.8 kg"
            )
        );
        cook.done("(with-simulated-robot (cpl:sleep 1))");
        assert!(cook.distance("BOTTLE-1", &stands) < 0.005);
        assert_eq!(cook.in_right_hand(), "NIL");
    }
    let mut cook = Cook::at_table_with_bottle_of(":mass 1.7");
    cook.take_bottle();
}

#[test]
fn a_hand_that_holds_something_grasps_nothing_else() {
    let mut cook = Cook::at_table_with_bottle();
    cook.take_bottle();
    cook.done("(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'bottle-2)");
    let report = cook.fails(
        "MANIPULATION-GOAL-NOT-REACHED",
        "(let ((?b (find-object :bottle)))
           (perform (an action (type picking-up) (arm right) (object ?b))))",
    );
    assert_eq!(report, "The right hand is not free: it holds BOTTLE-1.");
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
}

#[test]
fn a_torso_that_brings_the_hand_down_on_a_bottle_stops_there() {
    let mut cook = Cook::new();
    cook.done("(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))");
    let stands = cook.pose("BOTTLE-1");
    let report = cook.fails(
        "TORSO-GOAL-UNREACHABLE",
        "(let ((?place (make-pose \"map\" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071))))
               (?above (make-pose \"base_footprint\" '((0.75 -0.153 1.05) (0 0.7071 0 0.7071))))
               (?up 0.33) (?down 0.05))
           (cpl:par (perform (an action (type going) (target (a location (pose ?place)))))
                    (perform (a motion (type moving-torso) (joint-angle ?up))))
           (perform (a motion (type moving-tcp) (right-pose ?above)))
           (perform (a motion (type moving-torso) (joint-angle ?down))))",
    );
    assert!(report.contains("r_gripper_l_finger_tip_link"), "{report}");
    assert!(report.contains("BOTTLE-1"), "{report}");
    // It used to be pressed 24 mm farther.
    assert!(cook.distance("BOTTLE-1", &stands) < 0.001);
    assert!(cook.turned_up("BOTTLE-1", &stands) < 0.5);
}
