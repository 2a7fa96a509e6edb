//! Chores with a tool in a hand: wiping a surface, cutting food, and holding while the other hand works.

use super::chores::{number, refused};
use super::cook::Cook;

/// A sponge on the island, seen from before it.
const WITH_SPONGE: &str = "
  (btr-utils:spawn-object 'sponge-1 :sponge :pose '((-0.8 2.6 0.95) (0 0 0 1)))
  (defparameter *island* (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen)))))
  (defun seen (?type)
    (let ((?island *island*))
      (with-simulated-robot
        (perform (an action (type searching) (object (an object (type ?type))) (location ?island))))))
  (defparameter *sponge* (seen :sponge))";

/// Bread on a board on the island, and a knife.
const WITH_BREAD: &str = "
  (btr-utils:spawn-object 'knife-1 :big-knife :pose '((-0.8 2.5 0.95) (0 0 0 1)))
  (btr-utils:spawn-object 'board-1 :cutting-board :pose '((-0.75 1.9 0.95) (0 0 0 1)))
  (btr-utils:spawn-object 'bread-1 :bread :pose '((-0.75 1.9 1.0) (0 0 0 1)))
  (defparameter *bread* (seen :bread))
  (defparameter *knife* (seen :big-knife))";

/// An action of wiping around a point of the island.
fn wiping(x: f64, y: f64, keys: &str) -> String {
    format!(
        "(let ((?pose (make-pose \"map\" '(({x} {y} 0.9) (0 0 0 1)))) (?sponge *sponge*))
           (perform (an action (type wiping) (surface kitchen-island-surface) (pose ?pose) {keys})))"
    )
}

fn with_sponge() -> Cook {
    let mut cook = Cook::new();
    cook.done(WITH_SPONGE);
    cook
}

fn with_bread() -> Cook {
    let mut cook = with_sponge();
    cook.done(WITH_BREAD);
    cook
}

#[test]
fn a_patch_is_wiped_around_a_cup_with_the_force_that_is_measured() {
    let mut cook = with_sponge();
    cook.done("(btr-utils:spawn-object 'cup-1 :cup :pose '((-0.8 1.9 0.95) (0 0 0 1)))");
    let before = cook
        .session
        .simulation()
        .world()
        .object_pose("CUP-1")
        .unwrap();
    cook.done(&format!(
        "(with-simulated-robot (defparameter *account* {}))",
        wiping(-0.75, 1.9, "(area (0.4 0.4)) (tool ?sponge)")
    ));
    assert!(number(&mut cook, "(getf *account* :share)") >= 0.95);
    assert!(number(&mut cook, "(getf *account* :in-range)") >= 0.9);
    let force = number(&mut cook, "(getf *account* :mean-force)");
    assert!((3.0..7.0).contains(&force), "{force} N");
    assert_eq!(cook.done("(getf *account* :left-out)"), "(CUP-1)\n");
    let after = cook
        .session
        .simulation()
        .world()
        .object_pose("CUP-1")
        .unwrap();
    let moved = (after.translation.vector - before.translation.vector).norm();
    assert!(moved < 0.005, "{moved} m");
    // More force is more force.
    cook.done(&format!(
        "(with-simulated-robot (setf *account* {}))",
        wiping(-0.75, 2.3, "(area (0.3 0.2)) (force 12)")
    ));
    let more = number(&mut cook, "(getf *account* :mean-force)");
    assert!((9.0..15.0).contains(&more), "{more} N");
}

#[test]
fn wiping_is_refused_before_the_first_motion() {
    let mut cook = with_sponge();
    cook.done(
        "(btr-utils:spawn-object 'cup-1 :cup :pose '((-0.8 1.3 0.95) (0 0 0 1)))
               (defparameter *cup* (seen :cup))",
    );
    refused(
        &mut cook,
        "TOOL-MISSING",
        &wiping(-0.75, 1.9, ""),
        "There is nothing for wiping: both hands are empty",
    );
    refused(
        &mut cook,
        "WRONG-TOOL",
        &format!("(let ((?cup *cup*)) {})", wiping(-0.75, 1.9, "(tool ?cup)")),
        "CUP-1 cannot be used for wiping",
    );
    refused(
        &mut cook,
        "ERROR",
        &wiping(-0.75, 1.9, "(tool ?sponge) (force 30)"),
        "A force for wiping is between 2 and 20 N; 30 is not.",
    );
    refused(
        &mut cook,
        "ERROR",
        &wiping(2.0, 1.9, "(tool ?sponge)"),
        "is not on kitchen-island-surface",
    );
    refused(
        &mut cook,
        "ERROR",
        &wiping(-0.75, 1.9, "(tool ?sponge) (area (0.4 -1))"),
        "An area is a list of its edges",
    );
    refused(
        &mut cook,
        "DESIGNATOR-REFERENCE-FAILURE",
        "(let ((?sponge *sponge*)) (perform (an action (type wiping) (tool ?sponge))))",
        "The action WIPING needs one of surface, pose.",
    );
    cook.done("(with-simulated-robot (let ((?sponge *sponge*)) (perform (an action (type fetching) (object ?sponge)))))");
    // Nobody reaches there.
    refused(
        &mut cook,
        "MANIPULATION-POSE-UNREACHABLE",
        "(let ((?pose (make-pose \"map\" '((-0.75 1.9 2.2) (0 0 0 1)))))
           (perform (an action (type wiping) (pose ?pose) (area (0.3 0.3)))))",
        "reaches only 0 %",
    );
}

#[test]
fn bread_becomes_pieces_of_the_same_volume_that_rest() {
    let mut cook = with_bread();
    cook.done("(snapshot 'whole)");
    let said = cook.done(
        "(with-simulated-robot
           (let ((?bread *bread*) (?knife *knife*))
             (perform (an action (type slicing) (object ?bread) (tool ?knife) (cuts 4) (slice-thickness 0.03)))))",
    );
    assert!(
        said.ends_with("(BREAD-1-1 BREAD-1-2 BREAD-1-3 BREAD-1-4 BREAD-1-5)\n"),
        "{said}"
    );
    let world = cook.session.simulation().world();
    assert!(world.object("BREAD-1").is_err());
    let pieces: Vec<_> = (1..=5)
        .map(|i| world.object(&format!("BREAD-1-{i}")).unwrap())
        .collect();
    let mass: f64 = pieces.iter().map(|piece| piece.mass()).sum();
    assert!((mass - 0.2).abs() < 1e-9, "{mass} kg");
    for piece in &pieces[..4] {
        let [thickness, width, height] = piece.size();
        assert!((thickness - 0.03).abs() < 0.002, "{thickness}");
        assert!((width - 0.0972).abs() < 1e-6 && (height - 0.065).abs() < 1e-6);
        assert_eq!(piece.type_name(), "bread-slice");
        // As heavy as its share of the loaf.
        let share = thickness / 0.2622;
        assert!((piece.mass() / 0.2 - share).abs() < 0.01, "{share}");
    }
    assert_eq!(pieces[4].type_name(), "bread");
    assert!(world.is_at_rest());
    // A slice is an object like others.
    assert_eq!(cook.done("(btr::%kind-p 'bread-1-1 :bread)"), "T\n");
    let slice = cook.done("(desig:desig-prop-value (seen :bread-slice) :type)");
    assert!(slice.ends_with(":BREAD-SLICE\n"), "{slice}");
    // The world before has no pieces, and the one after has them again.
    cook.done("(snapshot 'pieces)");
    cook.done("(restore 'whole)");
    assert_eq!(
        cook.done("(list (btr-utils:object-exists 'bread-1) (btr-utils:object-exists 'bread-1-1))"),
        "(T NIL)\n"
    );
    cook.done("(restore 'pieces)");
    assert_eq!(
        cook.done("(list (btr-utils:object-exists 'bread-1) (btr-utils:object-exists 'bread-1-1))"),
        "(NIL T)\n"
    );
}

#[test]
fn cutting_gives_the_same_bits_again() {
    let hash = || {
        let mut cook = with_bread();
        cook.done(
            "(with-simulated-robot
               (let ((?bread *bread*) (?knife *knife*))
                 (perform (an action (type slicing) (object ?bread) (tool ?knife) (cuts 2)))))",
        );
        cook.session.simulation().world().hash()
    };
    assert_eq!(hash(), hash());
}

#[test]
fn cutting_is_refused_before_the_first_motion() {
    let mut cook = with_bread();
    cook.done(
        "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-0.8 1.3 0.95) (0 0 0 1)))
               (btr-utils:spawn-object 'fork-1 :fork :pose '((-0.8 1.2 0.95) (0 0 0 1)))
               (btr-utils:spawn-object 'knife-2 :knife :pose '((-0.7 1.2 0.95) (0 0 0 1)))
               (defparameter *bottle* (seen :bottle))
               (defparameter *fork* (seen :fork))",
    );
    let cutting = |what: &str, keys: &str| {
        format!(
            "(let ((?bread *bread*) (?bottle *bottle*) (?fork *fork*) (?knife *knife*))
               (perform (an action (type cutting) (object {what}) {keys})))"
        )
    };
    refused(
        &mut cook,
        "TOOL-MISSING",
        &cutting("?bread", ""),
        "There is nothing for cutting: both hands are empty",
    );
    refused(
        &mut cook,
        "WRONG-TOOL",
        &cutting("?bread", "(tool ?fork)"),
        "FORK-1 cannot be used for cutting: it is fork, and no knife.",
    );
    refused(
        &mut cook,
        "CUTTING-FAILED",
        &cutting("?bottle", "(tool ?knife)"),
        "BOTTLE-1 cannot be cut: it is bottle, and no food.",
    );
    cook.done("(with-simulated-robot (let ((?knife *knife*)) (perform (an action (type fetching) (object ?knife)))))");
    refused(
        &mut cook,
        "CUTTING-FAILED",
        &cutting("?bread", "(slice-thickness 0.1) (cuts 4)"),
        "BREAD-1 cannot be cut 4 times for slices of 10.0 cm: it is 26.2 cm long.",
    );
    refused(
        &mut cook,
        "CUTTING-FAILED",
        &cutting("?bread", "(slice-thickness 0.002)"),
        "4.0 mm is the thinnest",
    );
    refused(&mut cook, "ERROR", &cutting("?bread", "(cuts 0)"), "from 1");
}

#[test]
fn bread_without_a_board_leaves_no_room_for_the_hand() {
    let mut cook = with_sponge();
    cook.done("(btr-utils:spawn-object 'knife-1 :big-knife :pose '((-0.8 2.5 0.95) (0 0 0 1)))
               (btr-utils:spawn-object 'bread-1 :bread :pose '((-0.75 1.9 1.0) (0 0 0 1)))
               (defparameter *bread* (seen :bread))
               (defparameter *knife* (seen :big-knife))
               (with-simulated-robot (let ((?knife *knife*)) (perform (an action (type fetching) (object ?knife)))))");
    refused(
        &mut cook,
        "MANIPULATION-POSE-UNREACHABLE",
        "(let ((?bread *bread*)) (perform (an action (type slicing) (object ?bread) (cuts 2))))",
        "on a cutting board there is room for the hand",
    );
}

#[test]
fn a_hand_holds_what_stands_there_until_it_opens() {
    let mut cook = Cook::new();
    cook.done(WITH_SPONGE);
    cook.done("(btr-utils:spawn-object 'milk-1 :milk :pose '((-0.8 2.0 0.95) (0 0 0 1)))
               (defparameter *milk* (seen :milk))
               (with-simulated-robot
                 (let* ((?milk *milk*)
                        (?there (a location (reachable-for pr2) (object ?milk))))
                   (perform (an action (type navigating) (location ?there)))
                   (setf *milk* (perform (an action (type detecting) (object (an object (type milk))))))))");
    let before = cook
        .session
        .simulation()
        .world()
        .object_pose("MILK-1")
        .unwrap();
    let said = cook.done("(with-simulated-robot (let ((?milk *milk*)) (perform (an action (type holding) (object ?milk)))))");
    assert!(
        said.ends_with(":RIGHT\n") || said.ends_with(":LEFT\n"),
        "{said}"
    );
    let after = cook
        .session
        .simulation()
        .world()
        .object_pose("MILK-1")
        .unwrap();
    let moved = (after.translation.vector - before.translation.vector).norm();
    assert!(moved < 0.005, "{moved} m");
    assert_eq!(cook.done("(not (pp-plans::holder-of 'milk-1))"), "NIL\n");
    cook.done(
        "(with-simulated-robot
                 (let ((?hand (pp-plans::holder-of 'milk-1)))
                   (perform (an action (type releasing) (gripper ?hand)))))",
    );
    assert_eq!(cook.done("(pp-plans::holder-of 'milk-1)"), "NIL\n");
}

#[test]
fn a_bowl_is_stirred_without_being_touched() {
    let mut cook = with_sponge();
    cook.done(
        "(btr-utils:spawn-object 'whisk-1 :whisk :pose '((-0.8 2.4 0.95) (0 0 0 1)))
         (btr-utils:spawn-object 'bowl-1 :bowl :pose '((-0.75 1.9 0.95) (0 0 0 1)))
         (btr-utils:spawn-object 'bottle-1 :bottle :pose '((-0.8 1.3 0.95) (0 0 0 1)))
         (defparameter *whisk* (seen :whisk))
         (defparameter *bowl* (seen :bowl))
         (defparameter *bottle* (seen :bottle))",
    );
    let mixing = |what: &str, keys: &str| {
        format!(
            "(let ((?bowl *bowl*) (?bottle *bottle*) (?whisk *whisk*) (?sponge *sponge*))
               (perform (an action (type mixing) (container {what}) {keys})))"
        )
    };
    refused(
        &mut cook,
        "WRONG-TOOL",
        &mixing("?bottle", "(tool ?whisk)"),
        "BOTTLE-1 is no open vessel: nothing can be mixed in it.",
    );
    refused(
        &mut cook,
        "WRONG-TOOL",
        &mixing("?bowl", "(tool ?sponge)"),
        "SPONGE-1 cannot be used for mixing",
    );
    refused(
        &mut cook,
        "ERROR",
        &mixing("?bowl", "(tool ?whisk) (rounds 0)"),
        "between 1 and 99",
    );
    let before = cook
        .session
        .simulation()
        .world()
        .object_pose("BOWL-1")
        .unwrap();
    cook.done(&format!(
        "(with-simulated-robot (defparameter *account* {}))",
        mixing("?bowl", "(tool ?whisk)")
    ));
    assert!(number(&mut cook, "(getf *account* :radius)") > 0.01);
    assert!(
        number(
            &mut cook,
            "(max (getf *account* :peak) (getf *account* :aside))"
        ) < 5.0
    );
    let after = cook
        .session
        .simulation()
        .world()
        .object_pose("BOWL-1")
        .unwrap();
    let moved = (after.translation.vector - before.translation.vector).norm();
    assert!(moved < 0.005, "{moved} m");
}

#[test]
fn failures_of_these_chores_are_failures_of_the_arms() {
    let mut cook = Cook::new();
    let said = cook.done(
        "(every (lambda (class) (subtypep class 'manipulation-low-level-failure))
                '(wiping-incomplete cutting-failed))",
    );
    assert_eq!(said, "T\n");
}
