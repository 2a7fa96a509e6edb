//! Chores: pointing, pouring by the level model, and handing over.

use super::cook::Cook;

/// A cup and a bowl on the island, seen from before it.
const AT_ISLAND: &str = "
  (btr-utils:spawn-object 'cup-1 :cup :pose '((-0.8 1.8 0.95) (0 0 0 1)))
  (btr-utils:spawn-object 'bowl-1 :bowl :pose '((-0.8 2.2 0.95) (0 0 0 1)))
  (defparameter *island* (a location (on (an object (urdf-name kitchen-island-surface) (part-of kitchen)))))
  (defun seen (?type)
    (let ((?island *island*))
      (with-simulated-robot
        (perform (an action (type searching) (object (an object (type ?type))) (location ?island))))))
  (defparameter *bowl* (seen :bowl))
  (defparameter *cup* (seen :cup))";

/// Takes the cup into a hand.
const TAKE_CUP: &str = "
  (with-simulated-robot
    (let ((?cup *cup*)) (perform (an action (type fetching) (object ?cup)))))";

/// An action of pouring from the cup into the bowl with further keys.
fn pouring(keys: &str) -> String {
    format!(
        "(let ((?cup *cup*) (?bowl *bowl*))
           (perform (an action (type pouring) (object ?cup) (on-object ?bowl) {keys})))"
    )
}

fn at_island() -> Cook {
    let mut cook = Cook::new();
    cook.done(AT_ISLAND);
    cook
}

/// The number that is the value of a form.
pub(super) fn number(cook: &mut Cook, form: &str) -> f64 {
    let said = cook.done(form);
    let said = said.lines().last().unwrap_or("").trim().replace('d', "e");
    said.parse().unwrap_or_else(|_| panic!("{form}: {said}"))
}

fn volume(cook: &mut Cook, name: &str) -> f64 {
    number(
        cook,
        &format!("(float (or (second (content-of '{name})) 0) 1d0)"),
    )
}

#[test]
fn a_hand_points_within_five_degrees_for_two_seconds() {
    let mut cook = Cook::watched();
    for target in ["2 0 1", "1 2 0.5", "0 -2 2", "-2 0 1", "0.8 0.3 0.1"] {
        let began = cook.session.simulation().world().time();
        let said = cook.done(&format!(
            "(with-simulated-robot
               (let ((?there (make-pose \"map\" '(({target}) (0 0 0 1)))))
                 (float (perform (an action (type pointing) (target ?there))) 1d0)))"
        ));
        let angle: f64 = said
            .lines()
            .last()
            .unwrap()
            .trim_end_matches("d0")
            .replace("d-", "e-")
            .parse()
            .unwrap();
        assert!(angle < 5_f64.to_radians(), "{target}: {said}");
        assert!(cook.session.simulation().world().time() - began >= 2.0);
    }
    cook.assert_no_overlap();
}

#[test]
fn a_hand_that_cannot_point_does_not_move() {
    let mut cook = Cook::new();
    cook.done("(with-simulated-robot (park-arms))");
    let before = cook.session.simulation().world().steps();
    let report = cook.fails(
        "MANIPULATION-POSE-UNREACHABLE",
        "(let ((?there (make-pose \"base_footprint\" '((0 0 0.8) (0 0 0 1)))))
           (perform (an action (type pointing) (target ?there) (arm left))))",
    );
    assert!(
        report.starts_with("The left arm cannot point at"),
        "{report}"
    );
    assert_eq!(cook.session.simulation().world().steps(), before);
}

/// How many grains are in a vessel.
fn grains(cook: &mut Cook, name: &str) -> f64 {
    number(
        cook,
        &format!("(float (or (second (grains-in '{name})) 0) 1d0)"),
    )
}

#[test]
fn grains_are_poured_and_counted() {
    let mut cook = at_island();
    cook.done(TAKE_CUP);
    cook.done("(fill-with-grains 'cup-1 :rice 40)");
    let half = pouring("(amount 0.5)");
    cook.done(&format!("(with-simulated-robot {half})"));
    let (cup, bowl) = (grains(&mut cook, "cup-1"), grains(&mut cook, "bowl-1"));
    assert!((17.0..=26.0).contains(&bowl), "{bowl} of 40");
    let lost = number(&mut cook, "(spilled-from 'cup-1)");
    assert!(
        (lost - (40.0 - cup - bowl) * 0.904_779).abs() < 1e-3,
        "{lost}"
    );
    assert!(lost < 2.0, "{lost} ml");
}

#[test]
fn grains_that_would_not_fit_are_refused_before_anything_moves() {
    let mut cook = at_island();
    cook.done(TAKE_CUP);
    cook.done("(fill-with-grains 'cup-1 :rice 60)");
    cook.done("(fill-with-grains 'bowl-1 :peas 300)");
    let before = cook.session.simulation().world().steps();
    let report = cook.fails("CONTAINER-FULL", &pouring(""));
    assert!(
        report.starts_with(
            "BOWL-1 would overflow: 60 grains are to be poured into it, 15 grains fit."
        ),
        "{report}"
    );
    assert_eq!(cook.session.simulation().world().steps(), before);
    for (form, wanted) in [
        (
            "(fill-with-grains 'cup-1 :rice 500)",
            "CUP-1 does not hold 500 grains: it is full with ",
        ),
        (
            "(progn (btr-utils:spawn-object 'cap-1 :cap :pose '((1.4 1.0 0.95) (0 0 0 1))) (fill-with-grains 'cap-1 :rice 1))",
            "CAP-1 is no open vessel: grains do not get into it.",
        ),
    ] {
        let report = cook.fails("SIMPLE-ERROR", form);
        assert!(report.starts_with(wanted), "{report}");
    }
}

#[test]
fn what_is_above_the_rim_of_a_tilted_vessel_leaves_it() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.95) (0 0 0 1)))
         (set-content 'cup-1 :water 200)
         (with-simulated-robot (cpl:sleep 1))",
    );
    assert_eq!(volume(&mut cook, "cup-1"), 200.0);
    // It falls on its side.
    cook.done(
        "(btr-utils:move-object 'cup-1 '((1.4 0.6 1.0) (0.7071 0 0 0.7071)))
         (with-simulated-robot (cpl:sleep 1))",
    );
    let left = volume(&mut cook, "cup-1");
    let spilled = number(&mut cook, "(spilled-from 'cup-1)");
    assert!(left < 20.0, "{left} ml have stayed");
    assert!(
        (left + spilled - 200.0).abs() < 1e-6,
        "{left} and {spilled}"
    );
}

#[test]
fn contents_are_part_of_the_world() {
    let mut cook = Cook::new();
    cook.done("(btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.95) (0 0 0 1)))");
    cook.done("(set-content 'cup-1 :water 200)");
    cook.done("(snapshot 'full)");
    cook.done("(set-content 'cup-1 :milk 50)");
    assert_eq!(cook.done("(content-of 'cup-1)"), "(:MILK 50.0d0)\n");
    cook.done("(rewind)");
    assert_eq!(cook.done("(content-of 'cup-1)"), "(:WATER 200.0d0)\n");
    cook.done("(set-content 'cup-1 :milk 0)");
    assert_eq!(cook.done("(content-of 'cup-1)"), "NIL\n");
    cook.done("(restore 'full)");
    assert_eq!(cook.done("(content-of 'cup-1)"), "(:WATER 200.0d0)\n");
}

#[test]
fn what_cannot_be_filled_is_refused_with_the_reason() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'cup-1 :cup :pose '((1.4 0.6 0.95) (0 0 0 1)))
         (btr-utils:spawn-object 'bottle-1 :bottle :pose '((1.4 0.2 0.95) (0 0 0 1)))",
    );
    for (form, wanted) in [
        (
            "(progn (btr-utils:spawn-object 'cap-1 :cap :pose '((1.4 1.0 0.95) (0 0 0 1))) (set-content 'cap-1 :water 10))",
            "CAP-1 is closed: nothing can be filled into it.",
        ),
        (
            "(set-content 'cup-1 :water 1000)",
            "CUP-1 does not hold 1000 ml: it is full with ",
        ),
        (
            "(set-content 'cup-1 :water -1)",
            "-1 is no amount: a number of ml from 0 was expected.",
        ),
        ("(set-content 'cup-1 :water :much)", ":MUCH is no amount"),
    ] {
        let report = cook.fails("ERROR", form);
        assert!(report.starts_with(wanted), "{form}: {report}");
    }
}

#[test]
fn half_of_what_is_in_a_cup_is_poured_into_a_bowl() {
    let mut cook = at_island();
    cook.done(TAKE_CUP);
    cook.done("(set-content 'cup-1 :water 180)");
    let said = cook.done(&format!(
        "(with-simulated-robot {})",
        pouring("(amount 0.5)")
    ));
    assert!(said.contains("(:POURED "), "{said}");
    let (cup, bowl) = (volume(&mut cook, "cup-1"), volume(&mut cook, "bowl-1"));
    assert!((bowl - 90.0).abs() < 9.0, "{bowl} ml are in the bowl");
    let spilled = number(&mut cook, "(spilled-from 'cup-1)");
    assert!((cup + bowl + spilled - 180.0).abs() < 1e-6);
    assert!(spilled < 2.0, "{spilled} ml were spilled");
    assert!(cook.lean("CUP-1") < 5.0);
    assert_eq!(cook.done("(first (content-of 'bowl-1))"), ":WATER\n");
}

/// A form that fails with a class and a report that says that, before anything has moved.
pub(super) fn refused(cook: &mut Cook, class: &str, form: &str, wanted: &str) {
    let before = cook.session.simulation().world().steps();
    let report = cook.fails(class, form);
    assert!(report.contains(wanted), "{form}: {report}");
    assert_eq!(cook.session.simulation().world().steps(), before, "{form}");
}

#[test]
fn pouring_is_refused_before_the_first_motion() {
    let mut cook = at_island();
    cook.done(
        "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-0.8 2.5 0.95) (0 0 0 1)))
               (defparameter *bottle* (seen :bottle))",
    );
    let bottle = "(let ((?b *bottle*) (?bowl *bowl*))
        (perform (an action (type pouring) (object ?b) (on-object ?bowl))))";
    let into_bottle = "(let ((?b *bottle*) (?cup *cup*))
        (perform (an action (type pouring) (object ?cup) (on-object ?b))))";
    let of_nothing = "(let ((?bowl *bowl*))
        (perform (an action (type pouring) (on-object ?bowl))))";
    refused(
        &mut cook,
        "TOOL-MISSING",
        of_nothing,
        "There is nothing to pour from: both hands are empty.",
    );
    refused(
        &mut cook,
        "WRONG-TOOL",
        bottle,
        "BOTTLE-1 is closed: nothing can be poured from it.",
    );
    refused(
        &mut cook,
        "CONTAINER-EMPTY",
        &pouring("(amount 10)"),
        "CUP-1 is empty: nothing can be poured from it.",
    );
    cook.done(TAKE_CUP);
    cook.done("(set-content 'cup-1 :water 150) (set-content 'bowl-1 :water 700)");
    refused(
        &mut cook,
        "WRONG-TOOL",
        into_bottle,
        "BOTTLE-1 is no open vessel: nothing can be poured into it.",
    );
    refused(
        &mut cook,
        "CONTAINER-EMPTY",
        &pouring("(amount 200)"),
        "There are only 150 ml in CUP-1",
    );
    refused(
        &mut cook,
        "CONTAINER-FULL",
        &pouring("(amount 1)"),
        "BOWL-1 would overflow: 150 ml",
    );
    refused(
        &mut cook,
        "ERROR",
        &pouring("(amount -3)"),
        "An amount is above 0",
    );
    refused(
        &mut cook,
        "ERROR",
        &pouring("(amount 1) (tilt-angle 1)"),
        "give one of them",
    );
}

/// Takes a carton of milk from the island with the right hand.
fn with_milk_in_right_hand() -> Cook {
    let mut cook = at_island();
    cook.done(
        "(btr-utils:spawn-object 'milk-1 :milk :pose '((-0.8 2.0 0.95) (0 0 0 1)))
         (defparameter *milk* (seen :milk))
         (with-simulated-robot
           (let ((?milk *milk*)) (perform (an action (type fetching) (object ?milk) (arm right)))))",
    );
    assert_eq!(
        cook.done("(pp-plans::objects-in-hand :right)"),
        "(MILK-1)\n"
    );
    cook
}

#[test]
fn an_object_is_handed_over_and_never_left_alone() {
    let mut cook = with_milk_in_right_hand();
    let said = cook.done(
        "(defvar *held* t)
         (with-simulated-robot
           (let ((?milk *milk*))
             (cpl:pursue
               (perform (an action (type handing-over) (object ?milk) (to left)))
               (loop (cpl:sleep 0.004)
                     (unless (pp-plans::holder-of 'milk-1) (setf *held* nil))))))
         (list *held* (pp-plans::objects-in-hand :left) (pp-plans::objects-in-hand :right))",
    );
    assert!(said.ends_with("(T (MILK-1) NIL)\n"), "{said}");
}

#[test]
fn what_the_other_hand_holds_is_handed_over_when_it_is_picked_up() {
    let mut cook = with_milk_in_right_hand();
    let pick = |arm: &str| {
        format!(
            "(let ((?milk *milk*)) (perform (an action (type picking-up) (object ?milk) (arm {arm}))))"
        )
    };
    let report = cook.fails("MANIPULATION-GOAL-NOT-REACHED", &pick("right"));
    assert_eq!(report, "MILK-1 is in the right hand already.");
    cook.done(&format!("(with-simulated-robot {})", pick("left")));
    assert_eq!(cook.done("(pp-plans::objects-in-hand :left)"), "(MILK-1)\n");
    assert_eq!(cook.done("(pp-plans::objects-in-hand :right)"), "NIL\n");
}

#[test]
fn handing_over_what_no_hand_holds_is_refused() {
    let mut cook = at_island();
    let report = cook.fails(
        "HANDOVER-FAILED",
        "(let ((?cup *cup*)) (perform (an action (type handing-over) (object ?cup) (to left))))",
    );
    assert_eq!(report, "CUP-1 cannot be handed over: no hand holds it.");
}

#[test]
fn failures_of_chores_are_failures_of_the_arms() {
    let mut cook = Cook::new();
    let said = cook.done(
        "(every (lambda (class) (subtypep class 'manipulation-low-level-failure))
                '(pouring-spilled container-empty container-full tool-missing wrong-tool handover-failed))",
    );
    assert_eq!(said, "T\n");
}
