//! Salting: what falls out of a shaker is what the world counts, into the vessel below or beside it.

use super::chores::{number, refused};
use super::cook::Cook;

/// A shaker, a bowl of soup and a cup on the island, seen from before it.
const ON_ISLAND: &str = "
  (btr-utils:spawn-object 'salt-1 :salt-shaker :pose '((-0.8 2.2 0.95) (0 0 0 1)))
  (btr-utils:spawn-object 'bowl-1 :bowl :pose '((-0.75 1.8 0.95) (0 0 0 1)))
  (btr-utils:spawn-object 'cup-1 :cup :pose '((-0.8 2.5 0.95) (0 0 0 1)))
  (btr-utils:spawn-object 'bottle-1 :bottle :pose '((-0.75 1.3 0.95) (0 0 0 1)))
  (set-content 'bowl-1 :soup 300)
  (defparameter *island* (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen)))))
  (defun seen (?type)
    (let ((?island *island*))
      (with-simulated-robot
        (perform (an action (type searching) (object (an object (type ?type))) (location ?island))))))
  (defparameter *salt* (seen :salt-shaker))
  (defparameter *bowl* (seen :bowl))
  (defparameter *cup* (seen :cup))
  (defparameter *bottle* (seen :bottle))";

fn at_island() -> Cook {
    let mut cook = Cook::new();
    cook.done(ON_ISLAND);
    cook
}

fn salting(keys: &str) -> String {
    format!(
        "(let ((?salt *salt*) (?bowl *bowl*) (?cup *cup*) (?bottle *bottle*))
           ?salt ?bowl ?cup ?bottle
           (perform (an action (type salting) {keys})))"
    )
}

#[test]
fn what_falls_out_of_a_shaker_gets_into_the_bowl_and_more_shakes_give_more() {
    let mut cook = at_island();
    cook.done("(set-content 'salt-1 :salt 60)");
    let mut salted = |shakes: u32| {
        cook.done(&format!(
            "(with-simulated-robot (defparameter *account* {}))",
            salting(&format!(
                "(object ?salt) (on-object ?bowl) (shakes {shakes})"
            ))
        ));
        number(&mut cook, "(getf *account* :salted)")
    };
    let (few, many) = (salted(2), salted(6));
    assert!(few >= 2.0 * 0.17 - 1e-6, "{few} ml");
    assert!(many >= 6.0 * 0.17 - 1e-6 && many > few, "{few} {many} ml");
    let left = number(&mut cook, "(second (content-of 'salt-1))");
    assert!((60.0 - left - few - many).abs() < 1e-6, "{left} ml");
    let soup = number(&mut cook, "(second (content-of 'bowl-1))");
    assert!((soup - 300.0 - few - many).abs() < 1e-6, "{soup} ml");
    // It has stayed in the hand, upright.
    assert_eq!(cook.done("(not (pp-plans::holder-of 'salt-1))"), "NIL\n");
    assert_eq!(cook.done("(upright-p 'salt-1)"), "T\n");
}

#[test]
fn what_is_shaken_beside_the_bowl_has_fallen_beside_it() {
    let mut cook = at_island();
    cook.done("(set-content 'salt-1 :salt 60)");
    cook.done(
        "(with-simulated-robot
           (let ((?salt *salt*))
             (perform (an action (type fetching) (object ?salt))))
           (let ((arm (pp-plans::holder-of 'salt-1)))
             (multiple-value-bind (way ?stand torso posture)
                 (funcall (fd-plans::ways-to-salt 'salt-1 arm (cl-tf:make-3d-vector -0.75 1.55 0.95)
                                                  (cons nil (pp-plans::stands-about -0.75 1.55))))
               (when ?stand
                 (perform (an action (type navigating) (location (a location (pose ?stand))))))
               (pp-plans::take-posture arm torso posture)
               (fd-plans::shake-along arm 'salt-1 way 2))))",
    );
    let beside = number(&mut cook, "(spilled-from 'salt-1)");
    assert!(beside >= 2.0 * 0.17 - 1e-6, "{beside} ml");
    let left = number(&mut cook, "(second (content-of 'salt-1))");
    assert!((60.0 - left - beside).abs() < 1e-6, "{left} ml");
    assert_eq!(number(&mut cook, "(second (content-of 'bowl-1))"), 300.0);
}

#[test]
fn salting_is_refused_before_the_first_motion() {
    let mut cook = at_island();
    for (class, keys, wanted) in [
        (
            "TOOL-MISSING",
            "(on-object ?bowl)",
            "There is nothing for salting: both hands are empty, and no tool is given.",
        ),
        (
            "WRONG-TOOL",
            "(object ?cup) (on-object ?bowl)",
            "CUP-1 cannot be used for salting: it is cup, and no shaker.",
        ),
        (
            "WRONG-TOOL",
            "(object ?salt) (on-object ?bottle)",
            "BOTTLE-1 is no open vessel: nothing can be salted in it.",
        ),
        (
            "CONTAINER-EMPTY",
            "(object ?salt) (on-object ?bowl)",
            "There is nothing in SALT-1: 5 shakes take 0.9 ml.",
        ),
        (
            "ERROR",
            "(object ?salt) (on-object ?bowl) (shakes 0)",
            "A number of shakes is a whole number between 1 and 99; 0 is not.",
        ),
        (
            "ERROR",
            "(object ?salt) (on-object ?bowl) (shakes 2.5)",
            "A number of shakes is a whole number between 1 and 99; 2.5 is not.",
        ),
    ] {
        refused(&mut cook, class, &salting(keys), wanted);
    }
    cook.done("(set-content 'salt-1 :salt 0.3)");
    refused(
        &mut cook,
        "CONTAINER-EMPTY",
        &salting("(object ?salt) (on-object ?bowl)"),
        "There are only 0.3 ml in SALT-1: 5 shakes take 0.9 ml.",
    );
}

#[test]
fn a_shaker_loses_nothing_unless_it_is_shaken_upside_down() {
    let mut cook = at_island();
    cook.done("(set-content 'salt-1 :salt 60)");
    cook.done(
        "(with-simulated-robot
           (let ((?salt *salt*)) (perform (an action (type fetching) (object ?salt)))))",
    );
    assert_eq!(number(&mut cook, "(second (content-of 'salt-1))"), 60.0);
    // Lying, as it may be dropped.
    cook.done("(btr-utils:kill-object 'salt-1)");
    cook.done(
        "(btr-utils:spawn-object 'salt-1 :salt-shaker :pose '((-0.8 2.2 1.3) (0 0.7071 0 0.7071)))",
    );
    cook.done("(set-content 'salt-1 :salt 60)");
    cook.done("(btr:simulate btr:*current-bullet-world* 2)");
    assert_eq!(number(&mut cook, "(second (content-of 'salt-1))"), 60.0);
}
