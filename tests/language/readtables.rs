//! Readtables that programs change.

use super::standard::check;

#[test]
fn characters_are_given_the_syntax_of_others() {
    check(&[
        (
            "(let ((*readtable* (copy-readtable)))
               (set-syntax-from-char #\\, #\\space)
               (values (read-from-string \"(1, 2,3)\")))",
            "(1 2 3)",
        ),
        (
            "(let ((*readtable* (copy-readtable)))
               (set-syntax-from-char #\\[ #\\()
               (set-syntax-from-char #\\] #\\))
               (values (read-from-string \"(a 'b)\")))",
            "(A 'B)",
        ),
        (
            "(let ((*readtable* (copy-readtable)))
               (set-macro-character #\\! (lambda (s c) (declare (ignore c)) (list 'not (read s t nil t))))
               (set-syntax-from-char #\\! #\\a)
               (values (read-from-string \"a!b\")))",
            "A!B",
        ),
        (
            "(handler-case (read-from-string \"(1, 2)\") (reader-error () :comma))",
            ":COMMA",
        ),
    ]);
}

#[test]
fn standard_macro_characters_have_functions() {
    check(&[
        (
            "(list (functionp (get-macro-character #\\()) (functionp (get-macro-character #\\\"))
                   (get-macro-character #\\a)
                   (nth-value 1 (get-macro-character #\\#)))",
            "(T T NIL T)",
        ),
        (
            "(let ((*readtable* (copy-readtable)))
               (set-macro-character #\\{ (get-macro-character #\\'))
               (make-dispatch-macro-character #\\$)
               (set-dispatch-macro-character #\\$ #\\n (lambda (s c n) (declare (ignore c)) (list n (read s t nil t))))
               (values (read-from-string \"({a $3n b)\")))",
            "('A (3 B))",
        ),
    ]);
}
