//! What is printed under the printer's variables, and by the directives of `format`.

use super::standard::check;

#[test]
fn symbols_without_a_package_have_labels() {
    check(&[
        (
            "(let ((s (make-symbol \"CUP\")) (*print-circle* t)) (prin1-to-string (list s 'a s (make-symbol \"CUP\") 'a)))",
            "\"(#1=#:CUP A #1# #:CUP A)\"",
        ),
        (
            "(let ((s (make-symbol \"CUP\")) (*print-circle* t)) (princ-to-string (vector s s)))",
            "\"#(CUP CUP)\"",
        ),
        (
            "(let ((s (make-symbol \"CUP\")) (*print-circle* t) (*print-gensym* nil)) (prin1-to-string (cons s s)))",
            "\"(CUP . CUP)\"",
        ),
        (
            "(let* ((s (make-symbol \"CUP\")) (*print-circle* t) (read (read-from-string (prin1-to-string (list s s))))) (eq (first read) (second read)))",
            "T",
        ),
    ]);
}

#[test]
fn what_is_readable_is_read_by_the_standard_readtable() {
    check(&[
        (
            "(let ((*readtable* (copy-readtable nil))) (setf (readtable-case *readtable*) :downcase) (list (write-to-string '|cup| :readably t) (write-to-string '|cup| :readably nil) (write-to-string 'cup :readably t)))",
            "(\"|cup|\" \"CUP\" \"CUP\")",
        ),
        (
            "(write-to-string (make-array '(0 3)) :readably t)",
            "!! #2A() cannot be printed readably.",
        ),
        (
            "(list (write-to-string (make-array '(2 0)) :readably t) (write-to-string (make-array '(0 0)) :readably t) (write-to-string (make-array '(0 3)) :readably nil))",
            "(\"#2A(() ())\" \"#2A()\" \"#2A()\")",
        ),
    ]);
}

#[test]
fn structures_without_slots_are_never_too_deep() {
    check(&[(
        "(progn (defstruct lid) (defstruct pot (lid (make-lid))) (list (write-to-string (make-lid) :level 0) (write-to-string (make-pot) :level 0) (write-to-string (make-pot) :level 1) (write-to-string (list (make-pot)) :level 2)))",
        "(\"#S(LID)\" \"#\" \"#S(POT :LID #S(LID))\" \"(#S(POT :LID #S(LID)))\")",
    )]);
}

#[test]
fn standard_syntax_covers_package_and_reader() {
    check(&[
        (
            "(let ((*package* (find-package \"KEYWORD\")) (*read-suppress* t)) (with-standard-io-syntax (list (package-name *package*) *read-suppress* (read-from-string \"cup\"))))",
            "(\"COMMON-LISP-USER\" NIL CUP)",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (set-macro-character #\\! (lambda (s c) s c :bang)) (setf (readtable-case *readtable*) :invert) (list (read-from-string \"!\") (with-standard-io-syntax (symbol-name (read-from-string \"!a\")))))",
            "(:BANG \"!A\")",
        ),
    ]);
}

#[test]
fn lines_are_filled_inside_iterations_and_after_groups_of_blanks() {
    let filled = |margin: usize, call: &str| {
        format!(
            "(let ((*print-pretty* t) (*print-right-margin* {margin})) (substitute #\\_ #\\Space (substitute #\\| #\\Newline {call})))"
        )
    };
    check(&[
        (
            &filled(8, "(format nil \"~:@<~@{~a~^ ~}~:@>\" 'cup 'bowl 'milk)"),
            "\"(CUP|_BOWL|_MILK)\"",
        ),
        (
            &filled(14, "(format nil \"~:@<~@{~a~^ ~}~:@>\" 'cup 'bowl 'milk)"),
            "\"(CUP_BOWL|_MILK)\"",
        ),
        (
            &filled(9, "(format nil \"~@<; ~@;take    the   ~a~:@>\" 'cup)"),
            "\";_take|;_the|;_CUP\"",
        ),
        // A control that is an argument is not filled, nor a block inside.
        (
            &filled(4, "(format nil \"~@<~@?~:@>\" \"~a b c\" 'a)"),
            "\"A_b_c\"",
        ),
        (
            &filled(4, "(format nil \"~@<~<~a b c~:>~:@>\" '(a))"),
            "\"A_b_c\"",
        ),
    ]);
}

#[test]
fn justification_excludes_the_pretty_printer() {
    const WRONG: &str = "~W, ~_, ~I, ~:T and ~<...~:> cannot be inside ~<...~>, nor in a control string with ~<...~:;...~>.";
    for control in [
        "~<a~_b~>",
        "~<a~w~>",
        "~<a~{~i~}~>",
        "~<a~4,2:tb~>",
        "~<a~<b~:>~>",
        "~w~<a~:;b~>",
        "~<a~:;b~>~<c~:>",
    ] {
        // The report shows the control string, too.
        let form = format!(
            "(handler-case (format nil {control:?} '(1) '(2)) (error (e) (not (null (search {WRONG:?} (princ-to-string e))))))"
        );
        check(&[(&form, "T")]);
    }
    check(&[
        // A column of the line is allowed, and layout beside justification without `~:;`.
        (
            "(substitute #\\_ #\\Space (format nil \"~<a~6tb~>~_~6<c~>~w\" 1))",
            "\"a_____b_____c1\"",
        ),
        ("(format nil \"~<a~;b~:;c~>~w\" 1)", "\"abc1\""),
        // A single text is not kept apart from others.
        (
            "(list (format nil \"~2,,3,'_<cups~>\") (format nil \"~6,,1,'_<cups~>\") (format nil \"~2,,3,'_:<cups~>\") (format nil \"~2,,3,'_@<cups~>\") (format nil \"~2,,3,'_<a~;b~>\"))",
            "(\"cups\" \"__cups\" \"___cups\" \"cups___\" \"a___b\")",
        ),
    ]);
}

#[test]
fn functions_are_bodies_of_iterations() {
    check(&[
        (
            "(list (format nil \"~{~}\" (formatter \"<~a>\") '(1 2 3)) (format nil \"~2{~}\" (formatter \"<~a>\") '(1 2 3)) (format nil \"~{~:}\" (formatter \"<~a>\") '(1)))",
            "(\"<1><2><3>\" \"<1><2>\" \"<1>\")",
        ),
        (
            "(list (format nil \"~@{~}\" (formatter \"~a~^,\") 1 2 3) (format nil \"~:{~}\" (formatter \"~a-~a.\") '((1 2 3) (4 5))) (format nil \"~{~}\" (formatter \"x\") '()) (format nil \"~{~:}\" (formatter \"x\") '()))",
            "(\"1,2,3\" \"1-2.4-5.\" \"\" \"x\")",
        ),
        (
            "(format nil \"~{~}\" (formatter \"x\") '(1))",
            "!! The iteration uses no argument, so it would never end.",
        ),
    ]);
}

#[test]
fn characters_and_tabs_of_format_follow_the_standard() {
    check(&[
        (
            "(list (format nil \"~:c\" (code-char 233)) (format nil \"~:c\" #\\Space) (format nil \"~:c\" #\\Tab) (format nil \"~:c\" #\\a))",
            "(\"é\" \"Space\" \"Tab\" \"a\")",
        ),
        (
            "(substitute #\\_ #\\Space (with-output-to-string (s) (let ((*print-pretty* t)) (pprint-logical-block (s nil) (let ((*print-pretty* nil)) (format s \"a~8:tb~6tc\"))))))",
            "\"ab____c\"",
        ),
    ]);
}

#[test]
fn an_unreadable_object_without_contents_has_its_blanks() {
    check(&[
        (
            "(with-output-to-string (s) (print-unreadable-object (nil s :type t)))",
            "\"#<NULL >\"",
        ),
        (
            "(with-output-to-string (s) (print-unreadable-object (nil s :type t) (princ 1 s)))",
            "\"#<NULL 1>\"",
        ),
        (
            "(let ((text (with-output-to-string (s) (print-unreadable-object ((list 1) s :identity t))))) (list (subseq text 0 4) (char text (1- (length text)))))",
            "(\"#< {\" #\\>)",
        ),
        (
            "(subseq (with-output-to-string (s) (print-unreadable-object ((list 1) s :type t :identity t))) 0 8)",
            "\"#<CONS {\"",
        ),
    ]);
}

#[test]
fn arrays_printed_readably_keep_their_element_types() {
    let printed = |array: &str| format!("(let ((*print-readably* t)) (prin1-to-string {array}))");
    check(&[
        (
            &printed("(make-array 2 :element-type '(unsigned-byte 8))"),
            "\"#A((2) (UNSIGNED-BYTE 8) 0 0)\"",
        ),
        (
            &printed("(make-array '(2 1) :element-type 'double-float :initial-element 1d0)"),
            "\"#A((2 1) DOUBLE-FLOAT (1.0d0) (1.0d0))\"",
        ),
        (
            &printed("(make-array nil :element-type 'bit)"),
            "\"#A(NIL BIT . 0)\"",
        ),
        (&printed("(vector 1 2)"), "\"#(1 2)\""),
        (
            "(let ((*print-base* 16) (*read-base* 16) (*print-readably* t)) (let ((a (read-from-string (prin1-to-string (make-array '(12 1) :element-type 'fixnum :initial-element 31))))) (list (array-dimensions a) (array-element-type a) (aref a 0 0))))",
            "((12 1) FIXNUM 31)",
        ),
        // Without elements, all dimensions show, and their product does not matter.
        (
            "(with-standard-io-syntax (prin1-to-string (make-array '(0 33554432 33554432 33554432) :element-type 'bit)))",
            "\"#A((0 33554432 33554432 33554432) BIT)\"",
        ),
        (
            "(array-dimensions (read-from-string \"#A((0 2) bit)\"))",
            "(0 2)",
        ),
        (
            "(read-from-string \"#A((0 33554433) bit)\")",
            "!! #A without the number of dimensions needs (DIMENSIONS TYPE . CONTENTS): its dimensions are not a list of natural numbers in the limits",
        ),
        (
            "(read-from-string \"#A 5\")",
            "!! #A without the number of dimensions needs (DIMENSIONS TYPE . CONTENTS): it is not such a list",
        ),
        ("#A((2) (unsigned-byte 8) 1 2)", "#(1 2)"),
        (
            "(type-of #A((2) (unsigned-byte 8) 1 2))",
            "(SIMPLE-ARRAY (UNSIGNED-BYTE 8) (2))",
        ),
        ("#A((2) character #\\a #\\b)", "\"ab\""),
        (
            "(read-from-string \"#A((2) bit 1 2)\")",
            "!! #A without the number of dimensions needs (DIMENSIONS TYPE . CONTENTS): it has elements of another type",
        ),
    ]);
}
