//! Classes whose names change, methods that pass on other arguments, and options without effect.

use super::standard::check;

#[test]
fn the_name_of_a_class_can_be_changed() {
    check(&[
        (
            "(progn (defclass cup () ()) (let ((class (find-class 'cup))) (list (setf (class-name class) 'mug) (class-name class) (eq class (find-class 'cup)))))",
            "(MUG MUG T)",
        ),
        (
            "(progn (defclass pan () ()) (let ((old (find-class 'pan))) (setf (class-name old) nil) (eq old (defclass pan () ()))))",
            "NIL",
        ),
        (
            "(progn (defclass lid () ()) (let ((class (find-class 'lid))) (setf (class-name class) nil) (eq class (type-of (make-instance class)))))",
            "T",
        ),
        (
            "(progn (defclass named () ()) (defmethod class-name ((x named)) :silly) (class-name (make-instance 'named)))",
            ":SILLY",
        ),
    ]);
}

#[test]
fn classes_of_one_name_are_told_apart() {
    check(&[(
        "(progn (defclass pot () ()) (let* ((old (find-class 'pot)) (object (make-instance 'pot))) (setf (find-class 'pot) nil) (let ((new (defclass pot () ()))) (list (eq old new) (typep object old) (typep object new) (typep object 'pot) (subtypep new old)))))",
        "(NIL T NIL NIL NIL)",
    )]);
}

#[test]
fn the_next_method_cannot_be_called_with_arguments_of_other_methods() {
    check(&[
        (
            "(progn (defgeneric weigh (x) (:method ((x integer)) (call-next-method (* 2 x))) (:method (x) x)) (weigh 2))",
            "4",
        ),
        (
            "(progn (defgeneric scale (x) (:method ((x integer)) (call-next-method :bad)) (:method (x) x)) (scale 2))",
            "!! CALL-NEXT-METHOD is called with arguments for which COMMON-LISP-USER::SCALE has other methods than for those of the call.",
        ),
        (
            "(progn (defgeneric tare (x) (:method ((x (eql 0))) (call-next-method 1)) (:method (x) x)) (tare 0))",
            "!! CALL-NEXT-METHOD is called with arguments for which COMMON-LISP-USER::TARE has other methods than for those of the call.",
        ),
    ]);
}

#[test]
fn options_without_effect_are_warnings() {
    let warning = |form: &str| {
        format!("(handler-case (eval '{form}) (style-warning (w) (princ-to-string w)))")
    };
    check(&[
        (
            &warning("(defgeneric odd (x) (:generic-function-class odd-function))"),
            "\"The option (:GENERIC-FUNCTION-CLASS ODD-FUNCTION) has no effect: there are only the standard metaclasses.\"",
        ),
        (
            &warning("(defclass odd () () (:metaclass odd-class))"),
            "\"The option (:METACLASS ODD-CLASS) has no effect: there are only the standard metaclasses.\"",
        ),
        (
            "(progn (defgeneric even (x) (:generic-function-class standard-generic-function) (:method-class standard-method)) 1)",
            "1",
        ),
        (
            &warning("(step 1)"),
            "\"STEP stops nowhere; (trace …) shows calls and (break) stops at a place.\"",
        ),
    ]);
}

#[test]
fn a_function_that_is_left_with_its_documentation_is_a_warning() {
    check(&[
        (
            "(handler-case (eval '(defun hold (x) \"Holds X.\" #+no-such-lisp (list x))) (style-warning (w) (princ-to-string w)))",
            "\"test:1:22: COMMON-LISP-USER::HOLD only returns its documentation string: no form follows it, perhaps since #+ or #- leaves all out.\"",
        ),
        ("(progn (defun version () \"1.0\") (version))", "\"1.0\""),
    ]);
}

#[test]
fn documentation_can_be_set_for_functions() {
    check(&[
        (
            "(progn (defun pour (x) \"Old.\" x) (setf (documentation #'pour 'function) \"New.\") (list (documentation #'pour t) (documentation 'pour 'function)))",
            "(\"New.\" \"New.\")",
        ),
        (
            "(progn (defun pour (x) \"Newest.\" x) (documentation #'pour 'function))",
            "\"Newest.\"",
        ),
    ]);
}

#[test]
fn declarations_of_loops_hold_for_their_results() {
    check(&[(
        "(let ((x :good)) (declare (special x)) (let ((x :bad)) (dolist (e nil x) (declare (special x)))))",
        ":GOOD",
    )]);
}

#[test]
fn wrong_numbers_of_arguments_of_macros_are_errors_of_programs() {
    check(&[(
        "(handler-case (eval '(return 1 2 3)) (program-error () :program-error))",
        ":PROGRAM-ERROR",
    )]);
}

#[test]
fn cases_of_constants_are_tested() {
    check(&[
        ("(ctypecase :a (integer 1) (keyword 2))", "2"),
        ("(ccase 3 (3 :three))", ":THREE"),
        (
            "(ctypecase :a (integer 1))",
            "!! :A fell through CTYPECASE expression. Wanted one of (INTEGER).",
        ),
    ]);
}

#[test]
fn methods_of_make_instance_for_instances_say_nothing_of_initialization_arguments() {
    check(&[
        (
            "(progn (defclass jug () ((size :initarg :size))) (defmethod make-instance ((of jug) &rest more &key &allow-other-keys) more) (make-instance (make-instance 'jug) :z 1))",
            "(:Z 1)",
        ),
        (
            "(handler-case (make-instance 'jug :z 1) (error () :refused))",
            ":REFUSED",
        ),
    ]);
}
