//! The types that handlers name: a type that there is not is an error when the handler is
//! established, which outer handlers catch; it hides no other condition.

use super::standard::check;

#[test]
fn a_misspelt_condition_type_is_an_error_that_outer_handlers_catch() {
    check(&[
        (
            "(handler-case (handler-case (error \"the real error\") (nope () 1)) (error (e) (princ-to-string e)))",
            "\"unknown type specifier: NOPE\"",
        ),
        (
            "(handler-case (handler-case 1 (simple-eror () 1)) (error (e) (princ-to-string e)))",
            "\"unknown type specifier: SIMPLE-EROR. Did you mean SIMPLE-ERROR?\"",
        ),
        (
            "(handler-case (handler-bind ((nope #'print)) 1) (error () :caught))",
            ":CAUGHT",
        ),
        (
            "(handler-case (handler-case 1 ((or error (and nope)) () 1)) (error () :caught))",
            ":CAUGHT",
        ),
        (
            "(handler-case (handler-bind ((5 #'print)) 1) (error () :caught))",
            ":CAUGHT",
        ),
        ("(null (ignore-errors (handler-case 1 (nope () 2))))", "T"),
        (
            "(handler-case (handler-case 1 (nope () 1) (error () 2)) (error () :outer))",
            ":OUTER",
        ),
        (
            "(handler-case 1 (nope () 2))",
            "!! unknown type specifier: NOPE",
        ),
        // A type that is defined later is known then.
        (
            "(progn (defun late () (handler-case (error 'late-error) (late-error () :handled))) (define-condition late-error (error) ()) (late))",
            ":HANDLED",
        ),
        (
            "(progn (deftype worse () 'nope) (handler-case (handler-case 1 (worse () 2)) (error (e) (princ-to-string e))))",
            "\"unknown type specifier: NOPE\"",
        ),
    ]);
}

#[test]
fn predicates_of_handlers_are_functions_and_may_fail() {
    check(&[
        (
            "(handler-case (handler-case 1 ((satisfies nope) () 2)) (undefined-function (e) (cell-error-name e)))",
            "NOPE",
        ),
        (
            "(handler-case (handler-case 1 ((satisfies 5) () 2)) (error (e) (princ-to-string e)))",
            "\"5 is not the name of a predicate: (SATISFIES name) was expected.\"",
        ),
        (
            "(handler-case (typep 1 '(satisfies \"x\")) (error () :error))",
            ":ERROR",
        ),
        // EVENP fails for a condition: that is a condition for the handlers outside.
        (
            "(handler-case (handler-case (error \"x\") ((satisfies evenp) () 3)) (type-error () :type-error))",
            ":TYPE-ERROR",
        ),
        (
            "(handler-case (handler-case (car 5) ((satisfies evenp) () 3)) (type-error (e) (not (eql (type-error-datum e) 5))))",
            "T",
        ),
        (
            "(handler-case (handler-case (car 5) ((satisfies evenp) () 3) (type-error () 4)) (type-error () :outside))",
            ":OUTSIDE",
        ),
    ]);
}

#[test]
fn unknown_types_and_classes_say_what_is_near() {
    check(&[
        (
            "(handler-case (typecase 1 (strin 2)) (error (e) (princ-to-string e)))",
            "\"unknown type specifier: STRIN. Did you mean STRING?\"",
        ),
        (
            "(handler-case (error 'smple-error) (error (e) (princ-to-string e)))",
            "\"There is no class named COMMON-LISP-USER::SMPLE-ERROR. Did you mean SIMPLE-ERROR?\"",
        ),
        (
            "(handler-case (make-instance 'zzyzx) (error (e) (princ-to-string e)))",
            "\"There is no class named COMMON-LISP-USER::ZZYZX.\"",
        ),
    ]);
}
