//! Corners of the language that libraries come upon.

use super::standard::check;

#[test]
fn the_readers_own_functions_can_be_set_and_wrapped() {
    check(&[
        (
            "(let ((*readtable* (copy-readtable))) (set-macro-character #\\( (get-macro-character #\\()) (read-from-string \"(1 (2))\"))",
            "(1 (2)) ; 7",
        ),
        (
            "(let ((*readtable* (copy-readtable))) (set-macro-character #\\{ (get-macro-character #\\()) (read-from-string \"{1 {2))\"))",
            "(1 (2)) ; 7",
        ),
        (
            "(let* ((*readtable* (copy-readtable)) (own (get-macro-character #\\())) (set-macro-character #\\( (lambda (s c) (cons 'list (funcall own s c)))) (read-from-string \"(1 (2) '(3))\"))",
            "(LIST 1 (LIST 2) '(LIST 3)) ; 12",
        ),
        (
            "(let ((*readtable* (copy-readtable))) (set-dispatch-macro-character #\\# #\\' (get-dispatch-macro-character #\\# #\\')) (read-from-string \"(#'car #'cdr)\"))",
            "(#'CAR #'CDR) ; 13",
        ),
        (
            "(let ((*readtable* (copy-readtable))) (dolist (c (coerce \"()'`,;\\\"\" 'list)) (set-macro-character c (get-macro-character c))) (eval (read-from-string \"`(1 ,(+ 1 1) \\\"a\\\" 'b) ; c\")))",
            "(1 2 \"a\" 'B)",
        ),
        (
            "(let ((*readtable* (copy-readtable))) (set-macro-character #\\# (get-macro-character #\\#) t) (read-from-string \"#(1 #c(1 2))\"))",
            "#(1 #C(1 2)) ; 12",
        ),
        (
            "(let ((*readtable* (copy-readtable))) (set-macro-character #\\} (get-macro-character #\\))) (handler-case (read-from-string \"}\") (reader-error (e) (princ-to-string e))))",
            "\"} closes nothing.\"",
        ),
    ]);
}

#[test]
fn types_are_defined_with_documentation_and_declarations() {
    check(&[
        (
            "(deftype small (&optional (n 3)) \"Small ones.\" (declare (ignorable n)) `(integer 0 ,n))",
            "SMALL",
        ),
        (
            "(list (typep 2 'small) (typep 4 'small) (typep 4 '(small 9)))",
            "(T NIL T)",
        ),
        ("(documentation 'small 'type)", "\"Small ones.\""),
        ("(deftype text () \"Only a text.\" 'string)", "TEXT"),
        ("(typep \"a\" 'text)", "T"),
        ("(progn (deftype alone () \"no other form\") 1)", "1"),
        (
            "(progn (defun set-second (l v) (setf (second l) v)) (defsetf my-second (l) (v) \"Sets.\" (declare (ignorable l)) `(set-second ,l ,v)) (let ((l (list 1 2))) (setf (my-second l) 5) l))",
            "(1 5)",
        ),
    ]);
}

#[test]
fn local_macros_see_what_surrounds_them() {
    check(&[
        (
            "(symbol-macrolet ((x 5)) (macrolet ((m () (list 'quote (list x)))) (m)))",
            "(5)",
        ),
        ("(macrolet ((a () 7)) (macrolet ((b () (a))) (b)))", "7"),
        (
            "(symbol-macrolet ((x 5)) (let ((x 1)) (declare (ignorable x)) (handler-case (eval '(macrolet ((m () x)) (m))) (unbound-variable () :unbound))))",
            ":UNBOUND",
        ),
        (
            "(symbol-macrolet ((x 5)) (symbol-macrolet ((x 6)) (macrolet ((m () x)) (m))))",
            "6",
        ),
        (
            "(macrolet ((a () 7)) (flet ((a () 8)) (list (a) (macrolet ((b () 1)) (b)))))",
            "(8 1)",
        ),
    ]);
}

#[test]
fn psetf_sets_several_values() {
    check(&[
        (
            "(let ((a 1) (b 2) c d) (psetf (values a b) (values b a) (values c d) (floor 7 2)) (list a b c d))",
            "(2 1 3 1)",
        ),
        (
            "(let ((a 1) (b 2)) (list (psetf a b b a) a b))",
            "(NIL 2 1)",
        ),
        (
            "(let ((a 1) (b 2) (c 3)) (psetf a c (values b c) (values a b)) (list a b c))",
            "(3 1 2)",
        ),
        (
            "(let ((l (list 1 2)) (n 0)) (psetf (nth (incf n) l) n (values) (incf n)) (list l n))",
            "((1 1) 2)",
        ),
    ]);
}

#[test]
fn features_that_do_not_matter_are_not_understood() {
    check(&[
        ("(list #+(and foo (version>= 1 2)) 1 2)", "(2)"),
        ("(list #+(or planwright (version>= 1 2)) 1 2)", "(1 2)"),
        ("(list #-(and foo (version>= 1 2)) 1 2)", "(1 2)"),
        ("(list #+(and) 1 #+(or) 2)", "(1)"),
        (
            "(list #+(and planwright (version>= 1 2)) 1 2)",
            "!! illegal feature expression",
        ),
    ]);
}

#[test]
fn large_floats_are_written_with_zeros() {
    check(&[
        (
            "(format nil \"~,2f\" 1d23)",
            "\"100000000000000000000000.00\"",
        ),
        (
            "(format nil \"~,2f\" -1d23)",
            "\"-100000000000000000000000.00\"",
        ),
        (
            "(format nil \"~,0f\" 1d23)",
            "\"100000000000000000000000.\"",
        ),
        (
            "(format nil \"~$\" 1d23)",
            "\"100000000000000000000000.00\"",
        ),
        (
            "(format nil \"~,2f\" 123456789012345678d0)",
            "\"123456789012345680.00\"",
        ),
        (
            "(format nil \"~,2f ~,1f ~,3f\" 1.005d0 2.5 1/3)",
            "\"1.00 2.5 0.333\"",
        ),
    ]);
}
