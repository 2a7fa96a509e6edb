//! Forms that are not written as their operators want: each error says what was expected.

use super::standard::check;

#[test]
fn names_that_a_form_binds_twice_are_refused() {
    check(&[
        (
            "(let ((x 1) (x 2)) x)",
            "!! The variable X occurs more than once in the LET.",
        ),
        ("(let* ((x 1) (x (1+ x))) x)", "2"),
        (
            "(defun f (x x) x)",
            "!! The variable X occurs more than once in the lambda list (X X).",
        ),
        (
            "(lambda (a &optional (b 1 a)) a)",
            "!! The variable A occurs more than once in the lambda list (A &OPTIONAL (B 1 A)).",
        ),
        (
            "(lambda (a &key a) a)",
            "!! The variable A occurs more than once in the lambda list (A &KEY A).",
        ),
        ("(funcall (lambda (a &aux (a (list a))) a) 1)", "(1)"),
        (
            "(destructuring-bind (a a) '(1 2) a)",
            "!! The variable A occurs more than once in the lambda list (A A).",
        ),
        (
            "(defmacro m (x &rest x) x)",
            "!! The variable X occurs more than once in the lambda list (X &REST X).",
        ),
        (
            "(flet ((f () 1) (f () 2)) (f))",
            "!! The function F occurs more than once in the FLET.",
        ),
        (
            "(labels ((f () 1) (g () 3) (f () 2)) (f))",
            "!! The function F occurs more than once in the LABELS.",
        ),
        ("(flet (((setf f) (a b) a b) (f (x) x)) (f 1))", "1"),
        (
            "(macrolet ((m () 1) (m () 2)) (m))",
            "!! The macro M occurs more than once in the MACROLET.",
        ),
        (
            "(symbol-macrolet ((x 1) (x 2)) x)",
            "!! The name X occurs more than once in the SYMBOL-MACROLET.",
        ),
        (
            "(multiple-value-bind (a a) (floor 5 2) a)",
            "!! The variable A occurs more than once in the MULTIPLE-VALUE-BIND.",
        ),
        (
            "(tagbody a (print 1) a)",
            "!! The tag A occurs more than once in the TAGBODY.",
        ),
        (
            "(do ((i 0) (i 1)) (t i))",
            "!! The variable I occurs more than once in the LET.",
        ),
    ]);
}

#[test]
fn special_operators_say_what_they_take() {
    check(&[
        (
            "(quote a b)",
            "!! (QUOTE A B) is malformed: B is more than it takes. What was expected is (quote object).",
        ),
        (
            "(quote)",
            "!! (QUOTE) is malformed: object is missing. What was expected is (quote object).",
        ),
        (
            "(block)",
            "!! (BLOCK) is malformed: name is missing. What was expected is (block name body…).",
        ),
        (
            "(lambda)",
            "!! (LAMBDA) is malformed: lambda-list is missing. What was expected is (lambda lambda-list body…).",
        ),
        (
            "(unwind-protect)",
            "!! (UNWIND-PROTECT) is malformed: form is missing. What was expected is (unwind-protect form cleanup…).",
        ),
        (
            "(return-from f 1 2)",
            "!! (RETURN-FROM F 1 2) is malformed: 2 is more than it takes. What was expected is (return-from name [value]).",
        ),
        (
            "(the integer)",
            "!! (THE INTEGER) is malformed: form is missing. What was expected is (the type form).",
        ),
        (
            "(go)",
            "!! (GO) is malformed: tag is missing. What was expected is (go tag).",
        ),
        (
            "(catch)",
            "!! (CATCH) is malformed: tag is missing. What was expected is (catch tag body…).",
        ),
        (
            "(multiple-value-call)",
            "!! (MULTIPLE-VALUE-CALL) is malformed: function is missing. What was expected is (multiple-value-call function forms…).",
        ),
    ]);
}

#[test]
fn macros_say_what_they_take() {
    check(&[
        (
            "(push 1)",
            "!! (PUSH 1) is malformed: place is missing. What was expected is (push item place).",
        ),
        (
            "(dolist x '(1 2))",
            "!! (DOLIST X '(1 2)) is malformed: X stands where (variable list [result]) belongs. What was expected is (dolist (variable list [result]) body…).",
        ),
        (
            "(dolist (x) 1)",
            "!! (DOLIST (X) 1) is malformed: in (X), list is missing. What was expected is (dolist (variable list [result]) body…).",
        ),
        (
            "(dotimes (i 1 2 3) i)",
            "!! (DOTIMES (I 1 2 3) I) is malformed: in (I 1 2 3), 3 is more than it takes. What was expected is (dotimes (variable count [result]) body…).",
        ),
        (
            "(multiple-value-bind x (floor 5 2) x)",
            "!! (MULTIPLE-VALUE-BIND X (FLOOR 5 2) X) is malformed: X stands where (variables…) belongs. What was expected is (multiple-value-bind (variables…) form body…).",
        ),
        (
            "(pop)",
            "!! (POP) is malformed: place is missing. What was expected is (pop place).",
        ),
        (
            "(list (incf))",
            "!! (INCF) is malformed: place is missing. What was expected is (incf place [delta]).",
        ),
        (
            "(macroexpand-1 '(push 1))",
            "!! (PUSH 1) is malformed: place is missing. What was expected is (push item place).",
        ),
        (
            "(handler-bind (error #'print) 1)",
            "!! ERROR is not a binding of HANDLER-BIND: (type function) was expected; a pair of parentheses is missing around it.",
        ),
        (
            "(handler-case (error \"x\") error (e) 3)",
            "!! ERROR is not a clause of HANDLER-CASE: (type ([variable]) form…) was expected; a pair of parentheses is missing around it.",
        ),
        (
            "(handler-case (error \"x\") (error e 3))",
            "!! (ERROR E 3) is not a clause of HANDLER-CASE: (type ([variable]) form…) was expected.",
        ),
        (
            "(handler-case 1 (error (x y) 3))",
            "!! (ERROR (X Y) 3) is not a clause of HANDLER-CASE: (type ([variable]) form…) was expected.",
        ),
        (
            "(restart-case 1 (foo 3))",
            "!! (FOO 3) is not a clause of RESTART-CASE: (name (parameter…) form…) was expected.",
        ),
        (
            "(restart-case 1 2)",
            "!! 2 is not a clause of RESTART-CASE: (name (parameter…) form…) was expected; a pair of parentheses is missing around it.",
        ),
        (
            "(with-open-file x 1)",
            "!! (WITH-OPEN-FILE X 1) is malformed: X stands where (variable path options…) belongs. What was expected is (with-open-file (variable path options…) body…).",
        ),
        (
            "(when)",
            "!! Error while parsing arguments to DEFMACRO WHEN: too few elements in NIL to satisfy lambda list (TEST &BODY BODY): at least 1 expected, but got 0",
        ),
        // A macro of a program tells what it likes.
        (
            "(progn (defmacro own (x) (car x)) (handler-case (eval '(own 5)) (type-error () :own)))",
            ":OWN",
        ),
    ]);
}

#[test]
fn slots_without_parentheses_are_refused() {
    let told = "!! The name :INITARG of a slot in DEFCLASS is a keyword. A slot with options is a list of its own: ((x :initarg :x)).";
    check(&[
        ("(defclass pt () (x :initarg :x))", told),
        (
            "(defclass pt () ((x :initarg :x)))",
            "#<STANDARD-CLASS COMMON-LISP-USER::PT>",
        ),
        (
            "(defclass pt () (t))",
            "!! The name T of a slot in DEFCLASS is a constant. A slot with options is a list of its own: ((x :initarg :x)).",
        ),
    ]);
}

#[test]
fn constants_keep_their_values() {
    check(&[
        ("(progn (defconstant +a+ 1) (defconstant +a+ 1) +a+)", "1"),
        (
            "(progn (defconstant +l+ '(1 2)) (defconstant +l+ (list 1 2)) +l+)",
            "(1 2)",
        ),
        (
            "(handler-case (defconstant +a+ 2) (error (e) (princ-to-string e)))",
            "\"The constant +A+ has the value 1; DEFCONSTANT would give it 2.\"",
        ),
        ("+a+", "1"),
        (
            "(handler-bind ((error #'continue)) (defconstant +a+ 2))",
            "+A+",
        ),
        ("+a+", "2"),
    ]);
}

#[test]
fn numbers_with_commas_and_dashes_say_what_to_write() {
    check(&[
        ("(+ 0,9 1)", "!! 0,9 has a decimal comma; Lisp writes 0.9"),
        (
            "(list -12,50)",
            "!! -12,50 has a decimal comma; Lisp writes -12.50",
        ),
        ("(list a,b)", "!! Comma not inside a backquote."),
        ("`(0 ,(+ 1 2))", "(0 3)"),
        (
            "(+ \u{2212}1 2)",
            "!! \u{2212}1 is written with \u{2212} (U+2212), which is no minus sign of Lisp; write -1",
        ),
        (
            "(list \u{2013}0.5)",
            "!! \u{2013}0.5 is written with \u{2013} (U+2013), which is no minus sign of Lisp; write -0.5",
        ),
        (
            "(list 1e\u{2212}3)",
            "!! 1e\u{2212}3 is written with \u{2212} (U+2212), which is no minus sign of Lisp; write 1e-3",
        ),
        ("'a\u{2013}b", "A\u{2013}B"),
    ]);
}

#[test]
fn conditions_print_with_their_message() {
    check(&[
        (
            "(subseq (prin1-to-string (make-condition 'simple-error :format-control \"x ~a\" :format-arguments '(1))) 0 22)",
            "\"#<SIMPLE-ERROR \\\"x 1\\\" {\"",
        ),
        (
            "(let ((text (handler-case (car 5) (error (e) (prin1-to-string e))))) (subseq text 0 (position #\\{ text)))",
            "\"#<TYPE-ERROR \\\"The value 5 is not of type LIST\\\" \"",
        ),
        (
            "(search \"\\\"\" (prin1-to-string (make-condition 'error)))",
            "NIL",
        ),
        // A condition that contains itself prints.
        (
            "(let ((c (make-condition 'simple-error :format-control \"~s\" :format-arguments (list 1)))) (setf (slot-value c 'system::format-arguments) (list c)) (search \"\\\"\" (prin1-to-string c)))",
            "NIL",
        ),
        (
            "(length (let ((text (prin1-to-string (make-condition 'simple-error :format-control (make-string 500 :initial-element #\\x))))) (subseq text (position #\\\" text) (position #\\\" text :from-end t))))",
            "81",
        ),
        (
            "(princ-to-string (make-condition 'simple-error :format-control \"x\"))",
            "\"x\"",
        ),
    ]);
}
