//! What the standard says, form by form: none of these may be silently wrong.

use crate::evaluator::nested;
use crate::image::Image;
use crate::print;
use crate::reader::{Outcome, Reader};
use crate::value::{Value, known};
use crate::vm::fiber::Fiber;
use crate::vm::machine::{Event, Machine};

/// A value as a function of the language prints it.
fn printed(image: &mut Image, value: &Value, function: crate::Sym) -> String {
    nested::call_nested(image, function.into(), vec![value.clone()])
        .ok()
        .and_then(|text| text.as_text())
        .unwrap_or_else(|| print::to_string(image, value, true))
}

/// What a prompt prints for the values of the last form, or the report of the condition.
fn shown(image: &mut Image, text: &str) -> String {
    let source = image.sources.add("test", text);
    let mut reader = Reader::new(image, source);
    let mut last = String::new();
    loop {
        let mut next = reader.next(image);
        while let Ok(Outcome::Evaluate(form)) = next {
            let value = nested::call_nested(image, known::EVAL.into(), vec![form]);
            next = reader.supply(image, value.unwrap_or(Value::NIL));
        }
        let form = match next {
            Ok(Outcome::Form(form, _)) => form,
            Ok(Outcome::End | Outcome::Evaluate(_)) => break,
            Err(error) => {
                last = format!("!! {error}");
                break;
            }
        };
        let mut fiber = Fiber::default();
        let mut event = Machine::new(image, &mut fiber).start(known::EVAL.into(), vec![form]);
        last = loop {
            match event {
                Event::Done(value) => {
                    let values = value.into_values();
                    let values = values.iter();
                    let values = values.map(|v| printed(image, v, known::PRIN1_TO_STRING));
                    break values.collect::<Vec<_>>().join(" ; ");
                }
                Event::Unhandled(condition) => {
                    let report = printed(image, &condition, known::PRINC_TO_STRING);
                    Machine::new(image, &mut fiber).unwind_all();
                    break format!("!! {report}");
                }
                Event::Output => event = Machine::new(image, &mut fiber).run(),
                Event::Request(_) | Event::Interrupted | Event::Unwound => {
                    Machine::new(image, &mut fiber).unwind_all();
                    break String::new();
                }
            }
        };
    }
    last.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// An image with package locks, as sessions have them.
pub(super) fn locked_image() -> Image {
    let mut image = Image::new();
    image.lock_packages(&["COMMON-LISP-USER"]);
    image
}

/// Checks pairs of forms and what they show.
pub(super) fn check(cases: &[(&str, &str)]) {
    check_in(&mut Image::new(), cases);
}

/// Checks pairs of forms and what they show in an image.
pub(super) fn check_in(image: &mut Image, cases: &[(&str, &str)]) {
    let mut wrong = Vec::new();
    for (form, expected) in cases {
        let got = shown(image, form);
        if got != *expected {
            wrong.push(format!("{form}\n  gives {got}\n  not   {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn parts_of_places_are_evaluated_from_left_to_right() {
    check(&[
        (
            "(let ((v (vector 0 0 0 0 0)) (i 1)) (incf (aref v (incf i)) (incf i)) v)",
            "#(0 0 3 0 0)",
        ),
        (
            "(let ((v (vector 0 0 0 0 0)) (i 1)) (decf (aref v (incf i)) (incf i)) v)",
            "#(0 0 -3 0 0)",
        ),
        (
            "(let ((l (list nil nil nil)) (i 0)) (push (incf i) (nth (incf i) l)) l)",
            "(NIL NIL (1))",
        ),
        (
            "(let ((l (list nil nil nil)) (i 0)) (push i (nth (incf i) l)) l)",
            "(NIL (0) NIL)",
        ),
        (
            "(let ((l (list nil nil nil)) (i 0)) (pushnew (incf i) (nth (incf i) l) :test (progn (incf i) #'eql)) (list l i))",
            "((NIL NIL (1)) 3)",
        ),
        (
            "(progn (define-modify-macro times (n) *) (let ((v (vector 1 2 3 4)) (i 0)) (times (aref v (incf i)) (incf i)) v))",
            "#(1 4 3 4)",
        ),
        ("(let ((x 1)) (incf x (setq x 10)) x)", "20"),
        (
            "(let ((a (list 1 2)) (n 0)) (symbol-macrolet ((x (car (progn (incf n) a))) (y (cadr a))) (psetf x y y x) (list a n)))",
            "((2 1) 2)",
        ),
        (
            "(macrolet ((m (x) `(car ,x))) (let ((l (list 1 2))) (setf (m l) 5) (incf (m l)) (push 3 (m l)) (rotatef (m l) (cadr l)) l))",
            "(2 (3 . 6))",
        ),
        (
            "(flet (((setf car) (new list) (setf (first list) (* 2 new)) list)) (let ((l (list 1))) (setf (car l) 5) l))",
            "(10)",
        ),
    ]);
}

#[test]
fn control_is_as_written() {
    check(&[
        ("(eval-when (:load-toplevel) 5)", "NIL"),
        ("(eval-when (:execute) 5)", "5"),
        (
            "(do x (t) 1)",
            "!! X in DO: a list of variables, ((variable first next)…), was expected.",
        ),
        (
            "(do () done)",
            "!! DONE in DO: when to end and with what values, (test form…), was expected.",
        ),
        (
            "(do* 10)",
            "!! 10 in DO*: a list of variables, ((variable first next)…), was expected.",
        ),
        (
            "(do ((x 1 2 3)) (t 1))",
            "!! (X 1 2 3) in DO: a variable, (variable first next), was expected.",
        ),
        (
            "(do ((i 0 (1+ i)) (s nil (cons i s))) ((= i 3) s))",
            "(2 1 0)",
        ),
        (
            "(progn (defmacro dm () \"doc m\" 1) (documentation 'dm 'function))",
            "\"doc m\"",
        ),
        (
            "(multiple-value-list (intern \"A-KEY-OF-NOBODY\" :keyword))",
            "(:A-KEY-OF-NOBODY NIL)",
        ),
        (
            "(multiple-value-list (intern \"A-KEY-OF-NOBODY\" :keyword))",
            "(:A-KEY-OF-NOBODY :EXTERNAL)",
        ),
    ]);
}

#[test]
fn numbers_are_as_exact_as_they_can_be() {
    check(&[
        ("(exp 1d0)", "2.718281828459045d0"),
        ("(exp 1)", "2.7182817"),
        ("(exp -1d0)", "0.36787944117144233d0"),
        ("(coerce 5 'complex)", "5"),
        ("(coerce 1/2 'complex)", "1/2"),
        ("(coerce 5.0 'complex)", "#C(5.0 0.0)"),
        ("(coerce 5 '(complex float))", "#C(5.0 0.0)"),
    ]);
}

#[test]
fn macro_characters_read_inside_backquotes() {
    check(&[
        (
            "(progn (set-macro-character #\\! (lambda (s c) (declare (ignore c)) (list 'list (read s t nil t)))) 1)",
            "1",
        ),
        (
            "(let ((x 5)) `(a !,x (b !(c ,x))))",
            "(A (LIST 5) (B (LIST (C 5))))",
        ),
        ("(ignore-errors (read-from-string \"!,x\")) 1", "1"),
    ]);
}

#[test]
fn calls_are_traced() {
    let mut image = Image::new();
    shown(
        &mut image,
        "(defun f (n) (if (= n 0) 0 (+ 1 (f (- n 1)))))
         (trace f)
         (f 1)
         (ignore-errors (f :wrong))
         (catch 'out (flet ((thrown () (throw 'out 1))) (defun g () (thrown)) (trace g) (g)))
         (untrace f)
         (f 1)",
    );
    assert_eq!(
        image.output.take(),
        "  0: (F 1)\n    1: (F 0)\n    1: F returned 0\n  0: F returned 1\n  0: (F :WRONG)\n  0: F failed: The value :WRONG is not of type NUMBER\n  0: (G)\n  0: G was left\n"
    );
}

#[test]
fn forms_are_expanded_all_the_way() {
    let cases = [
        ("(when a (unless b c))", "(IF A (IF B NIL C))"),
        ("'(when a b)", "'(WHEN A B)"),
        (
            "(let ((x (when a b))) (declare (special x)) x)",
            "(LET ((X (IF A B))) (DECLARE (SPECIAL X)) X)",
        ),
        (
            "#'(lambda (a &optional (b (when a 1))) (when a b))",
            "#'(LAMBDA (A &OPTIONAL (B (IF A 1))) (IF A B))",
        ),
        (
            "(funcall #'(setf car) 1 (when a b))",
            "(FUNCALL #'(SETF CAR) 1 (IF A B))",
        ),
        (
            "(macrolet ((f (x) `(when ,x 1))) (f (f 2)))",
            "(LOCALLY (IF (IF 2 1) 1))",
        ),
        (
            "(flet ((g (x) (when x 1))) (g (when 2 3)))",
            "(FLET ((G (X) (IF X 1))) (G (IF 2 3)))",
        ),
        (
            "(macrolet ((g (x) `(when ,x 1))) (labels ((g (x) (g x))) (g 2)))",
            "(LOCALLY (LABELS ((G (X) (G X))) (G 2)))",
        ),
        (
            "(symbol-macrolet ((x (when a b))) (list x (let ((x x)) x)))",
            "(LOCALLY (LIST (IF A B) (LET ((X (IF A B))) X)))",
        ),
        (
            "(block when (tagbody when (when a (go when))))",
            "(BLOCK WHEN (TAGBODY WHEN (IF A (GO WHEN))))",
        ),
        (
            "((lambda (x) (when x x)) (when a b))",
            "((LAMBDA (X) (IF X X)) (IF A B))",
        ),
        ("5", "5"),
    ];
    let forms = cases.map(|(form, _)| format!("(system::%macroexpand-all '{form})"));
    let checked: Vec<(&str, &str)> = forms
        .iter()
        .zip(cases)
        .map(|(form, (_, shown))| (form.as_str(), shown))
        .collect();
    check(&checked);
}

#[test]
fn loops_with_mistakes_are_errors() {
    check(&[
        (
            "(loop with x = '(a) for y in '(b) collect y into x finally (return x))",
            "!! The variable X stands twice in LOOP.",
        ),
        (
            "(loop for i from 1 to 3 collect i always (< i 9))",
            "!! ALWAYS in LOOP decides what is returned; give what is accumulated a variable with INTO.",
        ),
        (
            "(loop for k being the hash-keys of (make-hash-table) using (hash-value k) count t)",
            "!! The variable K stands twice in LOOP.",
        ),
        (
            "(loop with (a b c) of-type (fixnum float t) return (list a b c))",
            "(0 0.0 NIL)",
        ),
        (
            "(loop for x in '(1 2 3) count (< x 3) into n float finally (return n))",
            "2.0",
        ),
        (
            "(let ((it 'z)) (loop for x in '(a b) when x collect it and collect it))",
            "(A Z B Z)",
        ),
    ]);
}

#[test]
fn packages_have_no_conflicts_unnoticed() {
    check(&[
        (
            "(progn (make-package :pc-a :use nil) (make-package :pc-b :use '(:pc-a)) (intern \"X\" :pc-b) (export (intern \"X\" :pc-a) :pc-a))",
            "!! EXPORT PC-A::X causes a name conflict in PC-B, which uses PC-A: it has another symbol of that name; shadow it there first.",
        ),
        (
            "(unexport 'car :pc-a)",
            "!! CAR cannot be unexported: it is not accessible in PC-A.",
        ),
        (
            "(defpackage :pc-c (:use) (:shadow \"A\") (:intern \"A\"))",
            "!! DEFPACKAGE has A both in :SHADOW and in :INTERN.",
        ),
        (
            "(defpackage :pc-d (:use) (:size 10) (:size 20))",
            "!! DEFPACKAGE has two options :SIZE.",
        ),
        (
            "(progn (delete-package :pc-b) (package-used-by-list :pc-a))",
            "NIL",
        ),
    ]);
}

#[test]
fn lists_and_places_follow_the_standard() {
    check(&[
        // The test gets the part of the tree, then the key.
        (
            "(sublis '((1 . x) (5 . y)) '(0 3 8) :test (lambda (part key) (and (realp part) (< part key))))",
            "(X Y 8)",
        ),
        (
            "(nsublis '((1 . x) (5 . y)) (list 0 3 8) :test (lambda (part key) (and (realp part) (< part key))))",
            "(X Y 8)",
        ),
        ("(rassoc 'a #(1))", "!! The value #(1) is not of type LIST"),
        (
            "(pairlis #(1) #(2))",
            "!! The value #(1) is not of type LIST",
        ),
        ("(subsetp #() '(1))", "!! The value #() is not of type LIST"),
        (
            "(get-properties '(a 1) '(x . y))",
            "!! The value Y is not of type LIST",
        ),
        (
            "(values-list '(1 . 2))",
            "!! The value 2 is not of type LIST",
        ),
        (
            "(let (a b c d) (setf (values a (values b c) d) (values 1 2 3 4)) (list a b c d))",
            "(1 2 NIL 3)",
        ),
        (
            "(handler-case ((lambda (&key) t) :allow-other-keys nil :allow-other-keys t :x 1) (program-error () :wrong))",
            ":WRONG",
        ),
        (
            "(fboundp '(setf car . x))",
            "!! The value (SETF CAR . X) is not of type SYMBOL",
        ),
        (
            "(handler-case (funcall (macro-function 'push) '(push x y)) (program-error () :wrong))",
            ":WRONG",
        ),
        (
            "(handler-case (proclaim '(optimize . x)) (type-error () :wrong))",
            ":WRONG",
        ),
    ]);
}

#[test]
fn what_is_printed_readably_leaves_nothing_out() {
    check(&[
        (
            "(let ((*print-readably* t) (*print-array* nil) (*print-length* 1) (*print-level* 1) (*print-escape* nil)) (list (write-to-string '(#(1 2) (\"a\" (b)))) (princ-to-string '(1 2))))",
            "(\"(#(1 2) (\\\"a\\\" (B)))\" \"(1 ...)\")",
        ),
        (
            "(let ((*print-readably* t) (*print-gensym* nil)) (prin1-to-string (make-symbol \"X\")))",
            "\"#:X\"",
        ),
        (
            "(handler-case (read-from-string \"(1 \") (end-of-file (c) (streamp (stream-error-stream c))))",
            "T",
        ),
        (
            "(with-input-from-string (s \" . )\") (handler-case (read s) (reader-error (c) (eq s (stream-error-stream c)))))",
            "T",
        ),
        (
            "(list (upgraded-complex-part-type '(integer 0 1)) (upgraded-complex-part-type nil))",
            "((INTEGER 0 1) NIL)",
        ),
        (
            "(progn (deftype between (a b) (declare (type integer a b)) `(integer ,a ,b)) (typep 3 '(between 1 4)))",
            "T",
        ),
        (
            "(with-input-from-string (in (format nil \"maybe~%y~%\")) (with-output-to-string (out) (let ((*query-io* (make-two-way-stream in out))) (y-or-n-p \"Go ~a?\" 1))))",
            "\"Go 1? (y or n) Go 1? (y or n) \"",
        ),
    ]);
}

#[test]
fn tables_places_and_types_follow_the_standard() {
    check(&[
        (
            "(let ((h (make-hash-table :test 'equalp))) (setf (gethash 0.0 h) :x (gethash '(0.0d0) h) :y) (list (gethash -0.0 h) (gethash '(-0.0) h)))",
            "(:X :Y)",
        ),
        (
            "(progn (defsetf leaving (x) (new) \"Doc.\" (declare (ignorable x)) (return-from leaving `(setf (car ,x) ,new))) (let ((l (list 1))) (setf (leaving l) 5) l))",
            "(5)",
        ),
        (
            "(list (make-sequence (find-class 'list) 2) (length (make-sequence (find-class 'string) 3)))",
            "((NIL NIL) 3)",
        ),
        (
            "(loop for (type . zero) in '((short-float . 0.0) (long-float . 0d0) (double-float . 0d0) (fixnum . 0)) collect (eql zero (eval `(loop for i in nil sum i of-type ,type))))",
            "(T T T T)",
        ),
        (
            "(handler-case (eval '(defgeneric told-twice (x) (:documentation \"a\") (:documentation \"b\"))) (program-error () :wrong))",
            ":WRONG",
        ),
        (
            "(progn (defgeneric counted-by (x)) (list (compiled-function-p #'counted-by) (typep #'counted-by 'compiled-function) (compiled-function-p #'car)))",
            "(NIL NIL T)",
        ),
    ]);
}
