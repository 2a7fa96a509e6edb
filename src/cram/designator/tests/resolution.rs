//! What designators are resolved by: proofs, generators of locations, perceived objects.

use super::{check, evaluate_in, image};
use crate::designator::value::Class;
use lisp::value::Value;

#[test]
fn prolog_proves() {
    check(&[
        ("(prolog '(member ?x (1 2)))", "(((?X . 1)) ((?X . 2)))"),
        ("(prolog '(and))", "(NIL)"),
        ("(prolog '(fail))", "NIL"),
        ("(force-ll (prolog '(and (member ?x (1 2 3)) (lisp-pred oddp ?x))))", "(((?X . 1)) ((?X . 3)))"),
        ("(prolog '(and (== ?x ?y) (== ?y 3)))", "(((?Y . 3) (?X . 3)))"),
        ("(prolog '(findall ?x (member ?x (1 2)) ?l))", "(((?L 1 2)))"),
        ("(prolog '(setof ?x (member ?x (1 2 1)) ?l))", "(((?L 1 2)))"),
        ("(prolog '(once (member ?x (1 2))))", "(((?X . 1)))"),
        ("(prolog '(-> (member ?x (1 2)) (== ?y ?x) (== ?y 0)))", "(((?Y . 1) (?X . 1)))"),
        ("(prolog '(-> (member ?x ()) (== ?y ?x) (== ?y 0)))", "(((?Y . 0)))"),
        ("(prolog '(*-> (member ?x (1 2)) (== ?y ?x) (== ?y 0)))", "(((?Y . 1) (?X . 1)) ((?Y . 2) (?X . 2)))"),
        ("(prolog '(forall (member ?x (1 3)) (lisp-pred oddp ?x)))", "(NIL)"),
        ("(prolog '(append ?a ?b (1)))", "(((?B 1) (?A)) ((?B) (?A 1)))"),
        (
            "(def-fact-group g () (<- (p 1)) (<- (p 2) !) (<- (p 3)) (<- (q ?x) (p ?x)))
             (mapcar (lambda (b) (var-value '?x b)) (force-ll (prolog '(q ?x))))",
            "(1 2)",
        ),
        (
            "(def-prolog-handler twice (bindings x y) (declare (ignore bindings)) (list (list (cons y (* 2 x)))))
             (force-ll (prolog '(and (member ?x (1 2)) (twice ?x ?y))))",
            "(((?Y . 2) (?X . 1)) ((?Y . 4) (?X . 2)))",
        ),
        (
            "(def-fact-group g () (<- (loop ?x) (loop ?x)) (<- (loop 1)))
             (handler-case (prolog '(loop ?x)) (error () :error))",
            ":ERROR",
        ),
    ]);
}

#[test]
fn locations_are_generated_and_validated() {
    check(&[
        (
            "(let ((?p (pp-tut:make-pose \"odd\" '((1 2 0) (0 0 0 1))))) (eq ?p (reference (a location (pose ?p)))))",
            "T",
        ),
        (
            "(register-location-generator 5 (lambda (d) (declare (ignore d)) (list 1 2 3 4)))
             (register-location-validation-function 5 (lambda (d p) (declare (ignore d)) (if (evenp p) :accept :maybe-reject)))
             (let* ((a (a location (x 1))) (b (progn (reference a) (next-solution a))))
               (list (reference a) (reference b) (next-solution b) (reference a)))",
            "(2 4 NIL 2)",
        ),
        (
            "(register-location-generator 6 (lambda (d) (declare (ignore d)) (list 3)))
             (register-location-generator 5 (lambda (d) (declare (ignore d)) nil))
             (register-location-validation-function 5 (lambda (d p) (declare (ignore d p)) :unknown))
             (reference (a location (x 1)))",
            "3",
        ),
        (
            "(defvar *n* 0)
             (register-location-generator 5 (lambda (d) (declare (ignore d)) (make-list 100)))
             (register-location-validation-function 5 (lambda (d p) (declare (ignore d p)) (incf *n*) :reject))
             (list (handler-case (reference (a location (x 1))) (desig:designator-error () :none)) *n*)",
            "(:NONE 30)",
        ),
    ]);
}

#[test]
fn perceived_objects_keep_what_was_asked_for() {
    let mut image = image();
    let query =
        crate::designator::value::make(&mut image, Class::Object, &[("COLOR", Value::Int(1))]);
    let (name, kind) = (image.keyword("BOTTLE-1"), image.keyword("BOTTLE"));
    let pose = spatial::Pose::translation(1.0, 0.0, 0.5);
    let found = crate::designator::object::perceived(
        &mut image,
        &query,
        name.into(),
        kind.into(),
        "base_footprint",
        &pose,
        &pose,
    );
    let sym = image.make_symbol("FOUND");
    image.define_special(sym, found);
    let package = image.current_package();
    image.packages.import(&mut image.symbols, package, sym);
    assert_eq!(
        evaluate_in(&mut image, "(mapcar #'first (properties found))"),
        "(:TYPE :NAME :POSE :COLOR)"
    );
    assert_eq!(
        evaluate_in(&mut image, "(object-identifier (reference found))"),
        ":BOTTLE-1"
    );
    assert_eq!(
        evaluate_in(
            &mut image,
            "(second (assoc :transform (desig-prop-value found :pose)))"
        ),
        "#<\"base_footprint\" \"bottle_1\" ((1.00000 0.00000 0.50000) (0.00000 0.00000 0.00000 1.00000))>"
    );
}
