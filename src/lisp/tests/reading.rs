//! What the reader makes of tokens, structures and readtables.

use super::standard::check;

#[test]
fn structures_are_read_as_by_their_constructors() {
    check(&[
        ("(defstruct shelf (width 1) (height 2))", "SHELF"),
        (
            "(list #S(shelf :width 3 :width 4) #S(shelf \"HEIGHT\" 5))",
            "(#S(SHELF :WIDTH 3 :HEIGHT 2) #S(SHELF :WIDTH 1 :HEIGHT 5))",
        ),
        (
            "(list #S(shelf :allow-other-keys t :depth 6 :width 7) #S(shelf :height 8 :allow-other-keys nil :width 7))",
            "(#S(SHELF :WIDTH 7 :HEIGHT 2) #S(SHELF :WIDTH 7 :HEIGHT 8))",
        ),
        ("#S(shelf :depth 6)", "!! #S: DEPTH is no slot of SHELF"),
        (
            "#S(shelf 5 6)",
            "!! #S: slots are pairs of a name and a value",
        ),
    ]);
}

#[test]
fn what_symbols_cannot_have_is_an_error() {
    check(&[
        (
            "(read-from-string (coerce '(#\\a #\\Rubout) 'string))",
            "!! invalid constituent character: #\\Rubout",
        ),
        (
            "(read-from-string (coerce '(#\\Backspace #\\a) 'string))",
            "!! invalid constituent character: #\\Backspace",
        ),
        (
            "(length (symbol-name (read-from-string (coerce '(#\\| #\\Backspace #\\| #\\\\ #\\Rubout) 'string))))",
            "2",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (set-syntax-from-char #\\Tab #\\x) (read-from-string (coerce '(#\\Tab #\\a) 'string)))",
            "!! invalid constituent character: #\\Tab",
        ),
    ]);
}

#[test]
fn a_character_that_cannot_be_seen_is_named() {
    check(&[
        (
            "(read-from-string (coerce '(#\\# #\\1 #\\Newline) 'string))",
            "!! illegal sharp macro character: #\\Newline",
        ),
        (
            "(read-from-string (coerce '(#\\# #\\Backspace) 'string))",
            "!! no dispatch function defined for #\\Backspace",
        ),
    ]);
}

#[test]
fn a_readtable_is_copied_into_another_one() {
    check(&[
        (
            "(let ((from (copy-readtable nil)) (to (copy-readtable nil))) (set-macro-character #\\! (lambda (s c) s c :bang) nil from) (set-macro-character #\\? (lambda (s c) s c :what) nil to) (setf (readtable-case from) :preserve) (list (eq (copy-readtable from to) to) (readtable-case to) (let ((*readtable* to)) (list (read-from-string \"a!\") (read-from-string \"!\") (symbol-name (read-from-string \"?\"))))))",
            "(T :PRESERVE (|a| :BANG \"?\"))",
        ),
        (
            "(let ((to (copy-readtable nil))) (setf (readtable-case to) :invert) (list (eq (copy-readtable nil to) to) (readtable-case to) (eq (copy-readtable to nil) to)))",
            "(T :UPCASE NIL)",
        ),
    ]);
}

#[test]
fn what_is_left_out_needs_no_numbers() {
    check(&[
        (
            "(let ((*read-suppress* t)) (list (read-from-string \"#a(1 2) b\") (nth-value 1 (read-from-string \"#a(1 2) b\")) (read-from-string \"#=x\")))",
            "(NIL 8 NIL)",
        ),
        ("'(1 #+nowhere #a(1) 2)", "(1 2)"),
        (
            "(read-from-string \"#a(1 2)\")",
            "!! #A without the number of dimensions needs (DIMENSIONS TYPE . CONTENTS): its dimensions are not a list of natural numbers in the limits",
        ),
    ]);
}

#[test]
fn a_dot_that_is_left_out_is_a_form() {
    check(&[
        (
            "(let ((*read-suppress* t)) (read-from-string \".\"))",
            "NIL ; 1",
        ),
        (
            "(let ((*read-suppress* t)) (read-from-string \"#'. 1\"))",
            "NIL ; 4",
        ),
        ("'(1 #+nowhere (2 . 3) . 4)", "(1 . 4)"),
    ]);
}

#[test]
fn characters_have_the_names_that_are_told() {
    check(&[
        (
            "(loop for code below 256 for c = (code-char code) always (eql c (read-from-string (format nil \"#\\\\~a\" (char-name c)))))",
            "T",
        ),
        ("'#\\latin_small_letter_a", "#\\a"),
    ]);
}

#[test]
fn a_comment_cannot_begin_with_what_escapes() {
    check(&[(
        "(set-syntax-from-char #\\\\ #\\; (copy-readtable nil))",
        "!! #\\\\ cannot mean what #\\; means: it escapes other characters, or is a letter.",
    )]);
}
