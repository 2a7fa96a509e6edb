//! The debugger's hook, restarts of errors about packages, and forms that the reader leaves out.

use super::standard::check;

#[test]
fn the_debuggers_hook_is_called_instead_of_stopping() {
    check(&[
        (
            "(block nil
               (let ((*debugger-hook* (lambda (condition hook)
                                        (return (list (princ-to-string condition)
                                                      (functionp hook) *debugger-hook*)))))
                 (error \"lost\")))",
            "(\"lost\" T NIL)",
        ),
        (
            "(let ((*debugger-hook* (lambda (condition hook) (declare (ignore hook)) (use-value 4 condition))))
               (+ 1 not-bound-at-all))",
            "5",
        ),
        (
            "(let ((*debugger-hook* (lambda (condition hook) (declare (ignore condition hook)) 1))) (error \"still lost\"))",
            "!! still lost",
        ),
    ]);
}

#[test]
fn any_number_of_packages_is_made_and_deleted() {
    check(&[
        (
            "(progn (dotimes (i 70000) (delete-package (make-package \"PASSING\")))
                    (list (find-package \"PASSING\") (package-name (make-package \"PASSING\"))))",
            "(NIL \"PASSING\")",
        ),
        (
            "(let ((p (make-package \"GONE\" :nicknames '(\"G\"))))
               (delete-package p)
               (list (package-name p) (find-package \"G\") (delete-package p)
                     (package-name (make-package \"G\"))))",
            "(NIL NIL NIL \"G\")",
        ),
        (
            "(let ((p (make-package \"USED\")))
               (make-package \"USER\" :use '(\"USED\"))
               (handler-bind ((package-error #'continue)) (delete-package p))
               (list (package-use-list \"USER\") (find-package \"USED\")))",
            "(NIL NIL)",
        ),
    ]);
}

#[test]
fn errors_about_packages_can_be_continued() {
    let continued = |form: &str| {
        format!(
            "(handler-bind ((package-error (lambda (e) (declare (ignore e)) (continue)))) {form})"
        )
    };
    let cases = [
        ("(package-name (make-package \"COMMON-LISP\"))", "\"COMMON-LISP\""),
        ("(package-nicknames (make-package \"NEW-ONE\" :nicknames '(\"CL\" \"NEW-1\")))", "(\"NEW-1\")"),
        ("(delete-package \"NOT-THERE\")", "NIL"),
        (
            "(progn (defpackage :giver (:use)) (defpackage :taker (:use) (:import-from :giver #:gift))
                    (find-symbol \"GIFT\" :taker))",
            "GIVER::GIFT ; :INTERNAL",
        ),
    ];
    for (form, expected) in cases {
        check(&[(&continued(form), expected)]);
    }
    check(&[
        (
            "(make-package \"CL\")",
            "!! A package named \"CL\" already exists.",
        ),
        (
            "(delete-package \"NOT-THERE\")",
            "!! The name \"NOT-THERE\" does not designate any package.",
        ),
        (
            "(with-package-iterator (next :cl) (next))",
            "!! WITH-PACKAGE-ITERATOR takes kinds of symbols, :INTERNAL, :EXTERNAL or :INHERITED, not NIL.",
        ),
    ]);
}

#[test]
fn suppressed_forms_are_read_as_nil() {
    check(&[
        (
            "(let ((*read-suppress* t)) (read-from-string \"(a nowhere:b #.(car) 1/0)  c\"))",
            "NIL ; 26",
        ),
        (
            "(let ((*read-suppress* t)) (handler-case (read-from-string \"  \") (end-of-file () :end)))",
            ":END",
        ),
        (
            "(let ((*read-suppress* t)) (handler-case (read-from-string \"(a\") (end-of-file () :end)))",
            ":END",
        ),
    ]);
}
