//! Opening and closing drawers and doors.

use super::cook::Cook;
use spatial::pose::{angle_between, distance_between};

pub(super) const FUNCTIONS: &str = "
    (in-package :pp-tut)
    (defun open-it (?name &optional ?distance)
      (perform (an action (type accessing)
                   (location (a location (in (an object (urdf-name ?name) (part-of kitchen)))))
                   (desig:when ?distance (distance ?distance)))))
    (defun go-open (name &optional distance)
      (with-simulated-robot (open-it name distance)))
    (defun go-close (?name)
      (with-simulated-robot
        (perform (an action (type sealing)
                     (location (a location (in (an object (urdf-name ?name) (part-of kitchen)))))))))
    (defun put-in (name ?type ?furniture)
      (let* ((?for (an object (type ?type)))
             (?in (an object (urdf-name ?furniture) (part-of kitchen)))
             (pose (desig:reference (a location (in ?in) (for ?for)))))
        (btr-utils:spawn-object name ?type :pose pose)))";

fn cook() -> Cook {
    let mut cook = Cook::watched();
    cook.done(FUNCTIONS);
    cook
}

impl Cook {
    pub(super) fn joint(&self, name: &str) -> f64 {
        self.session
            .simulation()
            .world()
            .kitchen_joint(name)
            .unwrap()
    }

    fn parked(&self) -> bool {
        let world = self.session.simulation().world();
        robotics::robot::Side::BOTH
            .into_iter()
            .all(|side| world.handle_hold(side).is_none())
    }
}

const MIDDLE: &str = "sink_area_left_middle_drawer_main_joint";

#[test]
fn a_drawer_is_opened_and_closed_with_what_is_in_it() {
    let mut cook = cook();
    cook.done(
        "(put-in 'cup-1 :cup :sink-area-left-middle-drawer-main)
         (put-in 'bowl-1 :bowl :sink-area-left-middle-drawer-main)",
    );
    let things = ["CUP-1", "BOWL-1"];
    let before = things.map(|name| cook.pose(name));
    let said = cook.done("(go-open :sink-area-left-middle-drawer-main)");
    for line in [
        "Opening gripper and reaching",
        "Gripping",
        "Manipulating",
        "Retracting",
    ] {
        assert!(said.contains(line), "{said}");
    }
    assert!((cook.joint(MIDDLE) - 0.48).abs() < 0.01);
    let moved = |cook: &Cook, by: f64| {
        for (name, before) in things.iter().zip(&before) {
            let expected = nalgebra::Translation3::new(-by, 0.0, 0.0) * before;
            let now = cook.pose(name);
            assert!(distance_between(&expected, &now) < 0.01, "{name}");
            assert!(angle_between(&expected, &now) < 5f64.to_radians(), "{name}");
        }
    };
    moved(&cook, 0.48);
    assert_eq!(
        cook.done("(open-p :sink-area-left-middle-drawer-main)"),
        "T\n"
    );
    // Again, nothing happens.
    let now = cook.session.simulation().now();
    cook.done("(go-open :sink-area-left-middle-drawer-main)");
    assert_eq!(cook.session.simulation().now(), now, "no motion");
    cook.done("(go-close :sink-area-left-middle-drawer-main)");
    assert!(cook.joint(MIDDLE).abs() < 0.01);
    moved(&cook, 0.0);
    assert!(cook.parked());
    cook.assert_no_overlap();
}

/// Lifted as on a table, it would hit the board above.
#[test]
fn something_between_two_boards_is_taken_out_and_put_back() {
    let mut cook = cook();
    cook.done(
        "(defvar *board* (let ((?in (an object (urdf-name oven-area-area-right-drawer-main)
                                               (part-of kitchen))))
                           (a location (in ?in) (level 3))))
         (defvar *milk* (an object (type milk)))
         (btr-utils:spawn-object 'milk-1 :milk
                                 :pose (let ((?in (an object
                                                      (urdf-name oven-area-area-right-drawer-main)
                                                      (part-of kitchen)))
                                             (?for *milk*))
                                         (desig:reference
                                          (a location (in ?in) (level 3) (for ?for)))))",
    );
    let stood = cook.pose("MILK-1").translation.z;
    cook.done(
        "(with-simulated-robot
           (let* ((?milk *milk*)
                  (?board *board*)
                  (?island (an object (urdf-name kitchen-island-surface) (part-of kitchen)))
                  (?to (a location (on ?island) (for ?milk))))
             (perform (an action (type transporting) (object ?milk) (location ?board)
                          (target ?to)))))",
    );
    assert_eq!(
        cook.done("(pp-plans::support-of 'milk-1)").trim(),
        "\"kitchen_island_surface\""
    );
    assert!(cook.joint("oven_area_area_right_drawer_joint").abs() < 0.01);
    cook.done(
        "(with-simulated-robot
           (let* ((?milk *milk*)
                  (?drawer (an object (urdf-name oven-area-area-right-drawer-main)
                                      (part-of kitchen)))
                  (?to (a location (in ?drawer) (level 3) (for ?milk))))
             (perform (an action (type transporting) (object ?milk) (target ?to)))))",
    );
    assert!((cook.pose("MILK-1").translation.z - stood).abs() < 0.005);
    assert!(cook.joint("oven_area_area_right_drawer_joint").abs() < 0.01);
    cook.assert_no_overlap();
}

#[test]
fn a_hand_lifts_only_as_high_as_there_is_room() {
    let mut cook = cook();
    let lifts = |cook: &mut Cook, z: f64| {
        cook.done(&format!(
            "(btr-utils:kill-all-objects)
             (move-kitchen-joint :joint-name \"oven_area_area_right_drawer_joint\"
                                 :joint-angle 0.48)
             (btr-utils:spawn-object 'milk-1 :milk :pose '((1.0 1.48 {z}) (0 0 0 1)))"
        ));
        let shown = cook.done(
            "(destructuring-bind (pregrasp second-pregrasp grasp lift second-lift)
                 (pp-plans::grasping-poses
                  (desig:make-designator :object
                    `((:type :milk) (:name milk-1)
                      (:pose ((:pose-in-map ,(btr-utils:object-pose 'milk-1))))))
                  :left :left-side)
               (declare (ignore second-pregrasp))
               (flet ((z (pose) (cl-tf:z (cl-tf:origin pose)))
                      (y (pose) (cl-tf:y (cl-tf:origin pose))))
                 (mapcar (lambda (metres) (round (* 100 metres)))
                         (list (- (z pregrasp) (z grasp)) (- (z lift) (z grasp))
                               (- (z second-lift) (z grasp)) (- (y second-lift) (y grasp))))))",
        );
        let numbers = shown.split(['(', ')', ' ', '\n']);
        let numbers = numbers.filter_map(|n| n.parse::<i64>().ok());
        numbers.collect::<Vec<_>>()
    };
    // Between boards 6 cm up and straight out to its left, else as high as always.
    let [between, above] = [0.93, 1.26].map(|z| lifts(&mut cook, z));
    assert_eq!(above, [15, 15, 15, 0]);
    assert_eq!(between[..3], [6, 6, 6]);
    assert!((20..35).contains(&between[3]), "{between:?}");
}

#[test]
fn the_fridge_is_opened_wide_and_closed() {
    let mut cook = cook();
    cook.done("(go-open 'iai-fridge-main 1.3)");
    assert!((cook.joint("iai_fridge_door_joint") - 1.3).abs() < 0.035);
    assert_eq!(
        cook.done("(cut:lazy-car (coe:holds '(cpoe:container-state :iai-fridge-door :open)))"),
        "NIL\n"
    );
    cook.done("(go-close 'iai-fridge-door)");
    assert!(cook.joint("iai_fridge_door_joint").abs() < 0.035);
    assert_eq!(
        cook.done("(coe:holds '(cpoe:container-state :iai-fridge-door :open))"),
        "NIL\n"
    );
    cook.assert_no_overlap();
}

#[test]
fn a_goal_that_holds_makes_no_motion() {
    let mut cook = cook();
    let before = cook.session.simulation().now();
    cook.done(
        "(with-simulated-robot
           (let ((?drawer (an object (type drawer) (urdf-name fridge-area-lower-drawer-main))))
             (perform (an action (type sealing) (location (a location (in ?drawer)))
                          (goal (cpoe:container-state ?drawer :closed))))))",
    );
    assert_eq!(cook.session.simulation().now(), before);
}

#[test]
fn a_jammed_drawer_is_told_at_once_and_nothing_moves() {
    let mut cook = cook();
    cook.done(
        "(btr-utils:spawn-object 'box-1 :breakfast-cereal :pose '((0.95 1.1 0.15) (0 0 0 1)))",
    );
    let before = cook.pose("BOX-1");
    let now = cook.session.simulation().now();
    let report = cook.fails(
        "ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED",
        "(open-it :sink-area-left-bottom-drawer-main)",
    );
    assert_eq!(
        report,
        "sink_area_left_bottom_drawer_main_joint is at 0.000 and cannot be moved past 0.240: \
         sink_area_left_bottom_drawer_main would run into BOX-1"
    );
    assert_eq!(cook.session.simulation().now(), now);
    assert!(cook.distance("BOX-1", &before) < 1e-3);
    // As far as there is room, it opens.
    cook.done("(go-open :sink-area-left-bottom-drawer-main 0.15)");
    assert!((cook.joint("sink_area_left_bottom_drawer_main_joint") - 0.15).abs() < 0.01);
    assert!(cook.distance("BOX-1", &before) < 0.01);
    cook.assert_no_overlap();
}

#[test]
fn what_cannot_be_opened_is_told_in_one_error() {
    let mut cook = cook();
    for (object, wanted) in [
        (
            "(type drawer) (urdf-name sink-area-left-uper-drawer-main)",
            "did you mean sink-area-left-upper-drawer-main?",
        ),
        (
            "(type counter-top) (urdf-name kitchen-island-surface)",
            "it is no drawer or door with a handle",
        ),
        ("(type drawer)", "it does not say which one it is"),
        ("(type bottle) (name bottle-1)", "bottle-1 is an object"),
    ] {
        cook.done("(btr-utils:spawn-object 'bottle-1 :bottle :pose '((1.45 0.7 0.96) (0 0 0 1)))");
        for kind in ["opening", "closing"] {
            let action = format!(
                "(perform (an action (type {kind}) (arm left) (object (an object {object}))))"
            );
            let report = cook.fails("SIMPLE-ERROR", &action);
            assert!(report.contains(wanted), "{report}");
        }
    }
    let report = cook.fails(
        "DESIGNATOR-REFERENCE-FAILURE",
        "(perform (a motion (type pulling) (arm left)))",
    );
    assert!(report.contains("distance"), "{report}");
}

#[test]
fn full_hands_open_nothing() {
    let mut cook = Cook::at_table_with_bottle();
    cook.done(FUNCTIONS);
    cook.take_bottle();
    let before = cook.session.simulation().now();
    let report = cook.fails(
        "MANIPULATION-GOAL-NOT-REACHED",
        "(let ((?drawer (an object (urdf-name fridge-area-lower-drawer-main))))
           (perform (an action (type accessing) (arm right) (location (a location (in ?drawer))))))",
    );
    assert_eq!(report, "No hand is free: right holds bottle-1.");
    assert_eq!(cook.session.simulation().now(), before);
}

#[test]
fn moving_a_kitchen_joint_takes_along_what_is_in_it() {
    let mut cook = cook();
    cook.done("(put-in 'spoon-1 :spoon :sink-area-left-upper-drawer-main)");
    let before = cook.pose("SPOON-1");
    let set = |cook: &mut Cook, angle: f64| {
        cook.done(&format!(
            "(move-kitchen-joint :joint-name \"sink_area_left_upper_drawer_main_joint\"
                                 :joint-angle {angle})"
        ));
    };
    for angle in [0.4, 0.0, 0.48, 0.2] {
        set(&mut cook, angle);
        let expected = nalgebra::Translation3::new(-angle, 0.0, 0.0) * before;
        assert!(cook.distance("SPOON-1", &expected) < 1e-3, "{angle}");
    }
}

#[test]
fn a_spoon_is_taken_out_of_a_closed_drawer_which_is_closed_again() {
    let mut cook = cook();
    cook.done("(put-in 'spoon-1 :spoon :sink-area-left-upper-drawer-main)");
    let transport = |kind: &str| {
        format!(
            "(with-simulated-robot
               (let ((?pose (make-pose \"map\" '((-0.78 1.5 0.87) (0 0 0 1))))
                     (?drawer (an object (urdf-name sink-area-left-upper-drawer-main))))
                 (perform (an action (type transporting) (object (an object (type {kind})))
                              (location (a location (in ?drawer)))
                              (target (a location (pose ?pose)))))))"
        )
    };
    cook.done(&transport("spoon"));
    let at = cook.pose("SPOON-1").translation;
    assert!(
        (at.x + 0.78).abs() < 0.05 && (at.y - 1.5).abs() < 0.05,
        "{at}"
    );
    let upper = "sink_area_left_upper_drawer_main_joint";
    assert!(cook.joint(upper).abs() < 0.01);
    // Also if there is no such thing in it.
    let (_, condition) = cook.say(&transport("fork")).unwrap_err();
    assert!(condition.contains("SEARCHING-FAILED"), "{condition}");
    assert!(cook.joint(upper).abs() < 0.01);
    cook.assert_no_overlap();
}

#[test]
fn a_spoon_is_put_into_a_closed_drawer() {
    let mut cook = cook();
    cook.done("(btr-utils:spawn-object 'spoon-1 :spoon :pose '((-0.78 1.5 0.87) (0 0 0 1)))");
    cook.done(
        "(with-simulated-robot
           (let ((?island (an object (urdf-name kitchen-island-surface)))
                 (?drawer (an object (urdf-name sink-area-left-middle-drawer-main))))
             (perform (an action (type transporting) (object (an object (type spoon)))
                          (location (a location (on ?island)))
                          (target (a location (in ?drawer)))))))",
    );
    let at = cook.pose("SPOON-1").translation;
    assert!(at.x > 1.26 && (0.55..1.23).contains(&at.y), "{at}");
    assert!((0.43..0.46).contains(&at.z), "{at}");
    assert!(cook.joint(MIDDLE).abs() < 0.01);
    cook.assert_no_overlap();
}

#[test]
fn a_search_by_itself_closes_what_it_opens_and_fetching_opens_it_again() {
    let mut cook = cook();
    cook.done("(put-in 'spoon-1 :spoon :sink-area-left-upper-drawer-main)");
    let upper = "sink_area_left_upper_drawer_main_joint";
    cook.done(
        "(defparameter *spoon* (an object (type spoon)))
         (defun search-in (?object ?name)
           (with-simulated-robot
             (let ((?drawer (an object (urdf-name ?name))))
               (perform (an action (type searching) (object ?object)
                            (location (a location (in ?drawer))))))))
         (search-in *spoon* :sink-area-left-upper-drawer-main)",
    );
    assert!(cook.joint(upper).abs() < 0.01);
    assert_eq!(
        cook.done("(desig-prop-value (current-desig *spoon*) :name)"),
        "SPOON-1\n"
    );
    cook.done(
        "(with-simulated-robot
           (let ((?spoon *spoon*))
             (perform (an action (type fetching) (object ?spoon)))))",
    );
    assert!(cook.joint(upper).abs() < 0.01);
    let held = cook.done("(mapcan #'pp-plans::objects-in-hand '(:left :right))");
    assert_eq!(held, "(SPOON-1)\n");
    // So does delivering, with the other hand.
    cook.done(
        "(with-simulated-robot
           (let ((?spoon *spoon*)
                 (?drawer (an object (urdf-name sink-area-left-middle-drawer-main))))
             (perform (an action (type delivering) (object ?spoon)
                          (target (a location (in ?drawer)))))))",
    );
    assert!(cook.joint(MIDDLE).abs() < 0.01);
    assert!((0.43..0.46).contains(&cook.pose("SPOON-1").translation.z));
    // Where it is now is known, too.
    cook.done(
        "(with-simulated-robot
           (let ((?spoon *spoon*))
             (perform (an action (type fetching) (object ?spoon)))))",
    );
    assert!(cook.joint(MIDDLE).abs() < 0.01);
    cook.assert_no_overlap();
}

#[test]
fn a_search_behind_what_is_jammed_names_what_is_in_the_way() {
    let mut cook = cook();
    cook.done(
        "(btr-utils:spawn-object 'box-1 :breakfast-cereal :pose '((0.95 1.1 0.15) (0 0 0 1)))",
    );
    let before = cook.pose("BOX-1");
    let report = cook.fails(
        "ENVIRONMENT-MANIPULATION-GOAL-NOT-REACHED",
        "(let ((?drawer (an object (urdf-name sink-area-left-bottom-drawer-main))))
           (perform (an action (type searching) (object (an object (type cup)))
                        (location (a location (in ?drawer))))))",
    );
    assert!(report.contains("would run into BOX-1"), "{report}");
    assert!(cook.distance("BOX-1", &before) < 0.01);
    assert!(cook.joint("sink_area_left_bottom_drawer_main_joint").abs() < 0.01);
}

/// Brings a thing from a closed container to the island; the container is closed again.
fn brought_from(furniture: &str, kind: &str, joint: &str) {
    let mut cook = cook();
    cook.done(&format!("(put-in 'thing :{kind} :{furniture})"));
    cook.done(&format!(
        "(with-simulated-robot
           (let ((?pose (make-pose \"map\" '((-0.8 1.5 0.95) (0 0 1 0))))
                 (?container (an object (urdf-name {furniture}))))
             (perform (an action (type transporting) (object (an object (type {kind})))
                          (location (a location (in ?container)))
                          (target (a location (pose ?pose)))))))"
    ));
    let at = cook.pose("THING").translation;
    assert!(
        (at.x + 0.8).abs() < 0.05 && (at.y - 1.5).abs() < 0.05 && at.z > 0.86,
        "{at}"
    );
    assert!(cook.joint(joint).abs() < 0.035);
    cook.assert_no_overlap();
}

#[test]
fn milk_is_brought_from_the_fridge() {
    brought_from("iai-fridge-main", "milk", "iai_fridge_door_joint");
}

#[test]
fn a_cup_is_brought_from_a_drawer_of_the_island() {
    brought_from(
        "kitchen-island-left-upper-drawer-main",
        "cup",
        "kitchen_island_left_upper_drawer_main_joint",
    );
}

/// In the middle, the fingers would touch the front of the drawer.
#[test]
fn a_spoon_across_a_drawer_close_to_its_front_is_taken_nearer_to_its_end() {
    let mut cook = cook();
    cook.done(
        "(btr-utils:spawn-object 'spoon-1 :spoon
           :pose '((1.34157 0.89745 0.737) (0 0 0.80027 0.59962)))
         (with-simulated-robot
           (let ((?pose (make-pose \"map\" '((-0.9 1.66 0.865) (0 0 0 1))))
                 (?drawer (an object (urdf-name sink-area-left-upper-drawer-main)
                             (part-of kitchen))))
             (perform (an action (type transporting)
                          (object (an object (type spoon) (name spoon-1)))
                          (location (a location (in ?drawer)))
                          (target (a location (pose ?pose)))))))",
    );
    let t = cook.pose("SPOON-1").translation;
    assert!((t.x + 0.9).hypot(t.y - 1.66) < 0.02, "{t}");
    assert!(cook.joint("sink_area_left_upper_drawer_main_joint").abs() < 0.01);
    cook.assert_no_overlap();
}

/// A bottle that stands too high in an open drawer would meet the one above, or the frame, when that is closed.
#[test]
fn a_drawer_is_offered_only_for_what_it_can_be_closed_over() {
    let mut cook = cook();
    cook.done(
        "(defun places (?type ?name count)
           (let* ((?for (an object (type ?type)))
                  (?in (an object (urdf-name ?name) (part-of kitchen)))
                  (place (a location (in ?in) (for ?for))))
             (loop repeat count
                   while place
                   collect (desig:reference place)
                   do (setf place (desig:next-solution place)))))",
    );
    let open = |cook: &mut Cook, joint: &str| {
        cook.done(&format!(
            "(btr-utils:kill-all-objects)
             (move-kitchen-joint :joint-name \"{joint}\" :joint-angle 0.48)"
        ));
    };
    for (name, joint) in [
        (
            "sink_area_left_upper_drawer_main",
            "sink_area_left_upper_drawer_main_joint",
        ),
        (
            "oven_area_area_middle_upper_drawer_main",
            "oven_area_area_middle_upper_drawer_main_joint",
        ),
    ] {
        open(&mut cook, joint);
        let report = cook.fails("DESIGNATOR-ERROR", &format!("(places :bottle :{name} 1)"));
        assert!(report.contains("when that is closed"), "{report}");
    }
    open(&mut cook, MIDDLE);
    cook.done("(defparameter *found* (places :bottle :sink_area_left_middle_drawer_main 12))");
    assert_eq!(cook.done("(length *found*)"), "12\n");
    for number in 0..12 {
        open(&mut cook, MIDDLE);
        cook.done(&format!(
            "(btr-utils:spawn-object 'thing :bottle :pose (nth {number} *found*))
             (move-kitchen-joint :joint-name \"{MIDDLE}\" :joint-angle 0)"
        ));
    }
}
