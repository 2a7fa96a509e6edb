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

#[test]
fn any_character_can_be_a_letter() {
    check(&[
        (
            "(let ((*readtable* (copy-readtable nil)) (names '())) (dolist (c '(#\\( #\\) #\\\" #\\' #\\` #\\, #\\; #\\# #\\| #\\\\)) (set-syntax-from-char c #\\a) (push (symbol-name (read-from-string (format nil \"x~cy\" c))) names)) (equal (reverse names) (mapcar (lambda (c) (format nil \"X~cY\" c)) '(#\\( #\\) #\\\" #\\' #\\` #\\, #\\; #\\# #\\| #\\\\))))",
            "T",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\' #\\a) (list (symbol-name (read-from-string \"'a\")) (progn (set-syntax-from-char #\\' #\\') (read-from-string \"'a\"))))",
            "(\"'A\" 'A)",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\! #\\#) (read-from-string \"(!'car !(1 2) !xff a!b)\"))",
            "(#'CAR #(1 2) 255 A!B) ; 23",
        ),
        (
            "(handler-case (set-syntax-from-char #\\! #\\| (copy-readtable nil)) (error () :no-escape))",
            ":NO-ESCAPE",
        ),
        // A copy has the letters, too; the original does not get those of the copy.
        (
            "(let* ((*readtable* (copy-readtable nil)) (copy (copy-readtable))) (set-syntax-from-char #\\; #\\a copy) (list (read-from-string \"a;b\") (let ((*readtable* (copy-readtable copy))) (symbol-name (read-from-string \"a;b\")))))",
            "(A \"A;B\")",
        ),
    ]);
}

#[test]
fn dispatching_characters_of_the_standard_syntax_are_replaced() {
    check(&[
        (
            "(let ((*readtable* (copy-readtable)))
               (set-dispatch-macro-character #\\# #\\\\ (lambda (s c n) (declare (ignore c)) (list n (read s t nil t))))
               (set-dispatch-macro-character #\\# #\\| (lambda (s c n) (declare (ignore s)) (list c n)))
               (set-dispatch-macro-character #\\# #\\x (lambda (s c n) (declare (ignore c n)) (read-char s t nil t)))
               (values (read-from-string \"(#\\\\latin #7\\\\b #3| #xff)\")))",
            "((NIL LATIN) (7 B) (#\\| 3) #\\f F)",
        ),
    ]);
}

#[test]
fn blanks_can_be_macro_characters() {
    check(&[
        (
            "(let ((*readtable* (copy-readtable)))
               (set-macro-character #\\Newline (lambda (s c) (declare (ignore s c)) :end-of-line))
               (with-input-from-string (s (format nil \"a b~%~%(c~%)\"))
                 (list (read s) (read s) (read s) (read s) (read s))))",
            "(A B :END-OF-LINE :END-OF-LINE (C :END-OF-LINE))",
        ),
        (
            "(let ((*readtable* (copy-readtable)))
               (set-syntax-from-char #\\Space #\\') (read-from-string \" x\"))",
            "'X ; 2",
        ),
    ]);
}

#[test]
fn a_cleared_character_dispatches_no_more_until_it_is_made_to() {
    check(&[
        (
            "(let ((rt (copy-readtable nil))) (set-syntax-from-char #\\# #\\A rt) (list (get-macro-character #\\# rt) (ignore-errors (get-dispatch-macro-character #\\# #\\x rt))))",
            "(NIL NIL)",
        ),
        (
            "(let ((rt (copy-readtable nil))) (set-syntax-from-char #\\# #\\A rt) (handler-case (get-dispatch-macro-character #\\# #\\x rt) (error () :no)))",
            ":NO",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\# #\\A) (make-dispatch-macro-character #\\# t) (set-dispatch-macro-character #\\# #\\! (lambda (s c n) (declare (ignore c n)) (list (read s t nil t)))) (list (read-from-string \"#!5\") (read-from-string \"#'car\")))",
            "((5) #'CAR)",
        ),
        (
            "(let ((rt (copy-readtable nil))) (set-syntax-from-char #\\( #\\A rt) (get-macro-character #\\( rt))",
            "NIL ; NIL",
        ),
    ]);
}
