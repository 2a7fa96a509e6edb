//! Variables of the standard refuse values that nothing could be done with.

use super::standard::check;

/// What a type error says about itself.
fn refused(form: &str) -> String {
    format!(
        "(handler-case {form} (type-error (e) (list (type-error-datum e) (type-error-expected-type e))))"
    )
}

#[test]
fn values_of_the_wrong_type_are_refused_however_they_come() {
    let cases = [
        ("(setf *package* 5)", "(5 PACKAGE)"),
        ("(let ((*package* :cl-user)) 1)", "(:CL-USER PACKAGE)"),
        ("(let* ((*print-base* 1)) 1)", "(1 (INTEGER 2 36))"),
        ("(setq *read-base* 37)", "(37 (INTEGER 2 36))"),
        ("(set '*print-length* -1)", "(-1 (OR NULL (INTEGER 0)))"),
        (
            "(setf (symbol-value '*print-level*) :a)",
            "(:A (OR NULL (INTEGER 0)))",
        ),
        (
            "(progv '(*print-case*) '(:upper) 1)",
            "(:UPPER (MEMBER :UPCASE :DOWNCASE :CAPITALIZE))",
        ),
        (
            "(multiple-value-bind (*gensym-counter*) -1 1)",
            "(-1 (INTEGER 0))",
        ),
        (
            "((lambda (&optional (*standard-output* 5)) 1))",
            "(5 STREAM)",
        ),
        ("(psetq *readtable* nil)", "(NIL READTABLE)"),
        ("(setf *random-state* 1)", "(1 RANDOM-STATE)"),
        ("(setf *macroexpand-hook* 1)", "(1 (OR SYMBOL FUNCTION))"),
        ("(incf *print-base* 30)", "(40 (INTEGER 2 36))"),
    ];
    let cases = cases.map(|(form, refusal)| (refused(form), refusal));
    let cases: Vec<(&str, &str)> = cases.iter().map(|(form, to)| (&**form, *to)).collect();
    check(&cases);
}

#[test]
fn refused_values_leave_everything_as_it_was() {
    check(&[
        (
            "(progn (ignore-errors (setf *package* 5)) (package-name *package*))",
            "\"COMMON-LISP-USER\"",
        ),
        (
            "(let ((*print-base* 2)) (ignore-errors (let ((*print-base* 99)) 1)) *print-base*)",
            "2",
        ),
        (
            "(let ((kept '())) (ignore-errors (dotimes (i 40) (push i kept) (let ((*print-base* (- 36 i))) i))) (length kept))",
            "36",
        ),
        (
            "(handler-bind ((type-error (lambda (e) (declare (ignore e)) (throw 'out :caught)))) (catch 'out (let ((*read-base* t)) 1)))",
            ":CAUGHT",
        ),
    ]);
}

#[test]
fn values_of_the_right_type_are_taken() {
    check(&[
        (
            "(let ((*package* (find-package :keyword))) (package-name *package*))",
            "\"KEYWORD\"",
        ),
        (
            "(let ((*print-length* nil) (*print-level* 3)) *print-level*)",
            "3",
        ),
        ("(with-standard-io-syntax *print-case*)", ":UPCASE"),
        (
            "(let ((*standard-output* (make-broadcast-stream))) (princ 5))",
            "5",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (readtablep *readtable*))",
            "T",
        ),
        (
            "(let ((*random-state* (make-random-state t))) (< -1 (random 5) 5))",
            "T",
        ),
        ("(progv '(*print-base*) '() 1)", "1"),
    ]);
}
