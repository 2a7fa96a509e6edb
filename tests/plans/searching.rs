//! Searching for objects, at places and from places to stand that are given by their poses.

use super::cook::Cook;

/// Two places on the island, a place from which both can be seen, and one where nobody can stand.
const PLACES: &str = "
    (defun pose (x y z)
      (make-pose \"map\" `((,x ,y ,z) (0 0 0 1))))
    (defparameter *at-first* (pose -0.8 1.0 0.95))
    (defparameter *at-second* (pose -0.8 2.0 0.95))
    (defparameter *stand* (pose -1.9 1.5 0))
    (defparameter *in-the-island* (pose -0.8 1.5 0))
    (defparameter *failure* nil)
    (defun attempts ()
      (loop for (what cause count) in (failure-attempts *failure*)
            collect (list what count)))
    (defun search-for (type ?places &optional ?stands)
      (let ((?type type))
        (cpl:with-failure-handling
            ((searching-failed (failure)
               (setf *failure* failure)))
          (get-object-name
           (with-simulated-robot
             (perform (an action (type searching)
                          (object (an object (type ?type)))
                          (location (a location (poses ?places)))
                          (desig:when ?stands
                            (robot-location (a location (poses ?stands)))))))))))";

fn cook() -> Cook {
    at_places(Cook::new())
}

/// One who knows the places of the searches, and a bottle on the island.
fn at_places(mut cook: Cook) -> Cook {
    cook.done(PLACES);
    cook.done("(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-0.8 2.0 0.95) (0 0 0 1)))");
    cook
}

/// The failure of a search, by what was tried how often.
fn attempts(cook: &mut Cook, search: &str) -> String {
    let (_, class) = cook.say(search).unwrap_err();
    assert!(class.contains("SEARCHING-FAILED"), "{class}");
    cook.done("(attempts)").trim().to_owned()
}

#[test]
fn what_is_at_the_first_place_is_found_without_a_failure() {
    let said = cook().done("(search-for :bottle (list *at-second*))");
    assert_eq!(said, "BOTTLE-1\n");
}

#[test]
fn what_is_at_the_second_place_is_found_there() {
    let mut cook = cook();
    let said = cook.done("(search-for :bottle (list *at-first* *at-second*) (list *stand*))");
    assert!(said.ends_with("BOTTLE-1\n"), "{said}");
    assert!(!said.contains("not to be seen"), "{said}");
}

#[test]
fn what_is_hidden_is_not_found_and_the_failure_says_what_was_tried() {
    let mut cook = cook();
    // A row of boxes between the robot and the bottle.
    for (number, y) in [1.8, 1.9, 2.0, 2.1, 2.2].iter().enumerate() {
        cook.done(&format!(
            "(btr-utils:spawn-object 'wall-{number} :breakfast-cereal
               :pose '((-1.1 {y} 1.0) (0 0 0 1)))"
        ));
    }
    let search = "(search-for :bottle (list *at-second*) (list *stand*))";
    assert_eq!(attempts(&mut cook, search), "((\"look\" 2) (\"place\" 1))");
    let told = cook.done("(explain)");
    for part in [
        "the bottle was not found",
        "look: not in sight (×2)",
        "place: not found (×1)",
    ] {
        assert!(told.contains(part), "{part}\n{told}");
    }
    let classes = "(list (typep *failure* 'object-nowhere-to-be-found)
                         (typep *failure* 'high-level-failure))";
    assert_eq!(cook.done(classes), "(T T)\n");
}

#[test]
fn a_search_from_where_nobody_can_stand_fails() {
    let search = "(search-for :bottle (list *at-second*) (list *in-the-island*))";
    assert_eq!(
        attempts(&mut cook(), search),
        "((\"place to stand\" 1) (\"place\" 1))"
    );
}

#[test]
fn a_blocked_place_to_stand_is_passed_over() {
    let mut cook = cook();
    let said = cook.done("(search-for :bottle (list *at-second*) (list *in-the-island* *stand*))");
    assert!(said.ends_with("BOTTLE-1\n"), "{said}");
    let warnings = said.matches("(PP-PLANS NAVIGATE) WARN").count();
    assert_eq!(warnings, 1, "{said}");
}

#[test]
fn what_is_not_in_the_world_is_searched_for_and_the_robot_is_parked_then() {
    let mut cook = at_places(Cook::watched());
    let search = "(search-for :cup (list *at-first* *at-second*) (list *stand*))";
    assert_eq!(attempts(&mut cook, search), "((\"look\" 4) (\"place\" 1))");
    let parked = "(coe:holds '(cpoe:arms-positioned-at :carry :carry))";
    assert_eq!(cook.done(parked), "(NIL)\n");
    cook.assert_no_overlap();
}

/// Looking for something of a type on a surface.
fn search_on(kind: &str, surface: &str) -> String {
    format!(
        "(get-object-name
           (with-simulated-robot
             (perform (an action (type searching)
                        (object (an object (type {kind})))
                        (location (a location (on (an object (urdf-name {surface})
                                                             (part-of kitchen)))))))))"
    )
}

#[test]
fn what_is_hidden_from_the_first_stand_is_seen_from_another() {
    let mut cook = Cook::new();
    cook.done(
        "(spawn-object '((-1.531 -0.890 0.821) (0 0 -0.987 0.159)) :bottle 'bottle-1)
         (spawn-object '((-1.410 -0.8146 0.8325) (0 0 -0.888 0.459)) :milk 'milk-1)",
    );
    let said = cook.done(&search_on("bottle", "table-area-main"));
    assert!(said.contains("hidden by MILK-1"), "{said}");
    assert!(said.ends_with("BOTTLE-1\n"), "{said}");
}

#[test]
fn what_stands_on_the_rim_of_the_sink_is_on_the_counter() {
    let mut cook = Cook::new();
    cook.done("(spawn-object '((1.5 -0.2 0.97) (0 0 0.3 0.95)) :cereal 'cereal-1)");
    let said = cook.done(&search_on("cereal", "sink-area-surface"));
    assert!(!said.contains("not at the place"), "{said}");
    assert!(said.ends_with("CEREAL-1\n"), "{said}");
}

#[test]
fn the_robot_knows_what_its_forearms_hide_from_it() {
    let mut cook = cook();
    let at = |x: f64, y: f64| {
        format!(
            "(let ((?point (make-pose \"map\" '(({x} {y} 0.86) (0 0 0 1)))))
               (perform (an action (type turning-towards) (target (a location (pose ?point)))))
               (pp-plans::own-body-hides-p ?point))"
        )
    };
    cook.done(
        "(with-simulated-robot
           (pp-plans::park-arms)
           (let ((?stand (make-pose \"map\" '((-0.325 1.875 0) (0 0 0.95966 0.28118)))))
             (perform (an action (type navigating) (location (a location (pose ?stand)))))))",
    );
    let mut hidden = |x, y| cook.done(&format!("(with-simulated-robot {})", at(x, y)));
    // A forearm is above the near edge of the island, and below the line of sight to the far one.
    assert!(hidden(-0.86, 1.3).ends_with("T\n"));
    assert!(hidden(-1.3, 2.5).ends_with("NIL\n"));
}

/// Beside the fridge, the robot cannot turn round where it stands. Who asks for a look is not told of a place to stand,
/// which would be given up sooner.
#[test]
fn a_head_that_cannot_turn_so_far_where_the_robot_cannot_turn_round_is_a_look_that_failed() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :pp-tut)
         (with-simulated-robot (pp-plans::park-arms))
         (btr-utils:move-robot '((0.6 -1.2 0) (0 0 0 1)))",
    );
    let report = cook.fails(
        "LOOKING-HIGH-LEVEL-FAILURE",
        "(let ((?behind (make-pose \"map\" '((-0.4 -1.2 1) (0 0 0 1)))))
           (perform (an action (type turning-towards) (target (a location (pose ?behind))))))",
    );
    assert!(report.contains("cannot stand"), "{report}");
}

#[test]
fn what_the_front_of_a_drawer_hides_at_first_is_found_from_near_by() {
    let mut cook = Cook::new();
    let spawn = "(btr-utils:spawn-object 'bowl-1 :bowl :pose '((1.3543 0.9663 0.4631) (0 0 0 1)))";
    cook.done(&format!("(in-package :pp-tut) {spawn}"));
    let said = cook.done(
        "(with-simulated-robot
           (get-object-name
             (perform (an action (type searching) (object (an object (type bowl)))
                          (context table-setting)))))",
    );
    assert!(
        said.contains("hidden by sink_area_left_middle_drawer_main"),
        "{said}"
    );
    assert!(said.ends_with("BOWL-1\n"), "{said}");
}

/// It used to try all places to stand for each point of each place, for minutes.
#[test]
fn where_no_way_leads_anywhere_a_search_ends_soon() {
    let mut cook = Cook::new();
    cook.done(
        "(in-package :pp-tut)
         (btr-utils:spawn-object 'spoon-1 :spoon :pose '((1.425 0.94 0.4631) (0 0 0 1)))
         (dotimes (i 14)
           (let ((angle (* i (/ pi 7))))
             (btr-utils:spawn-object (intern (format nil \"BOX-~a\" i)) :breakfast-cereal
               :pose `((,(* 0.62 (cos angle)) ,(* 0.62 (sin angle)) 0.15) (0 0 0 1)))))",
    );
    assert_eq!(cook.done("(pp-plans::way-out-p)"), "NIL\n");
    let search = "(with-simulated-robot
                    (perform (an action (type searching) (object (an object (type spoon))))))";
    let (report, class) = cook.say(search).unwrap_err();
    assert!(class.contains("SEARCHING-FAILED"), "{class}");
    let count = report.split("no place to stand is free (×").nth(1);
    let count = count.and_then(|rest| rest.split(')').next()?.parse::<u32>().ok());
    assert!(count.is_some_and(|count| count < 20), "{report}");
}
