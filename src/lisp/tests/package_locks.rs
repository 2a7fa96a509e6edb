//! Package locks: what is built in is not redefined by mistake.

use super::standard::{check_in, locked_image};

fn check(cases: &[(&str, &str)]) {
    check_in(&mut locked_image(), cases);
}

/// Evaluates a form and returns what the error says of it, or its value.
const ASK: &str = "(progn
  (defmacro told (form) `(handler-case (eval ',form) (package-error (e) (list (package-name (package-error-package e)) (cell-name e)))))
  (defun cell-name (e) (slot-value e 'system::name)))";

#[test]
fn definitions_of_locked_names_are_errors() {
    check(&[
        (ASK, "CELL-NAME"),
        ("(told (defun car (x) x))", "(\"COMMON-LISP\" CAR)"),
        (
            "(told (defun open (drawer) drawer))",
            "(\"COMMON-LISP\" OPEN)",
        ),
        ("(told (defmacro when (x) x))", "(\"COMMON-LISP\" WHEN)"),
        ("(told (defgeneric list (x)))", "(\"COMMON-LISP\" LIST)"),
        (
            "(told (defun (setf car) (a b) b a))",
            "(\"COMMON-LISP\" CAR)",
        ),
        ("(told (defsetf first rplaca))", "(\"COMMON-LISP\" FIRST)"),
        ("(told (defclass list () ()))", "(\"COMMON-LISP\" LIST)"),
        (
            "(told (defstruct position x))",
            "(\"COMMON-LISP\" POSITION)",
        ),
        (
            "(told (defstruct (position (:type list)) x))",
            "(\"COMMON-LISP\" POSITION)",
        ),
        ("(told (deftype string () t))", "(\"COMMON-LISP\" STRING)"),
        (
            "(told (define-condition error () ()))",
            "(\"COMMON-LISP\" ERROR)",
        ),
        ("(told (defvar list 1))", "(\"COMMON-LISP\" LIST)"),
        ("(told (defparameter first 1))", "(\"COMMON-LISP\" FIRST)"),
        ("(told (defconstant list 1))", "(\"COMMON-LISP\" LIST)"),
        (
            "(told (define-symbol-macro list 1))",
            "(\"COMMON-LISP\" LIST)",
        ),
        (
            "(told (flet ((car (x) x)) (car 1)))",
            "(\"COMMON-LISP\" CAR)",
        ),
        (
            "(told (labels ((f (x) x) (cdr (x) x)) (f 1)))",
            "(\"COMMON-LISP\" CDR)",
        ),
        (
            "(told (macrolet ((list (x) x)) (list 1)))",
            "(\"COMMON-LISP\" LIST)",
        ),
        (
            "(told (setf (fdefinition 'car) #'cdr))",
            "(\"COMMON-LISP\" CAR)",
        ),
        (
            "(told (setf (symbol-function 'car) #'cdr))",
            "(\"COMMON-LISP\" CAR)",
        ),
        (
            "(told (setf (macro-function 'when) (lambda (f e) f e)))",
            "(\"COMMON-LISP\" WHEN)",
        ),
        ("(told (fmakunbound 'car))", "(\"COMMON-LISP\" CAR)"),
        (
            "(told (compile 'car '(lambda (x) x)))",
            "(\"COMMON-LISP\" CAR)",
        ),
        (
            "(told (setf (find-class 'list) (find-class 'integer)))",
            "(\"COMMON-LISP\" LIST)",
        ),
        (
            "(told (proclaim '(special list)))",
            "(\"COMMON-LISP\" LIST)",
        ),
        (
            "(told (defstruct (pair (:conc-name \"\")) car cdr))",
            "(\"COMMON-LISP\" CAR)",
        ),
        (
            "(told (defun alexandria:flatten (x) x))",
            "(\"ALEXANDRIA\" ALEXANDRIA:FLATTEN)",
        ),
        // Nothing of that has happened.
        (
            "(list (car '(1 2)) (first '(1 2)) (funcall #'car '(1 2)))",
            "(1 1 1)",
        ),
        ("(typep '(1) 'list)", "T"),
    ]);
}

#[test]
fn what_programs_may_do_stays_possible() {
    check(&[
        (
            "(let ((list '(1 2)) (first 1)) (list list first))",
            "((1 2) 1)",
        ),
        (
            "(progn (defclass spot () ((position :initform 1 :reader spot-position))) (defmethod print-object ((s spot) stream) (format stream \"spot\")) (princ-to-string (make-instance 'spot)))",
            "\"spot\"",
        ),
        (
            "(progn (defmethod make-load-form ((s spot) &optional e) e 1) (make-load-form (make-instance 'spot)))",
            "1",
        ),
        (
            "(progn (defgeneric area (x)) (defmethod area ((x spot)) 2) (area (make-instance 'spot)))",
            "2",
        ),
        (
            "(defmethod area :around ((x spot)) (call-next-method))",
            "#<STANDARD-METHOD COMMON-LISP-USER::AREA :AROUND (SPOT)>",
        ),
        ("(area (make-instance 'spot))", "2"),
        ("(progn (defparameter *print-base* 10) *print-base*)", "10"),
        ("(progn (trace car) (untrace car))", "T"),
        (
            "(loop for x in '(1 2) when (= x 2) do (loop-finish) collect x)",
            "(1)",
        ),
        (
            "(progn (defun f (x) x) (defun f (x) (list x)) (f 1))",
            "(1)",
        ),
        (
            "(system:without-package-locks (flet ((car (x) (list x))) (car 1)))",
            "(1)",
        ),
    ]);
}

#[test]
fn restarts_shadow_or_redefine() {
    check(&[
        (
            "(handler-bind ((package-error (lambda (e) (invoke-restart (find-restart 'shadow e))))) (eval '(defun second (x) (if (consp x) (second (cdr x)) :mine))))",
            "SECOND",
        ),
        // What is read from now on is the new symbol; the old one is as it was.
        (
            "(list (second '(1 2)) (cl:second '(1 2)) (eq 'second 'cl:second))",
            "(:MINE 2 NIL)",
        ),
        (
            "(handler-bind ((package-error (lambda (e) (invoke-restart (find-restart 'shadow e))))) (eval '(flet ((third (x) (list x))) (third 1))))",
            "(1)",
        ),
        (
            "(handler-bind ((package-error #'continue)) (eval '(defun fourth (x) (list :new x))))",
            "FOURTH",
        ),
        ("(fourth 1)", "(:NEW 1)"),
        // In the package itself there is nothing to shadow.
        (
            "(let ((*package* (find-package :alexandria))) (handler-case (eval '(defun alexandria:iota (x) x)) (package-error (e) (find-restart 'shadow e))))",
            "NIL",
        ),
        (
            "(handler-case (eval '(defun car (x) x)) (error (e) (princ-to-string e)))",
            "\"CAR belongs to the locked package COMMON-LISP: to define it as a function here would change what the language and the plans mean by it.\"",
        ),
        (
            "(handler-case (eval '(flet ((car (x) x) (cdr (x) x)) 1)) (error (e) (princ-to-string e)))",
            "\"CAR and CDR belong to the locked package COMMON-LISP: to define them as a local function here would change what the language and the plans mean by them.\"",
        ),
    ]);
}

#[test]
fn a_second_definition_in_a_text_is_told_of() {
    check(&[
        (
            "(let ((*error-output* (make-string-output-stream))) (eval '(defun once () 1)) (get-output-stream-string *error-output*))",
            "\"\"",
        ),
        (
            "(defvar *told* (make-string-output-stream)) (setq *error-output* *told*) (defun twice () 1)
             (defun other () 1)
             (defun twice () 2) (get-output-stream-string *told*)",
            "\"STYLE-WARNING: test:3:14: TWICE is defined for the second time; test:1:74 has the first definition, which is lost. \"",
        ),
        ("(defun twice () 3) (get-output-stream-string *told*)", "\"\""),
        ("(defun gone () 1) (fmakunbound 'gone) (defun gone () 2) (get-output-stream-string *told*)", "\"\""),
    ]);
}
