//! Designators in plans: own actions, own process modules, and what they fail with.

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// What a session prints for a text, after a package that uses everything is entered.
fn printed(text: &str) -> String {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let prelude = "(defpackage :d (:use :common-lisp :desig :exe :prolog :cpm)) (in-package :d)";
    session.evaluate("prelude", prelude, &mut |_| {});
    let mut printed = String::new();
    session.evaluate("test", text, &mut |event| match event {
        Event::Output(text) => printed.push_str(&text),
        Event::Picture(_) => {}
        Event::Values(values) => printed.push_str(&format!("{}\n", values.join(" ; "))),
        Event::Aborted(abort) => printed.push_str(&format!("!! {}\n", abort.report)),
        _ => {}
    });
    printed
}

#[test]
fn an_action_of_a_rule_calls_its_plan() {
    let text = "(cpl:def-cram-function my-plan (x) (list x cpl-impl:*current-path*))
        (def-fact-group mine (action-grounding)
          (<- (action-grounding ?d (my-plan ?x))
            (spec:property ?d (:type :my-type))
            (spec:property ?d (:x ?x))))
        (first (pr2-proj:with-simulated-robot (perform (an action (type my-type) (x 3)))))";
    assert_eq!(printed(text), "MY-PLAN\nMINE\n3\n");
}

#[test]
fn a_failure_to_resolve_is_a_plan_failure_and_an_error() {
    let handled = |class: &str| {
        printed(&format!(
            "(pr2-proj:with-simulated-robot
               (cpl:with-failure-handling (({class} (e) (return (type-of e))))
                 (perform (an action (type unheard-of)))))"
        ))
    };
    for class in ["cpl:plan-failure", "error", "desig:designator-error"] {
        assert_eq!(handled(class), "DESIGNATOR-REFERENCE-FAILURE\n", "{class}");
    }
}

#[test]
fn motions_of_rules_go_to_process_modules_one_at_a_time() {
    let text = "(defvar *log* nil)
        (def-process-module driver (motion)
          (push (list :start (second (reference motion))) *log*)
          (cpl:sleep 1)
          (push :end *log*)
          (second (reference motion)))
        (def-fact-group driving (motion-grounding matching-process-module available-process-module)
          (<- (motion-grounding ?d (drive ?speed))
            (desig-prop ?d (:type :driving))
            (desig-prop ?d (:speed ?speed)))
          (<- (matching-process-module ?d driver)
            (desig-prop ?d (:type :driving)))
          (<- (available-process-module driver)
            (not (projection-running driver))))
        (cpl:top-level
          (with-process-modules-running (driver)
            (cpl:par (perform (a motion (type driving) (speed 1)))
                     (perform (a motion (type driving) (speed 2))))))
        (reverse *log*)";
    assert_eq!(
        printed(text),
        "*LOG*\nDRIVER\nDRIVING\nWARNING: Process module DRIVER already processing input. \
         Waiting for it to become free.\n1\n((:START 1) :END (:START 2) :END)\n"
    );
}

#[test]
fn what_holds_already_is_not_done_and_what_is_missed_is_told() {
    let text = "(defvar *done* nil)
        (def-prolog-handler done (bindings) (when *done* (list bindings)))
        (defun work () (setf *done* t) :value)
        (def-fact-group mine (action-grounding)
          (<- (action-grounding ?d (work)) (spec:property ?d (:type :working)))
          (<- (action-grounding ?d (idle)) (spec:property ?d (:type :idling))))
        (defun idle () :value)
        (cpl:top-level (perform (an action (type idling) (goal (done)))))
        (cpl:top-level (perform (an action (type working) (goal (done)))))
        (cpl:top-level (perform (an action (type working) (goal (done)))))";
    assert_eq!(
        printed(text),
        "*DONE*\nDONE\nWORK\nMINE\nIDLE\n\
         [(PERFORM GOAL) WARN] 0.000: idling: (done) does not hold afterwards.\n:VALUE\n\
         :VALUE\n[(PERFORM GOAL) INFO] 0.000: working: (done) holds already.\nNIL\n"
    );
}
