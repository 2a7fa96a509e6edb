//! What programs that walk code see of macros and special operators.

use super::standard::check;

#[test]
fn macros_that_the_compiler_knows_are_macros() {
    check(&[
        (
            "(remove-if #'macro-function '(and or prog1 lambda handler-bind multiple-value-bind))",
            "NIL",
        ),
        (
            "(remove-if-not #'special-operator-p '(throw catch if and declare lambda))",
            "(THROW CATCH IF)",
        ),
        ("(macroexpand-1 '(and a b c))", "(IF A (AND B C)) ; T"),
        ("(macroexpand-1 '(lambda (x) x))", "#'(LAMBDA (X) X) ; T"),
        (
            "(mapcar (lambda (form) (eval (macroexpand-1 form)))
                     '((and) (and 1) (and 1 2) (or) (or nil 2) (prog1 1 2)
                       (multiple-value-bind (a b) (values 1) (list a b))))",
            "(T 1 2 NIL 2 1 (1 NIL))",
        ),
        (
            "(eval (macroexpand-1 '(handler-bind ((warning #'muffle-warning)) (warn \"x\") 1)))",
            "1",
        ),
        // What walks code finds functions and calls of functions only.
        (
            "(first (macroexpand-1 '(handler-bind ((error #'print)) 1)))",
            "SYSTEM:%CALL-WITH-HANDLERS",
        ),
        (
            "(eval (macroexpand-1 '(handler-bind ((error (lambda (c) c nil)) (warning #'muffle-warning)) (list (warn \"x\") (ignore-errors (error \"y\"))))))",
            "(NIL NIL)",
        ),
        (
            "(list (special-operator-p 'system:with-restarts)
                   (eval (macroexpand-1 '(system:with-restarts (list (system:make-restart 'three (lambda () 3) nil nil nil)) (invoke-restart 'three)))))",
            "(NIL 3)",
        ),
        (
            "(multiple-value-list (catch 'x (throw 'x (values 1 2))))",
            "(1 2)",
        ),
        ("(throw 'x)", "!! THROW takes a tag and a form."),
    ]);
}

#[test]
fn local_macros_are_found_in_their_environment() {
    check(&[
        (
            "(defmacro outer () 1)
             (defmacro found (name &environment env) `',(and (macro-function name env) t))
             (list (macrolet ((local () 2)) (found local)) (found local) (found outer)
                   (flet ((outer () 3)) (outer) (found outer)))",
            "(T NIL T NIL)",
        ),
        (
            "(define-compiler-macro old (&whole form x) (declare (ignore x)) form)",
            "OLD",
        ),
    ]);
}

#[test]
fn places_of_several_values_are_shifted() {
    check(&[
        (
            "(let ((x 1) (y 2) (z 3) (w 4) (u 5) (v 6))
               (rotatef x (values y z) (values w u v))
               (list x y z w u v))",
            "(2 4 5 1 NIL NIL)",
        ),
        (
            "(let ((x 1) (y 2) (z 3))
               (list (multiple-value-list (shiftf (values x y) z (floor 89 10))) x y z))",
            "((1 2) 3 NIL 8)",
        ),
    ]);
}

#[test]
fn a_parameter_has_three_parts_at_most() {
    check(&[(
        "(lambda (&optional (a 3 b 4)) a b)",
        "!! more than three parts of a parameter: (A 3 B 4) is not a valid lambda list",
    )]);
}

#[test]
fn special_variables_are_no_symbol_macros() {
    check(&[
        (
            "(symbol-macrolet ((*print-base* 2)) *print-base*)",
            "!! *PRINT-BASE* is a special variable and cannot be a symbol macro.",
        ),
        (
            "(symbol-macrolet ((x 2)) (declare (special x)) x)",
            "!! X is a special variable and cannot be a symbol macro.",
        ),
    ]);
}

#[test]
fn a_macro_is_described_by_the_lambda_list_that_was_written() {
    check(&[
        (
            "(progn (defmacro twice ((name &optional (start 0)) &body forms) \"Does it twice.\" `(let ((,name ,start)) ,@forms ,@forms))
               (let ((said (with-output-to-string (*standard-output*) (describe 'twice))))
                 (list (search \"(twice (name &optional (start 0)) &body forms)\" said) (search \"#:\" said))))",
            "(54 NIL)",
        ),
        ("(progn (defmacro both (a &key b) `(list ,a ,b)) (both 1 :b 2))", "(1 2)"),
        (
            "(let ((*package* (make-package :drawers :use '(:cl))))
               (eval (read-from-string \"(defun pull (handle &key (by 7) (how :softly)) (list handle by how))\"))
               (let ((said (with-output-to-string (*standard-output*) (let ((*package* (find-package :cl-user))) (describe (find-symbol \"PULL\" :drawers))))))
                 (numberp (search \"(pull handle &key (by 7) (how :softly))\" said))))",
            "T",
        ),
    ]);
}
