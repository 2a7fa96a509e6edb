//! Refusals that need no search: what rules everything out is found before.

use super::cook::Cook;

/// The number of candidates that a report tells of: `63 of 63 candidates were rejected`.
fn candidates(report: &str) -> usize {
    let words: Vec<&str> = report.split_whitespace().collect();
    let at = words.iter().position(|word| word.starts_with("candidates"));
    let number = at.and_then(|at| words.get(at - 3)?.trim_matches('(').parse().ok());
    number.unwrap_or_else(|| panic!("no candidates are told of: {report}"))
}

/// Tall boxes stand on all sides of a cup, so near to it that neither fingers nor a forearm have room. The search
/// used to reject 131,390 places to stand, one after another.
#[test]
fn a_cup_that_leaves_no_hand_any_room_is_refused_without_a_search() {
    let mut cook = Cook::new();
    cook.done(
        "(spawn-object '((-0.9 1.4 0.96) (0 0 0 1)) :cup 'cup-1)
         (loop for (x y c s) in '((-0.82 1.4 1 0) (-0.98 1.4 1 0)
                                  (-0.9 1.52 0.70711 0.70711) (-0.9 1.28 0.70711 0.70711))
               for number from 1
               do (spawn-object (list (list x y 0.97) (list 0 0 s c)) :breakfast-cereal
                                (intern (format nil \"BOX-~a\" number))))",
    );
    cook.fails(
        "FETCHING-FAILED",
        "(perform (an action (type transporting) (object (an object (type cup) (name cup-1)))
                    (location (a location (on (an object (urdf-name kitchen-island-surface)
                                                         (part-of kitchen)))))
                    (target (a location (on (an object (urdf-name table-area-main)
                                                       (part-of kitchen)))))))",
    );
    let explained = cook.done("(explain)");
    assert!(
        explained.contains("no room for a hand at CUP-1"),
        "{explained}"
    );
    assert!(candidates(&explained) < 20_000, "{explained}");
}

/// It used to be picked up however that was possible, carried there, and put back.
#[test]
fn milk_whose_target_leaves_no_hand_any_room_is_left_where_it_is() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'milk-1 :milk :pose '((-1.6 -0.9 0.85) (0 0 0 1)))
         (loop for (x y c s) in '((-0.81 1.4 0.70711 0.70711) (-0.99 1.4 0.70711 0.70711)
                                  (-0.9 1.51 1 0) (-0.9 1.29 1 0))
               for number from 1
               do (spawn-object (list (list x y 0.97) (list 0 0 s c)) :breakfast-cereal
                                (intern (format nil \"BOX-~a\" number))))",
    );
    let stood = cook.pose("MILK-1");
    let report = cook.fails(
        "FETCHING-FAILED",
        "(let ((?pose (make-pose \"map\" '((-0.9 1.4 0.985) (0 0 0 1)))))
           (perform (an action (type transporting) (object (an object (type milk) (name milk-1)))
                      (location (a location (on (an object (urdf-name table-area-main)
                                                           (part-of kitchen)))))
                      (target (a location (pose ?pose))))))",
    );
    let wanted = "milk-1 could not be fetched: none of its grasps suits its target: ";
    assert!(report.starts_with(wanted), "{report}");
    assert!(report.contains(" would touch BOX-"), "{report}");
    assert!(cook.distance("MILK-1", &stood) < 0.001);
}

/// Lifts are along the axes of an object: a lying carton used to be dragged along the table, gripped and let go
/// again from one place after another.
#[test]
fn a_lying_carton_is_lifted_straight_up() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'milk-1 :milk
           :pose '((-1.7456 -0.9181 0.84) (0.60163 0.37153 0.37153 0.60163)))",
    );
    let printed = cook.done(
        "(with-simulated-robot
           (perform (an action (type transporting) (object (an object (type milk) (name milk-1)))
                      (location (a location (on (an object (urdf-name table-area-main)
                                                           (part-of kitchen)))))
                      (target (a location (on (an object (urdf-name kitchen-island-surface)
                                                         (part-of kitchen))))))))",
    );
    assert!(!printed.contains("not lifted off"), "{printed}");
    let lifts = printed.matches("Lifting").count();
    assert!(lifts <= 2, "{lifts} lifts: {printed}");
    let support = cook.done("(pp-plans::support-of 'milk-1)");
    assert!(support.contains("kitchen_island"), "{support}");
}

#[test]
fn fetching_gives_up_after_some_places_to_stand_and_says_so() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :fd-plans)
         (setf *max-stands* 3)
         (defparameter *tried* 0)
         (btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))
         (system:without-package-locks
           (defun pick-up (object arms grasps target)
             (declare (ignore arms grasps target))
             (incf *tried*)
             (cpl:fail 'object-unreachable :object object :description \"as the test wants it\")))
         (in-package :pp-tut)",
    );
    let report = cook.fails(
        "FETCHING-FAILED",
        "(let ((?bottle (an object (type bottle))))
           (perform (an action (type searching) (object ?bottle)))
           (perform (an action (type fetching) (object ?bottle))))",
    );
    let wanted =
        "bottle-1 could not be fetched from any of 3 places to stand; no others were tried";
    assert!(report.starts_with(wanted), "{report}");
    assert_eq!(cook.done("fd-plans::*tried*"), "3\n");
}
