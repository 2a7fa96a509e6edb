//! Generators, validators and solutions of locations, of plans' own kinds.

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// A package with generators and validators of its own, the first generator in use.
const PACKAGE: &str = "(defpackage :places (:use :common-lisp :desig))
    (in-package :places)
    (defun kind-p (location kind) (equal (desig-prop-value location :kind) kind))
    (defun one (location) (when (kind-p location :one) (list :a)))
    (defun two (location) (when (kind-p location :one) (list :b)))
    (defun no-b (location sample) (declare (ignore location)) (if (eq sample :b) :reject :accept))
    (defun no-a (location sample) (declare (ignore location)) (if (eq sample :a) :reject :accept))
    (defun all-of (location)
      (cons (reference location)
            (let ((next (next-solution location))) (when next (all-of next)))))
    (register-location-generator 1 one)";

/// What each form shows, one after the other in a session that has the package.
fn shown(forms: &[&str]) -> Vec<String> {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session.evaluate("package", PACKAGE, &mut |_| {});
    let mut evaluate = |form: &&str| {
        let mut shown = Vec::new();
        session.evaluate("test", form, &mut |event| match event {
            Event::Values(values) => shown.push(values.join(" ; ")),
            Event::Aborted(abort) => shown.push(format!("!! {}", abort.report)),
            _ => {}
        });
        shown.join(" ")
    };
    forms.iter().map(&mut evaluate).collect()
}

#[test]
fn solutions_come_in_the_order_of_the_generators() {
    let forms = [
        "(handler-case (reference (a location (kind nothing))) (designator-error () :none))",
        "(defvar *early* (a location (kind one)))",
        "(all-of *early*)",
        "(register-location-generator 2 two)",
        "(all-of (a location (kind one)))",
        // What has been resolved keeps its solutions.
        "(all-of *early*)",
    ];
    assert_eq!(
        shown(&forms),
        [":NONE", "*EARLY*", "(:A)", "TWO", "(:A :B)", "(:A)"]
    );
}

#[test]
fn what_a_validator_rejects_is_no_solution() {
    let forms = [
        "(register-location-generator 2 two)",
        "(register-location-validation-function 1 no-b)",
        "(defvar *resolved* (a location (kind one)))",
        "(all-of *resolved*)",
        "(register-location-validation-function 2 no-a)",
        "(handler-case (reference (a location (kind one))) (designator-error () :none))",
        "(progn (delete-location-validation-function 'no-a) (delete-location-validation-function 'no-b) (all-of (a location (kind one))))",
        // What was rejected before is not judged again.
        "(all-of *resolved*)",
    ];
    assert_eq!(
        shown(&forms),
        [
            "TWO",
            "NO-B",
            "*RESOLVED*",
            "(:A)",
            "NO-A",
            ":NONE",
            "(:A :B)",
            "(:A)"
        ]
    );
}

#[test]
fn a_search_ends_after_many_rejections() {
    let forms = [
        "(register-location-generator 2 (lambda (location) (when (kind-p location :many) (loop for i below 100 collect i))))",
        "(register-location-validation-function 1 (lambda (location sample) (if (and (kind-p location :many) (< sample 51)) :reject :accept)))",
        "(handler-case (reference (a location (kind many))) (designator-error () :none))",
        "(progn (setf *location-generator-max-retries* 60) (reference (a location (kind many))))",
    ];
    assert_eq!(shown(&forms)[2..], [":NONE", "51"]);
}

#[test]
fn tasks_that_resolve_one_location_at_a_time_get_the_same() {
    let forms = [
        "(register-location-generator 2 (lambda (location) (when (kind-p location :slow) (cpl:sleep (random 1.0)) (list (list 1) (list 2)))))",
        "(let ((d (a location (kind slow))) l) (cpl:top-level (cpl:par-loop (i '(1 2 3)) (push (reference d) l))) (list (eq (first l) (second l)) (eq (second l) (third l))))",
        "(let ((d (a location (kind slow))) l) (cpl:top-level (cpl:par-loop (i '(1 2 3)) (push (next-solution d) l))) (list (eq (first l) (second l)) (eq (second l) (third l)) (reference (first l))))",
    ];
    assert_eq!(shown(&forms)[1..], ["(T T)", "(T T (2))"]);
}

#[test]
fn a_location_of_an_object_is_where_the_object_is() {
    let forms = [
        "(let* ((place (a location (pose \"here\"))) (thing (make-designator :object (list (list :at place))))) (reference (make-designator :location (list (list :of thing)))))",
    ];
    assert_eq!(shown(&forms), ["\"here\""]);
}
