//! Two hands on one object: both truly hold it, the loop is kept in every step, and what stands on it stays.

use robotics::motion::{GREATEST_STRAIN, strain};
use robotics::robot::Side;

use super::cook::Cook;

/// What a text prints, or the report of what ended it.
fn said(cook: &mut Cook, text: &str) -> String {
    cook.say(text).unwrap_or_else(|(report, _)| report)
}

/// A tray on the table with three cups on it, and how it is carried.
const TRAY: &str = "
  (btr-utils:spawn-object 'tray-1 :tray :pose '((-1.5 -0.95 0.82) (0 0 0 1)))
  (btr-utils:spawn-object 'cup-1 :cup :pose '((-1.58 -0.95 0.9) (0 0 0 1)))
  (btr-utils:spawn-object 'cup-2 :cup :pose '((-1.42 -0.95 0.9) (0 0 0 1)))
  (btr-utils:spawn-object 'cup-3 :cup :pose '((-1.5 -0.87 0.9) (0 0 0 1)))
  (defparameter *table* (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))
  (defparameter *island* (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen)))))
  (defparameter *strain* 0)
  (defparameter *tilt* 0)
  (defparameter *lag* 0)
  (defun watch-tray ()
    (loop
      (cpl:sleep 1/240)
      (let ((strain (btr::%strain)))
        (when strain
          (let ((up (cl-transforms:rotate (cl-tf:orientation (btr-utils:object-pose 'tray-1))
                                          (cl-tf:make-3d-vector 0 0 1))))
            (setf *strain* (max *strain* strain)
                  *tilt* (max *tilt* (acos (min 1 (cl-tf:z up))))))))))
  (defparameter *tray*
    (let ((?table *table*))
      (with-simulated-robot
        (perform (an action (type searching) (object (an object (type tray))) (location ?table))))))";

/// The tray is carried from the table to the island.
const CARRY: &str = "
  (with-simulated-robot
    (perform (an action (type transporting)
                 (object (an object (type tray) (name tray-1)))
                 (location (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))
                 (target (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen))))))))";

fn with_tray() -> Cook {
    let mut cook = Cook::new();
    cook.done(TRAY);
    cook
}

fn number(cook: &mut Cook, form: &str) -> f64 {
    let said = cook.done(form);
    let said = said.trim().replace('d', "e");
    said.parse().unwrap_or_else(|_| panic!("{form}: {said}"))
}

/// Where the cups are on the tray (m).
fn cups(cook: &Cook) -> Vec<[f64; 3]> {
    let world = cook.session.simulation().world();
    let tray = world.object_pose("TRAY-1").unwrap();
    let cups = ["CUP-1", "CUP-2", "CUP-3"];
    let places = cups.map(|cup| tray.inverse() * world.object_pose(cup).unwrap());
    places.map(|at| at.translation.vector.into()).to_vec()
}

#[test]
fn both_hands_carry_a_tray_with_cups_from_the_table_to_the_island() {
    let mut cook = with_tray();
    let before = cups(&cook);
    cook.done(
        "(with-simulated-robot
           (let ((?tray *tray*))
             (cpl:pursue (perform (an action (type fetching) (object ?tray))) (watch-tray))))",
    );
    let world = cook.session.simulation().world();
    for side in Side::BOTH {
        assert_eq!(robotics::motion::held_objects(world, side), ["TRAY-1"]);
    }
    assert!(strain(world).is_some_and(|strain| strain < 1e-3));
    cook.done(
        "(with-simulated-robot
           (let ((?tray *tray*) (?island *island*))
             (cpl:pursue (perform (an action (type delivering) (object ?tray) (target ?island))) (watch-tray))))",
    );
    assert!(number(&mut cook, "(float *strain* 1d0)") <= GREATEST_STRAIN);
    let tilt = number(&mut cook, "(float *tilt* 1d0)");
    assert!((1e-6..0.0873).contains(&tilt), "{tilt}");
    for (then, now) in before.iter().zip(cups(&cook)) {
        let moved = (0..3)
            .map(|i| (then[i] - now[i]).powi(2))
            .sum::<f64>()
            .sqrt();
        assert!(moved < 0.02, "{moved}");
    }
    let said =
        cook.done("(list (on-surface-p 'tray-1 'kitchen-island-surface) (nothing-on-floor-p))");
    assert!(said.contains("(T T)"), "{said}");
}

/// Hands found no room between the cups, then hung so far askew that they could put the tray down nowhere.
#[test]
fn a_tray_whose_cups_stand_along_its_walls_is_carried_too() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'tray-1 :tray :pose '((-1.309 -0.948 0.72) (0 0 -0.7121 0.7021)))
         (btr-utils:spawn-object 'cup-1 :cup :pose '((-1.228 -1.095 0.77) (0 0 -0.539 0.842)))
         (btr-utils:spawn-object 'cup-2 :cup :pose '((-1.233 -0.958 0.77) (0 0 -1 0.019)))
         (btr-utils:spawn-object 'cup-3 :cup :pose '((-1.376 -1.096 0.77) (0 0 -0.288 0.958)))",
    );
    let before = cups(&cook);
    cook.done(CARRY);
    for (then, now) in before.iter().zip(cups(&cook)) {
        assert!(
            (0..3).all(|i| (then[i] - now[i]).abs() < 0.02),
            "{then:?} {now:?}"
        );
    }
    let said = cook.done("(on-surface-p 'tray-1 'kitchen-island-surface)");
    assert_eq!(said.trim(), "T");
}

#[test]
fn where_cups_leave_no_room_for_hands_it_says_so_before_anything_is_touched() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'tray-1 :tray :pose '((-1.5 -0.95 0.72) (0 0 0 1)))
         (defparameter *tray*
           (with-simulated-robot
             (perform (an action (type searching)
                          (object (an object (type tray)))
                          (location (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))))))
         (loop for (x y) in '((0.15 0.12) (0.05 0.12) (-0.05 0.12) (-0.15 0.12) (0.15 0) (-0.15 0)
                              (0.15 -0.12) (0.05 -0.12) (-0.05 -0.12) (-0.15 -0.12))
               for number from 1
               do (btr-utils:spawn-object (intern (format nil \"CUP-~a\" number)) :cup
                                          :pose (list (list (- x 1.5) (- y 0.95) 0.77) '(0 0 0 1))))",
    );
    let before = cups(&cook);
    let said = cook.done(
        "(handler-case
             (with-simulated-robot
               (let ((?tray *tray*)) (perform (an action (type fetching) (object ?tray)))))
           (serious-condition (failure) (format t \"~a\" failure)))",
    );
    for why in [
        "from no place do they get to both sides of it",
        "TRAY-1 carries CUP-1, ",
        "which would fall",
    ] {
        assert!(said.contains(why), "{said}");
    }
    assert_eq!(before, cups(&cook));
}

#[test]
fn one_hand_alone_moves_nothing_that_both_hold_and_an_opened_one_leaves_it_to_the_other() {
    let mut cook = with_tray();
    cook.done(
        "(with-simulated-robot
           (let ((?tray *tray*)) (perform (an action (type fetching) (object ?tray)))))",
    );
    for motion in [
        "(perform (a motion (type moving-tcp) (collision-mode allow-hand)
           (left-target (a location (pose ?there)))))",
        "(perform (an action (type parking-arms)))",
    ] {
        let said = said(&mut cook, &format!(
            "(with-simulated-robot
               (let ((?there (pp-plans::raise-pose (pp-plans::hand-pose :left) 0.03))) ?there {motion}))"
        ));
        let world = cook.session.simulation().world();
        assert!(strain(world).is_some_and(|strain| strain < 1e-3), "{said}");
    }
    cook.done("(with-simulated-robot (perform (an action (type releasing) (gripper left) (position 0.045))))");
    let said =
        cook.done("(list (pp-plans::objects-in-hand :left) (pp-plans::objects-in-hand :right))");
    assert!(said.contains("(NIL (TRAY-1))"), "{said}");
}

#[test]
fn what_is_too_heavy_for_one_arm_is_taken_with_both_and_what_is_too_heavy_for_both_is_refused() {
    for (mass, wanted) in [
        ("2.5", "it weighs 2.5 kg, and one arm may carry 1.8 kg"),
        ("4.5", "both arms may carry 3.6 kg"),
    ] {
        let mut cook = Cook::new();
        let said = said(&mut cook, &format!(
            "(progn
               (btr-utils:spawn-object 'tray-1 :tray :mass {mass} :pose '((-1.5 -0.95 0.82) (0 0 0 1)))
               (with-simulated-robot
                 (perform (an action (type fetching) (object (an object (type tray)))
                              ))))"
        ));
        let both = cook.done("(pp-plans::held-by-both-p 'tray-1)");
        assert!(said.contains(wanted), "{said}");
        assert_eq!(both.contains('T'), mass == "2.5", "{said}");
    }
}

/// A heavy pot full of soup on the table, its handles beside it as seen from there, in both hands.
const POT: &str = "
  (btr-utils:spawn-object 'pot-1 :pot :mass 3.3 :pose '((-1.5 -0.95 0.9) (0 0 0.7071 0.7071)))
  (set-content 'pot-1 :soup 4000)
  (defparameter *table* (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))
  (defparameter *island* (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen)))))
  (with-simulated-robot
    (let ((?table *table*))
      (defparameter *pot*
        (perform (an action (type searching) (object (an object (type pot))) (location ?table)))))
    (let ((?pot *pot*))
      (perform (an action (type fetching) (object ?pot)))))";

#[test]
fn a_pot_of_soup_is_carried_by_its_handles_and_nothing_is_spilled() {
    let mut cook = Cook::new();
    cook.done(POT);
    let world = cook.session.simulation().world();
    let pot = world.object_pose("POT-1").unwrap();
    for side in Side::BOTH {
        assert_eq!(robotics::motion::held_objects(world, side), ["POT-1"]);
    }
    let height = pot.translation.z;
    assert!(height > 0.9, "{height}");
    cook.done(
        "(with-simulated-robot
           (let ((?island *island*) (?pot *pot*))
             (perform (an action (type delivering) (object ?pot) (target ?island)))))",
    );
    let said =
        cook.done("(list (on-surface-p 'pot-1 'kitchen-island-surface) (spilled-from 'pot-1))");
    assert!(said.contains("(T 0.0d0)"), "{said}");
}

#[test]
fn hands_that_pull_at_a_pot_from_both_sides_feel_it() {
    let mut cook = Cook::new();
    cook.done(POT);
    let at_rest = number(&mut cook, "(first (btr::%force-between-hands))");
    assert!(at_rest < 2.0, "{at_rest} N");
    // One hand goes a millimetre away from the other one.
    cook.done(
        "(with-simulated-robot
           (let* ((left (pp-plans::hand-pose :left))
                  (way (cl-tf:v- (cl-tf:origin left) (cl-tf:origin (pp-plans::hand-pose :right))))
                  (?left (cl-tf:make-pose-stamped \"map\" 0.0
                                                  (cl-tf:v+ (cl-tf:origin left)
                                                            (cl-tf:v* way (/ 0.001 (cl-transforms:v-norm way))))
                                                  (cl-tf:orientation left))))
             (perform (a motion (type moving-tcp) (collision-mode allow-hand)
                        (left-target (a location (pose ?left)))))
             (cpl:sleep 1)))",
    );
    let pulled = number(&mut cook, "(first (btr::%force-between-hands))");
    assert!(pulled > at_rest + 2.0, "{pulled} N, {at_rest} N");
    let greatest = number(&mut cook, "(second (btr::%force-between-hands))");
    assert!(greatest >= pulled, "{greatest} N");
}
