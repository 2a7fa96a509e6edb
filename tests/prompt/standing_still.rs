//! Evaluations that stand still: what can be seen and done there.

use super::talk::{BOTTLE, FIND_BOTTLE, NOWHERE, Talk};
use session::dialogue::{Converse, Evaluate, Outcome};

#[test]
fn an_unbound_variable_stands_still_until_a_value_is_given() {
    let mut talk = Talk::new();
    let (shown, outcome) = talk.take("(list 1 nothing-yet)");
    assert_eq!(outcome, Outcome::Stopped);
    assert!(
        shown.starts_with(
            "The variable NOTHING-YET is unbound.\n   [Condition of type UNBOUND-VARIABLE]\n 0: [CONTINUE]"
        ),
        "{shown}"
    );
    assert_eq!(talk.session.prompt(), "PP-TUT 1]");
    assert_eq!(talk.say("1 (+ 1 1)"), "(1 2)\n");
    assert_eq!(talk.session.prompt(), "PP-TUT");
}

#[test]
fn a_value_is_asked_for_when_it_is_missing() {
    let mut talk = Talk::new();
    talk.say("(list 1 nothing-yet)");
    talk.say("2");
    assert_eq!(talk.session.prompt(), "PP-TUT 1] value");
    assert_eq!(talk.say(":two"), "(1 :TWO)\n");
    assert_eq!(talk.say("nothing-yet"), ":TWO\n");
}

#[test]
fn giving_up_tells_so_and_leaves_the_rest_of_the_input() {
    let mut talk = Talk::new();
    talk.say("(car 5) (defparameter *after* 1)");
    let (shown, outcome) = talk.take("q");
    assert!(
        shown.starts_with("; Evaluation aborted on #<TYPE-ERROR"),
        "{shown}"
    );
    assert_eq!(outcome, Outcome::Aborted);
    assert_eq!(talk.say("(boundp '*after*)"), "NIL\n");
}

#[test]
fn after_a_restart_the_rest_of_the_input_is_evaluated() {
    let mut talk = Talk::new();
    talk.say("(list here) (list :after)");
    assert_eq!(talk.say("1 5"), "(5)\n(:AFTER)\n");
}

#[test]
fn variables_of_a_frame_are_seen_and_assigned() {
    let mut talk = Talk::new();
    talk.say("(defun half (x) (let ((y (* x 2))) (list y (car y))))");
    talk.say("(half 4)");
    assert_eq!(talk.say(":locals"), "  X = 4\n  Y = 8\n");
    assert_eq!(talk.say("(+ x y)"), "12\n");
    talk.say("(setf y 10)");
    assert_eq!(talk.say(":locals"), "  X = 4\n  Y = 10\n");
    assert!(talk.say(":bt").starts_with("*  0: (HALF 4)"));
    assert_eq!(talk.say(":return (list x :instead)"), "(4 :INSTEAD)\n");
}

#[test]
fn a_mistake_while_looking_around_is_a_level_of_its_own() {
    let mut talk = Talk::new();
    talk.say("(handler-case (list (car 5)) (unbound-variable () :caught))");
    // The plan's handlers do not hear of what is typed here.
    talk.say("typo");
    assert_eq!(talk.session.prompt(), "PP-TUT 2]");
    talk.say("a");
    assert_eq!(talk.session.prompt(), "PP-TUT 1]");
    talk.say("typo");
    talk.say("q");
    assert_eq!(talk.session.prompt(), "PP-TUT");
}

#[test]
fn cleanup_code_runs_when_a_level_is_given_up() {
    let mut talk = Talk::new();
    talk.say("(defparameter *log* nil)");
    talk.say("(unwind-protect (car 5) (push :cleaned *log*))");
    assert_eq!(talk.say("*log*"), "NIL\n");
    talk.say("q");
    assert_eq!(talk.say("*log*"), "(:CLEANED)\n");
}

#[test]
fn what_the_program_handles_does_not_stop_it() {
    let mut talk = Talk::new();
    for (form, expected) in [
        (
            "(handler-case (with-simulated-robot (car 5)) (type-error () :caught))",
            ":CAUGHT\n",
        ),
        (
            "(with-simulated-robot
               (cpl:with-failure-handling
                   ((navigation-low-level-failure (e) (declare (ignore e)) (return :handled)))
                 (cpl:par (cpl:fail 'navigation-low-level-failure) (cpl:sleep 1))))",
            ":HANDLED\n",
        ),
        (
            "(with-simulated-robot
               (cpl:try-all (cpl:fail 'navigation-low-level-failure) (progn (cpl:sleep 1) 7)))",
            "7\n",
        ),
        (
            "(ignore-errors (with-simulated-robot (error \"x\")) 3)",
            "3\n",
        ),
    ] {
        let (shown, outcome) = talk.take(form);
        assert_eq!(outcome, Outcome::Finished, "{form}\n{shown}");
        if !form.contains("ignore-errors") {
            assert_eq!(shown, expected, "{form}");
        }
    }
}

#[test]
fn a_task_inside_others_stops_where_it_is() {
    let mut talk = Talk::new();
    let (_, outcome) = talk.take(
        "(with-simulated-robot
           (let ((outer 1))
             (cpl:par (let ((inner 2)) (list (+ outer inner (the-missing)))) (cpl:sleep 5))))",
    );
    assert_eq!(outcome, Outcome::Stopped);
    let locals = talk.say(":locals");
    assert!(
        locals.contains("INNER = 2") && locals.contains("OUTER = 1"),
        "{locals}"
    );
    talk.say("(defun the-missing () 39)");
    assert_eq!(talk.say("0 (the-missing)"), "(42)\n");
}

#[test]
fn a_frame_of_a_task_further_out_can_be_left() {
    let mut talk = Talk::new();
    talk.say("(defparameter *log* nil)");
    talk.say(
        "(list (with-simulated-robot
           (cpl:par
             (unwind-protect (car 5) (push :inner *log*))
             (unwind-protect (cpl:sleep 5) (push :sibling *log*)))
           :not-reached))",
    );
    let frames = talk.say(":bt");
    let lines: Vec<&str> = frames.lines().collect();
    let number = lines
        .iter()
        .rposition(|line| line.contains("LAMBDA"))
        .expect("the frame of the plan's body");
    talk.say(&format!(":frame {number}"));
    assert_eq!(talk.say(":return :left"), "(:LEFT)\n");
    assert_eq!(talk.say("(length *log*)"), "2\n");
    assert_eq!(talk.session.prompt(), "PP-TUT");
}

#[test]
fn at_a_level_values_are_taken_apart_too() {
    let mut talk = Talk::new();
    talk.say("(let ((x (list 1 2))) (car 5) x)");
    talk.say("(inspect x)");
    assert_eq!(talk.session.prompt(), "PP-TUT 1] inspect");
    assert!(talk.say("1").starts_with("2, of type"));
    talk.say("q");
    assert_eq!(talk.session.prompt(), "PP-TUT 1]");
}

#[test]
fn the_form_can_be_changed_and_evaluated_again() {
    let mut talk = Talk::new();
    talk.say("(list  (car 5))");
    talk.say(":edit");
    assert_eq!(
        talk.session.take_draft().as_deref(),
        Some("(list  (car 5))")
    );
    assert_eq!(talk.say("(list  (car '(5)))"), "(5)\n");
    assert_eq!(talk.session.prompt(), "PP-TUT");
}

#[test]
fn a_failed_action_can_be_retried_where_it_stands() {
    let mut talk = Talk::new();
    let shown = talk.say(NOWHERE);
    assert!(
        shown.contains("[RETRY] Retry (A ACTION (TYPE GOING)"),
        "{shown}"
    );
    assert!(shown.contains("the robot cannot stand"), "{shown}");
    assert!(talk.say(":bt").contains("PERFORM"));
    talk.choose("[RETRY]");
    assert_eq!(talk.session.prompt(), "PP-TUT 1]");
    // In the frame of the plan, another place.
    assert!(talk.say("q").contains("; Evaluation aborted on"));
}

#[test]
fn a_form_can_be_retried_in_the_world_that_it_began_in() {
    let mut talk = Talk::new();
    let before = talk.hash();
    talk.say("(progn (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1))) (list missing))");
    assert_ne!(talk.hash(), before);
    let shown = talk.choose("[REWIND-FORM]");
    // It has come to the same place again.
    assert!(
        shown.contains("The variable MISSING is unbound."),
        "{shown}"
    );
    talk.say("q");
    talk.say("(rewind)");
    assert_eq!(talk.hash(), before);
}

#[test]
fn a_frame_of_a_plan_can_return_a_value() {
    let mut talk = Talk::new();
    talk.say(NOWHERE);
    let frames = talk.say(":bt");
    let number = frames
        .lines()
        .position(|line| line.contains("PERFORM"))
        .expect("the action's frame");
    talk.say(&format!(":frame {number}"));
    assert_eq!(talk.say(":return :skipped"), ":THERE\n");
}

#[test]
fn the_nearest_free_place_is_offered_and_driven_to() {
    let actions = [
        "(perform (an action (type going) (location (a location (pose ?place)))))",
        "(perform (an action (type navigating) (location (a location (pose ?place)))))",
    ];
    for action in actions {
        let mut talk = Talk::new();
        let shown = talk.say(&format!(
            "(with-simulated-robot
               (let ((?place (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))
                 {action}
                 :there))"
        ));
        let label =
            "[NEAREST] Drive to the nearest free place with this heading: x -0.350, y 1.500.";
        assert!(shown.contains(label), "{shown}");
        // What is asked meanwhile does not matter.
        talk.say("(explain)");
        assert_eq!(talk.choose(label).lines().last(), Some(":THERE"));
        let stands =
            talk.say("(cl-transforms:x (cl-transforms:origin (get-robot-transformation)))");
        assert_eq!(stands, "-0.35d0\n");
    }
}

#[test]
fn another_arm_that_reaches_is_offered_and_works() {
    let mut talk = Talk::new();
    talk.say(BOTTLE);
    let found = talk.say(FIND_BOTTLE);
    assert!(found.ends_with(":FOUND\n"), "{found}");
    let before = talk.hash();
    let shown = talk.say(
        "(with-simulated-robot
           (let ((?bottle *bottle*))
             (perform (an action (type picking-up) (arm left) (grasp no-such-grasp)
                        (object ?bottle)))
             :held))",
    );
    assert!(
        shown.contains("[GRASP] Pick it up with :RIGHT and :LEFT-SIDE."),
        "{shown}"
    );
    assert_eq!(talk.hash(), before);
    let shown = talk.choose("with :RIGHT and :LEFT-SIDE");
    assert!(shown.ends_with(":HELD\n"), "{shown}");
    assert!(talk.say("(inspect :robot)").contains("right hand holds"));
    assert!(talk.say("0").contains("x (m)"));
}

#[test]
fn what_the_right_arm_does_not_reach_is_fetched_with_the_left_one() {
    let mut talk = Talk::new();
    talk.say(BOTTLE);
    talk.say(FIND_BOTTLE);
    let shown = talk.say(
        "(with-simulated-robot
           (let ((?bottle *bottle*)
                 (?stand (make-pose \"map\" '((-2.0 -0.15 0) (0 0 -0.7071 0.7071)))))
             (perform (an action (type fetching) (object ?bottle) (arms right)
                        (robot-location (a location (pose ?stand)))))
             :fetched))",
    );
    for choice in [
        "[LOOK]", "[STAND]", "[LEFT]", "[RIGHT]", "[RETRY]", "[BEFORE]",
    ] {
        assert!(shown.contains(choice), "{choice}\n{shown}");
    }
    let shown = talk.choose("[LEFT]");
    assert!(shown.ends_with(":FETCHED\n"), "{shown}");
    assert!(talk.say("(inspect :robot)").contains("left hand holds"));
}

#[test]
fn the_world_goes_back_to_before_an_action() {
    let mut talk = Talk::new();
    let before = talk.hash();
    let shown = talk.say(
        "(with-simulated-robot
           (let ((?near (make-pose \"map\" '((0.3 0 0) (0 0 0 1)))))
             (perform (an action (type going) (target (a location (pose ?near)))))
             (error \"Here.\")))",
    );
    assert!(shown.starts_with("Here."), "{shown}");
    assert_ne!(talk.hash(), before);
    talk.say("q");
    assert!(
        talk.say("(rewind)")
            .contains("; The world is as before (WITH-SIMULATED-ROBOT")
    );
    assert_eq!(talk.hash(), before);
}
