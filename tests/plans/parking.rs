//! Parking the arms, also where there is no room for it.

use super::cook::Cook;
use super::grasping::{GRIP_ONLY, LIFT};

/// Evaluates to the poses of the base (x, y) at which the arms may be parked.
const PLACES: &str = "(mapcar (lambda (pose)
                                (list (round (* 100 (cl-tf:x (cl-tf:origin pose))))
                                      (round (* 100 (cl-tf:y (cl-tf:origin pose))))))
                              (subseq (pp-plans::places-aside) 0 2))";

/// The hand may be in a cupboard, and nothing else than straight back leads out of it.
#[test]
fn a_hand_that_cannot_be_parked_is_taken_straight_back_first() {
    let mut cook = Cook::new();
    cook.done("(init-projection) (with-simulated-robot (pp-plans::park-arms))");
    assert_eq!(cook.done(PLACES), "((-15 0) (-30 0))\n");
    cook.done(
        "(with-simulated-robot
           (let ((?pose (make-pose \"base_footprint\" '((0.6 0.3 1.0) (0 0 0.38268 0.92388)))))
             (perform (an action (type reaching) (left-poses ?pose)))))",
    );
    // The hand points to the left, forward by 45 degrees.
    assert_eq!(cook.done(PLACES), "((-14 -14) (-28 -28))\n");
}

/// A robot with the torso at a height (m) and the right arm at seven angles (rad).
fn reaching_out(height: f64, angles: &str) -> Cook {
    let mut cook = Cook::watched();
    cook.done(&format!(
        "(init-projection)
         (with-simulated-robot
           (pp-plans::park-arms)
           (perform (a motion (type moving-torso) (joint-angle {height})))
           (let ((?angles '({angles})))
             (perform (an action (type positioning-arm) (right-configuration ?angles)))))"
    ));
    cook
}

/// With the torso where it is, a shoulder would touch the edge of the counter. Nothing leads out of
/// there with an arm that is stretched out.
#[test]
fn arms_are_parked_beside_a_counter_with_the_torso_higher() {
    let mut cook = reaching_out(0.09, "-0.033 0.078 -1.345 -0.65 -1.798 -1.644 -1.313");
    cook.done("(btr-utils:move-robot '((0.825 0.325 0) (0 0 0.67219 0.74038)))");
    let base = |cook: &Cook| {
        let world = cook.session.simulation().world();
        world.robot_configuration().base
    };
    let stood = base(&cook);
    let parked = "(pp-plans::parked-p :right)";
    cook.done("(with-simulated-robot (pp-plans::park-arms))");
    assert_eq!(cook.done(parked), "NIL\n");
    cook.done("(with-simulated-robot (pp-plans::park-arms-nearby))");
    assert_ne!(cook.done(parked), "NIL\n");
    assert_eq!(base(&cook), stood);
    cook.assert_no_overlap();
}

/// Nothing leads out from between an open drawer and the oven with a hand that has been lowered behind
/// the drawer's front.
#[test]
fn the_torso_is_put_back_when_no_height_helps_to_park_the_arms() {
    let mut cook = reaching_out(0.19, "0.333 -0.286 -2.938 -0.157 -0.2 -1.713 -0.476");
    cook.done(
        "(let ((?tucked '(0.171 1.147 1.912 -1.667 -0.028 -0.075 -2.142)))
           (with-simulated-robot
             (perform (an action (type positioning-arm) (left-configuration ?tucked)))))
         (move-kitchen-joint :joint-name \"sink_area_left_upper_drawer_main_joint\"
                             :joint-angle 0.48)
         (btr-utils:move-robot '((0.775 1.575 0) (0 0 -0.61203 0.79083)))",
    );
    let parked = "(pp-plans::parked-p :right)";
    let printed = cook.done("(with-simulated-robot (pp-plans::park-arms-at-other-heights))");
    assert!(printed.contains("Ignoring"), "{printed}");
    assert_eq!(cook.done(parked), "NIL\n");
    let height =
        cook.done("(values (round (* 100 (rob-int::joint-position \"torso_lift_joint\"))))");
    assert_eq!(height, "19\n");
    cook.done("(with-simulated-robot (pp-plans::park-arms-nearby))");
    cook.done(
        "(let ((?pose (make-pose \"map\" '((-0.3 1.5 0) (0 0 0 1)))))
           (with-simulated-robot
             (perform (an action (type navigating) (location (a location (pose ?pose)))))))",
    );
    assert_ne!(cook.done(parked), "NIL\n");
    cook.assert_no_overlap();
}

/// With the torso down, the parked hand holds a bowl behind the front of an open drawer: no path leads away from there.
#[test]
fn what_a_hand_holds_over_an_open_drawer_is_lifted_over_its_front() {
    let mut cook = Cook::watched();
    let said = cook.done(
        "(in-package :pp-tut)
         (with-simulated-robot
           (pp-plans::park-arms)
           (perform (a motion (type moving-torso) (joint-angle 0.0))))
         (move-kitchen-joint :joint-name \"sink_area_left_middle_drawer_main_joint\" :joint-angle 0.48)
         (spawn-object '((0.9 0.70 0.4631) (0 0 -0.50382 -0.86381)) :bowl 'bowl-1)
         (btr-utils:move-robot '((0.525 0.825 0) (0 0 -0.16018 0.98709)))
         (with-simulated-robot
           (let ((?there (make-pose \"map\" '((0.9 0.7 0.46) (0 0 0 1)))))
             (perform (an action (type looking) (target (a location (pose ?there))))))
           (let ((?bowl (perform (an action (type detecting) (object (an object (type bowl)))))))
             (perform (an action (type picking-up) (object ?bowl) (arm left))))
           (pp-plans::park-arms)
           (perform (a motion (type moving-torso) (joint-angle 0.0)))
           (pp-plans::park-arms))
         (format t \"~a ~a~%\" (pp-plans::both-parked-p) (base-path-p '((-0.1 1.2 0) (0 0 1 0))))
         (with-simulated-robot
           (let ((?away (make-pose \"map\" '((-0.1 1.2 0) (0 0 1 0)))))
             (perform (an action (type navigating) (location (a location (pose ?away)))))))
         (format t \"~a~%\" (rob-int::torso-height))",
    );
    assert!(said.contains("\nT NIL\n"), "{said}");
    assert!(
        said.contains("Trying again with the torso at 0.33 m."),
        "{said}"
    );
    let base = cook.session.simulation().world().robot_configuration().base;
    assert!((base.translation.x + 0.1).abs() < 0.01, "{said}");
    cook.assert_no_overlap();
}

/// The fingers are still around the bottle: any way but straight back would push it, and then nothing leads away.
#[test]
fn a_hand_that_something_has_slipped_out_of_is_withdrawn_before_it_is_parked() {
    let mut cook = Cook::at_table_with_bottle_of(":mass 1.5");
    cook.done(&GRIP_ONLY.replace("(gripper right) (object ?b)", "(gripper right) (effort 10)"));
    let report = cook.fails("GRIPPER-CLOSED-COMPLETELY", LIFT);
    assert!(
        report.contains("has slipped out of the right hand"),
        "{report}"
    );
    let stands = cook.pose("BOTTLE-1");
    let said = cook.done("(with-simulated-robot (pp-plans::park-arms-nearby))");
    assert!(!said.contains("pushed"), "{said}");
    assert_ne!(cook.done("(pp-plans::parked-p :right)"), "NIL\n");
    assert!(cook.distance("BOTTLE-1", &stands) < 2e-3);
}

/// What has slipped in a hand on the way is still between its fingers. To open the hand would throw it down, and as long as
/// the hand does not hold it, it is in the way of every way.
#[test]
fn a_hand_closes_again_on_what_has_slipped_in_it_on_the_way() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :pp-tut)
         (btr-utils:spawn-object 'milk-1 :milk :pose '((-0.8 1.0 0.97) (0 0 0 1)))
         (with-simulated-robot
           (perform (an action (type fetching) (arms (left)) (object (an object (type milk))))))
         (btr:detach-all-objects (btr:get-robot-object))
         (btr:simulate btr:*current-bullet-world* 3)",
    );
    assert_eq!(cook.done("(pp-plans::objects-in-hand :left)"), "NIL\n");
    // As hard as milk is gripped, not as hard as the hand can.
    cook.done(
        "(defvar *efforts* '())
         (defmethod man-int:get-action-gripping-effort :heuristics 10 ((type (eql :milk)))
           (push type *efforts*)
           15)",
    );
    cook.done(
        "(let ((?there (make-pose \"map\" '((-0.3 -0.2 0) (0 0 0 1)))))
           (with-simulated-robot
             (perform (an action (type navigating) (location (a location (pose ?there)))))))",
    );
    assert_eq!(cook.done("(pp-plans::objects-in-hand :left)"), "(MILK-1)\n");
    assert_eq!(cook.done("*efforts*"), "(:MILK)\n");
}

/// With its fingers open, the wrist cannot turn past the forearm: neither another height nor another place helped.
#[test]
fn a_hand_whose_open_fingers_have_no_room_is_closed_before_it_is_parked() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :pp-tut)
         (init-projection)
         (with-simulated-robot
           (pp-plans::park-arms)
           (perform (an action (type closing) (gripper left)))
           (let ((?angles '(0.918 0.026 2.757 -1.822 2.926 -1.828 -2.582)))
             (perform (an action (type positioning-arm) (left-configuration ?angles))))
           (perform (an action (type opening) (gripper left)))
           (pp-plans::park-arms))",
    );
    assert_eq!(cook.done("(pp-plans::parked-p :left)"), "NIL\n");
    cook.done("(with-simulated-robot (pp-plans::park-arms-nearby))");
    assert_ne!(cook.done("(pp-plans::parked-p :left)"), "NIL\n");
}

/// A way was planned each time, and the robot stopped on it at once: all places were tried, for minutes.
#[test]
fn a_robot_that_was_stopped_before_it_had_moved_has_no_way_out_until_its_arms_are_to_be_parked() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :pp-tut)
         (init-projection)
         (with-simulated-robot (pp-plans::park-arms))
         (defun stop-at (pose)
           (pp-plans::note-stop (make-condition 'navigation-goal-not-reached) pose))",
    );
    let is_free = |cook: &mut Cook, free: bool| {
        let said = cook.done("(if (pp-plans::way-out-p) 'free 'enclosed)");
        assert_eq!(said == "FREE\n", free, "{said}");
    };
    is_free(&mut cook, true);
    cook.done("(stop-at (rob-int::base-pose))");
    is_free(&mut cook, false);
    cook.done("(with-simulated-robot (pp-plans::park-arms-nearby))");
    is_free(&mut cook, true);
    cook.done("(stop-at (rob-int::base-pose))");
    cook.done("(btr-utils:move-robot '((0.0 0.5 0) (0 0 0 1)))");
    is_free(&mut cook, true);
    // Stopped on the way.
    cook.done("(stop-at (make-pose \"map\" '((0.0 0.0 0) (0 0 0 1))))");
    is_free(&mut cook, true);
}
