//! Restarts: what they apply to, what they show, and what they are given.

use super::standard::check;

#[test]
fn restarts_apply_to_their_conditions() {
    check(&[
        (
            "(restart-case (handler-bind ((error (lambda (c) (invoke-restart 'r)))) (error \"x\")) (r () :test (lambda (c) c) 1) (r () 2))",
            "2",
        ),
        (
            "(restart-case (let ((c (make-condition 'error)) (d (make-condition 'error))) (with-condition-restarts c (list (find-restart 'r)) (list (restart-name (find-restart 'r c)) (find-restart 'r d) (restart-name (find-restart 'r))))) (r () 2))",
            "(R NIL R)",
        ),
        (
            "(block nil (handler-bind ((error (lambda (c) (return (list (find-restart 'r (make-condition 'error)) (restart-name (find-restart 'r c))))))) (restart-case (error \"x\") (r () 1))))",
            "(NIL R)",
        ),
        (
            "(handler-bind ((error #'continue)) (list (cerror \"Go ~a.\" \"Stop ~a.\" 1)))",
            "(NIL)",
        ),
        (
            "(let ((x 1)) (handler-bind ((type-error (lambda (c) (store-value \"a\" c)))) (check-type x string) x))",
            "\"a\"",
        ),
        (
            "(let ((l (list 1))) (handler-bind ((type-error (lambda (c) (store-value \"a\")))) (list (ctypecase (car l) (string :s)) l)))",
            "(:S (\"a\"))",
        ),
        (
            "(let ((x 5)) (handler-bind ((type-error (lambda (c) (store-value 2)))) (list (ccase x ((1 2) :low) (3 :high)) x)))",
            "(:LOW 2)",
        ),
        (
            "(handler-case (etypecase 1 (string 1)) (type-error (c) (type-error-expected-type c)))",
            "(OR STRING)",
        ),
    ]);
}

#[test]
fn assertions_are_tried_again() {
    check(&[
        (
            "(let ((x 0)) (handler-bind ((type-error (lambda (c) (incf x) (continue c)))) (assert (> x 5) () 'type-error) x))",
            "6",
        ),
        (
            "(let ((*error-output* (make-string-output-stream))) (warn \"w\") (get-output-stream-string *error-output*))",
            "\"WARNING: w \"",
        ),
        (
            "(handler-case (nbutlast (list 1) 20.0) (type-error () :type-error))",
            ":TYPE-ERROR",
        ),
        ("(let ((x (list* 'a 'b 'c 'd))) (nbutlast x))", "(A B)"),
    ]);
}

#[test]
fn restarts_show_what_they_report_and_belong_to_what_macros_signal() {
    check(&[
        (
            "(restart-case (princ-to-string (find-restart 'r)) (r () :report (lambda (s) (write-string \"Go on.\" s))))",
            "\"Go on.\"",
        ),
        (
            "(restart-bind ((r #'list :report-function (lambda (s) (write-string \"Again.\" s)))) (format nil \"~a\" (find-restart 'r)))",
            "\"Again.\"",
        ),
        (
            "(macrolet ((fail-now () '(error \"one\"))) (handler-bind ((error (lambda (c) (invoke-restart (find-restart 'r c))))) (handler-bind ((error (lambda (c) (declare (ignore c)) (error \"two\")))) (restart-case (restart-case (fail-now) (r () :inner)) (r () :outer)))))",
            ":OUTER",
        ),
        (
            "(handler-case (warn (make-condition 'simple-warning) 1) (type-error (c) (type-error-datum c)))",
            "(1)",
        ),
        (
            "(handler-case (error (make-condition 'simple-error) 1) (type-error (c) (type-error-datum c)))",
            "(1)",
        ),
        (
            "(handler-bind ((error #'continue)) (cerror \"Go ~a.\" (make-condition 'simple-error) 1))",
            "NIL",
        ),
    ]);
}

#[test]
fn what_slots_lack_is_answered_with_one_value() {
    check(&[
        (
            "(progn (defclass lacking () (a)) (defmethod slot-unbound (class (object lacking) name) (values name 2 3)) (defmethod slot-missing (class (object lacking) name operation &optional new) (values (list name operation new) 5)) (multiple-value-list (slot-value (make-instance 'lacking) 'a)))",
            "(A)",
        ),
        (
            "(multiple-value-list (slot-value (make-instance 'lacking) 'b))",
            "((B SLOT-VALUE NIL))",
        ),
        ("(setf (slot-value (make-instance 'lacking) 'b) 7)", "7"),
        ("(slot-boundp (make-instance 'lacking) 'b)", "T"),
        (
            "(typep (slot-makunbound (make-instance 'lacking) 'b) 'lacking)",
            "T",
        ),
        (
            "(handler-case (eval '(defclass twice () ((a :type t :type t)))) (program-error () :wrong))",
            ":WRONG",
        ),
        (
            "(handler-case (eval '(defclass twice () (a) (:default-initargs :a 1 :a 2))) (program-error () :wrong))",
            ":WRONG",
        ),
    ]);
}
