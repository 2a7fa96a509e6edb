//! Printers that programs write for the pretty printer.

use super::standard::check;

/// How plans are printed in these tests: the operator, then its forms below each other.
const PLANS: &str = "(defun print-plan (stream form)
  (pprint-logical-block (stream form :prefix \"[\" :suffix \"]\")
    (write (pprint-pop) :stream stream)
    (pprint-indent :block 2 stream)
    (loop
      (pprint-exit-if-list-exhausted)
      (write-char #\\Space stream)
      (pprint-newline :linear stream)
      (write (pprint-pop) :stream stream))))";

/// A form with a dispatch table for plans, whose value is shown with `|` for line breaks.
fn printed(bindings: &str, object: &str) -> String {
    format!(
        "(let ((*print-pprint-dispatch* (copy-pprint-dispatch nil)) (*print-right-margin* 24) {bindings})
           (set-pprint-dispatch '(cons (member seq par)) 'print-plan)
           (substitute #\\| #\\Newline (write-to-string '{object} :pretty t)))"
    )
}

#[test]
fn plans_are_printed_by_functions_of_the_dispatch_table() {
    let plan = "(foo (seq (move 1 2 3) (par (grasp cup) (look table)) . end))";
    check(&[
        (PLANS, "PRINT-PLAN"),
        (
            &printed("", plan),
            "\"(FOO| [SEQ| (MOVE 1 2 3)| [PAR| (GRASP CUP)| (LOOK TABLE)]| . END])\"",
        ),
        (&printed("", "(seq a b)"), "\"[SEQ A B]\""),
        (
            &printed("(*print-level* 2)", plan),
            "\"(FOO [SEQ # # . END])\"",
        ),
        (
            &printed("(*print-length* 2)", plan),
            "\"(FOO| [SEQ (MOVE 1 ...) ...])\"",
        ),
        (
            "(let ((*print-pprint-dispatch* (copy-pprint-dispatch)))
               (set-pprint-dispatch '(cons (member seq)) 'print-plan)
               (list (write-to-string '(seq a)) (write-to-string '(seq a) :pprint-dispatch (copy-pprint-dispatch nil))
                     (progn (set-pprint-dispatch '(cons (member seq)) nil) (write-to-string '(seq a)))))",
            "(\"[SEQ A]\" \"(SEQ A)\" \"(SEQ A)\")",
        ),
    ]);
}

#[test]
fn of_functions_for_an_object_that_of_the_highest_priority_prints() {
    check(&[(
        "(let ((*print-pprint-dispatch* (copy-pprint-dispatch nil)))
           (set-pprint-dispatch 'integer (lambda (s n) (format s \"<~a>\" (evenp n))) 1)
           (set-pprint-dispatch '(eql 5) (lambda (s n) (declare (ignore n)) (write-string \"five\" s)) 2)
           (prin1-to-string '(4 5 a)))",
        "\"(<T> five A)\"",
    )]);
}

#[test]
fn blocks_in_format_have_prefixes_per_line_tabs_and_dotted_ends() {
    check(&[
        (
            "(let ((*print-right-margin* 20)) (substitute #\\| #\\Newline (format nil \"~@<;; ~@;~a ~_~a~:>\" \"first second\" \"third fourth fifth\")))",
            "\";; first second|;; third fourth fifth\"",
        ),
        ("(format nil \"~:<~w~^ ~w~:>\" '(a . b))", "\"(A . B)\""),
        (
            "(let ((*print-length* 2)) (format nil \"~:<~@{~w~^ ~}~:>\" '(a b)))",
            "\"(A B)\"",
        ),
        (
            "(let ((*print-right-margin* 20)) (substitute #\\| #\\Newline (format nil \"~:/pprint-tabular/\" '(0 1 2 3))))",
            "\"(0 1| 2 3)\"",
        ),
    ]);
}

#[test]
fn methods_of_print_object_are_laid_out_with_what_is_around_them() {
    check(&[
        ("(defclass mug () ())", "#<STANDARD-CLASS COMMON-LISP-USER::MUG>"),
        (
            "(defmethod print-object ((mug mug) stream)
               (pprint-logical-block (stream nil :prefix \"<\" :suffix \">\")
                 (princ \"sizes\" stream) (write-char #\\Space stream)
                 (pprint-newline :linear stream) (princ 2 stream)))
             (let ((*print-right-margin* 12))
               (substitute #\\| #\\Newline (prin1-to-string (list (make-instance 'mug) 1 (make-instance 'mug)))))",
            "\"(<sizes 2>| 1| <sizes 2>)\"",
        ),
    ]);
}

#[test]
fn a_type_of_the_dispatch_table_that_is_unknown_is_passed_over() {
    check(&[(
        "(let ((*print-pprint-dispatch* (copy-pprint-dispatch nil)))
           (set-pprint-dispatch '(no-such-type) 'princ)
           (prin1-to-string '(1 2)))",
        "\"(1 2)\"",
    )]);
}

#[test]
fn mistakes_in_what_is_printed_prettily_are_errors() {
    check(&[
        (
            "(pprint-newline :never)",
            "!! The value of SYSTEM::KIND is :NEVER, which is not of type (MEMBER :LINEAR :FILL :MISER :MANDATORY).",
        ),
        (
            "(pprint-pop)",
            "!! PPRINT-POP belongs inside PPRINT-LOGICAL-BLOCK.",
        ),
        (
            "(let ((list (list 1 2))) (setf (cddr list) list) (let ((*print-circle* t)) (with-output-to-string (s) (pprint-fill s list))))",
            "\"#1=(1 2 . #1#)\"",
        ),
    ]);
}

#[test]
fn types_that_a_call_decides_are_found_in_the_dispatch_table() {
    check(&[
        (
            "(let ((*print-pprint-dispatch* (copy-pprint-dispatch nil)) (*print-pretty* t))
               (set-pprint-dispatch '(and integer (satisfies evenp)) (lambda (stream n) (declare (ignore n)) (write-string \"even\" stream)))
               (prin1-to-string '(1 2 (3 4) #(5 6))))",
            "\"(1 even (3 even) #(5 even))\"",
        ),
    ]);
}

#[test]
fn each_dimension_of_an_array_is_a_level() {
    check(&[
        (
            "(let ((*print-level* 2)) (prin1-to-string (make-array '(2 2 2) :initial-element 0)))",
            "\"#3A((# #) (# #))\"",
        ),
        (
            "(let ((*print-level* 0)) (prin1-to-string (make-array '(1 1) :initial-element 0)))",
            "\"#2A#\"",
        ),
        (
            "(let ((*print-level* 2)) (prin1-to-string (make-array '(1 1) :initial-element '(1))))",
            "\"#2A((#))\"",
        ),
    ]);
}

#[test]
fn elements_of_logical_blocks_share_labels() {
    let circle = |form: &str| format!("(let ((*print-circle* t) (*print-pretty* t)) {form})");
    check(&[
        (
            &circle("(let ((x (list 'a))) (list (with-output-to-string (s) (pprint-fill s (list x x)))
                                               (with-output-to-string (s) (pprint-linear s (list x 'b x)))
                                               (format nil \"~:<~@{~A~^ ~}~:>\" (list x x))))"),
            "(\"(#1=(A) #1#)\" \"(#1=(A) B #1#)\" \"(#1=(A) #1#)\")",
        ),
        (
            &circle("(let* ((x (list 8)) (list (list x x)))
                       (with-output-to-string (s)
                         (pprint-logical-block (s list :prefix \"<\" :suffix \">\")
                           (dotimes (i 2) (pprint-logical-block (s (pprint-pop) :prefix \"[\" :suffix \"]\") (prin1 (pprint-pop) s))))))"),
            "\"<#1=[8]#1#>\"",
        ),
        (
            &circle("(let ((x (list 1 2))) (setf (cddr x) x)
                       (list (with-output-to-string (s) (pprint-fill s x)) (format nil \"~:<~@{~A~^ ~}~:>\" x)))"),
            "(\"#1=(1 2 . #1#)\" \"#1=(1 2 . #1#)\")",
        ),
        (
            &circle("(let ((x (list 0))) (format nil \"~:<~@{~A~^ ~}~:>\" (cons x x)))"),
            "\"(#1=(0) . #1#)\"",
        ),
        // What a method prints inside something with labels has none of the same numbers.
        (
            &circle("(progn (defclass pair () ((part :initform (list 1) :reader part)))
                            (defmethod print-object ((p pair) s) (pprint-fill s (list (part p) (part p))))
                            (let ((p (make-instance 'pair))) (list (prin1-to-string p) (prin1-to-string (list p p)))))"),
            "(\"(#1=(1) #1#)\" \"(#1=((1) (1)) #1#)\")",
        ),
        ("(format nil \"~:<~@{~A~^ ~}~:>\" '(1 2 . 3))", "\"(1 2 . 3)\""),
        ("(let ((x (list 'a))) (with-output-to-string (s) (pprint-fill s (list x x))))", "\"((A) (A))\""),
    ]);
}
