//! Symbols that last as long as something refers to them, which may be code.

use super::standard::{check_in, locked_image};

#[test]
fn a_symbol_lasts_as_long_as_code_that_calls_it() {
    check_in(
        &mut locked_image(),
        &[
            (
                "(progn (defvar *f*) (let ((g (gensym))) (setf (symbol-function g) (lambda () 42)) (setf *f* (eval `(lambda () (,g))))) nil)",
                "NIL",
            ),
            (
                "(progn (tg:gc :full t) (dotimes (i 10) (gensym)) (funcall *f*))",
                "42",
            ),
            (
                "(progn (let ((g (gensym))) (setf *f* (eval `(lambda () (function ,g)))) (setf (symbol-function g) (lambda () 43))) nil)",
                "NIL",
            ),
            (
                "(progn (tg:gc :full t) (dotimes (i 10) (gensym)) (funcall (funcall *f*)))",
                "43",
            ),
            (
                "(progn (let ((g (gensym))) (setf *f* (eval `(lambda () (symbol-value ',g)))) (setf (symbol-value g) 44)) nil)",
                "NIL",
            ),
            (
                "(progn (tg:gc :full t) (dotimes (i 10) (gensym)) (funcall *f*))",
                "44",
            ),
            (
                "(progn (let ((g (gensym))) (setf *f* (eval `(lambda () (lambda (&key ((,g v) 7)) v)))) (setf *f* (list (funcall *f*) g))) nil)",
                "NIL",
            ),
            (
                "(progn (tg:gc :full t) (funcall (first *f*) (second *f*) 45))",
                "45",
            ),
            // What a macro makes is gone once it has been expanded.
            (
                "(progn (defmacro called () (let ((g (gensym))) (setf (symbol-function g) (lambda () 46)) `(,g))) (setf *f* (eval '(lambda () (called)))) (tg:gc :full t) (dotimes (i 10) (gensym)) (funcall *f*))",
                "46",
            ),
        ],
    );
}

#[test]
fn what_a_program_reads_lasts_as_long_as_it_is_in_its_package_or_referred_to() {
    check_in(
        &mut locked_image(),
        &[
            (
                "(progn (eval (read-from-string \"(defun read-late (read-x) (list :read-key read-x))\")) (tg:gc :full t) (dotimes (i 10) (gensym)) (read-late 1))",
                "(:READ-KEY 1)",
            ),
            (
                "(let ((s (read-from-string \"cl-user::read-only\"))) (setf (symbol-value s) 2) (tg:gc :full t) read-only)",
                "2",
            ),
            (
                "(let ((s (read-from-string \"read-removed\"))) (setf (get s 'a) s) (unintern s) (tg:gc :full t) (dotimes (i 10) (gensym)) (list (symbol-name s) (symbol-package s) (eq s (get s 'a)) (eq s (read-from-string \"read-removed\"))))",
                "(\"READ-REMOVED\" NIL T NIL)",
            ),
            (
                "(progn (defvar *code* (eval (read-from-string \"(lambda () 'read-in-code)\"))) (unintern (funcall *code*)) (tg:gc :full t) (dotimes (i 10) (gensym)) (symbol-name (funcall *code*)))",
                "\"READ-IN-CODE\"",
            ),
        ],
    );
}

#[test]
fn an_interned_symbol_lasts_after_it_has_been_removed_from_its_package() {
    check_in(
        &mut locked_image(),
        &[
            (
                "(let ((s (intern \"LASTING\"))) (setf (get s 'a) 1) (unintern s) (tg:gc :full t) (dotimes (i 10) (gensym)) (list (symbol-name s) (symbol-package s) (get s 'a)))",
                "(\"LASTING\" NIL 1)",
            ),
            // Found again, it is the same.
            (
                "(progn (setf (get (intern \"FOUND\") 'a) 2) (tg:gc :full t) (dotimes (i 10) (gensym)) (list (get (find-symbol \"FOUND\") 'a) (eq (intern \"FOUND\") (find-symbol \"FOUND\"))))",
                "(2 T)",
            ),
            ("(get (read-from-string \"found\") 'a)", "2"),
            ("(get 'found 'a)", "2"),
            (
                "(let ((read (read-from-string \"found\"))) (unintern (find-symbol \"FOUND\")) (tg:gc :full t) (dotimes (i 10) (gensym)) (list (symbol-name read) (get read 'a)))",
                "(\"FOUND\" 2)",
            ),
            (
                "(progn (make-package \"SHORT-LIVED\") (let ((s (intern \"IT\" \"SHORT-LIVED\"))) (delete-package \"SHORT-LIVED\") (tg:gc :full t) (dotimes (i 10) (gensym)) s))",
                "#:IT",
            ),
            (
                "(progn (make-package \"LISTED\") (intern \"IT\" \"LISTED\") (let ((all '())) (do-symbols (s \"LISTED\") (push s all)) (delete-package \"LISTED\") (tg:gc :full t) (dotimes (i 10) (gensym)) all))",
                "(#:IT)",
            ),
            (
                "(progn (make-package \"HOME\") (make-package \"AWAY\") (let ((s (intern \"GUEST\" \"HOME\"))) (setf (get s 'a) 3) (import s \"AWAY\")) (delete-package \"HOME\") (tg:gc :full t) (dotimes (i 10) (gensym)) (let ((s (find-symbol \"GUEST\" \"AWAY\"))) (list (symbol-name s) (get s 'a))))",
                "(\"GUEST\" 3)",
            ),
            (
                "(let ((s (intern \"SELF\"))) (setf (symbol-value s) (list s)) (unintern s) (tg:gc :full t) (eq s (first (symbol-value s))))",
                "T",
            ),
        ],
    );
}
