//! What the standard says, form by form: none of these may be silently wrong.

use crate::session::dialogue::{Evaluate, Event};
use crate::session::{Session, SessionOptions};

/// What the prompt prints for the values of the last form, or the report of the condition.
fn shown(session: &mut Session, form: &str) -> String {
    let mut last = String::new();
    session.evaluate("test", form, &mut |event| match event {
        Event::Values(values) => last = values.join(" ; "),
        Event::Aborted(abort) => last = format!("!! {}", abort.report),
        _ => {}
    });
    last.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Checks pairs of forms and what they show.
pub(super) fn check(cases: &[(&str, &str)]) {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut wrong = Vec::new();
    for (form, expected) in cases {
        let got = shown(&mut session, form);
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
fn restarts_apply_to_their_conditions() {
    check(&[
        (
            "(restart-case (handler-bind ((error (lambda (c) (invoke-restart 'r)))) (error \"x\")) (r () :test (lambda (c) c) 1) (r () 2))",
            "2",
        ),
        (
            "(restart-case (let ((c (make-condition 'error)) (d (make-condition 'error))) (with-condition-restarts c (list (find-restart 'r)) (list (restart-name (find-restart 'r c)) (find-restart 'r d) (restart-name (find-restart 'r))))) (r () 2))",
            "(R NIL R)",
        ),
        (
            "(block nil (handler-bind ((error (lambda (c) (return (list (find-restart 'r (make-condition 'error)) (restart-name (find-restart 'r c))))))) (restart-case (error \"x\") (r () 1))))",
            "(NIL R)",
        ),
        (
            "(handler-bind ((error #'continue)) (list (cerror \"Go ~a.\" \"Stop ~a.\" 1)))",
            "(NIL)",
        ),
        (
            "(let ((x 1)) (handler-bind ((type-error (lambda (c) (store-value \"a\" c)))) (check-type x string) x))",
            "\"a\"",
        ),
        (
            "(let ((l (list 1))) (handler-bind ((type-error (lambda (c) (store-value \"a\")))) (list (ctypecase (car l) (string :s)) l)))",
            "(:S (\"a\"))",
        ),
        (
            "(let ((x 5)) (handler-bind ((type-error (lambda (c) (store-value 2)))) (list (ccase x ((1 2) :low) (3 :high)) x)))",
            "(:LOW 2)",
        ),
        (
            "(handler-case (etypecase 1 (string 1)) (type-error (c) (type-error-expected-type c)))",
            "(OR STRING)",
        ),
    ]);
}

#[test]
fn arrays_change_as_they_are_told() {
    check(&[
        (
            "(list (equal #*101 #*101) (equal #*101 #*100) (equal #*10 #*101))",
            "(T NIL NIL)",
        ),
        (
            "(let ((h (make-hash-table :test 'equal))) (setf (gethash #*101 h) 1) (gethash (copy-seq #*101) h))",
            "1 ; T",
        ),
        (
            "(let ((a (make-array '(2 2) :initial-contents '((1 2) (3 4)) :adjustable t))) (list (eq a (adjust-array a '(3 3) :initial-element 0)) a))",
            "(T #2A((1 2 0) (3 4 0) (0 0 0)))",
        ),
        (
            "(let ((s (make-array 5 :element-type 'character :fill-pointer 0))) (map-into s #'char-upcase \"abc\") s)",
            "\"ABC\"",
        ),
        (
            "(let ((v (make-array 5 :fill-pointer 2 :initial-element 0))) (map-into v #'1+ '(1 2 3)) v)",
            "#(2 3 4)",
        ),
        (
            "(let ((s (make-array 3 :element-type 'character :adjustable t :initial-contents \"abc\"))) (list (eq s (adjust-array s 5 :initial-element #\\x)) s))",
            "(T \"abcxx\")",
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
fn time_is_that_of_the_simulation() {
    check(&[
        (
            "(let ((before (get-internal-real-time))) (sleep 2) (/ (- (get-internal-real-time) before) internal-time-units-per-second))",
            "2",
        ),
        (
            "(multiple-value-list (decode-universal-time 3918000000 -1))",
            "(0 20 6 27 2 2024 1 NIL -1)",
        ),
        (
            "(loop for u from 0 below 10000000000 by 1234567891 always (multiple-value-bind (s m h d mo y) (decode-universal-time u 0) (= u (encode-universal-time s m h d mo y 0))))",
            "T",
        ),
    ]);
}

#[test]
fn calls_are_traced() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut output = String::new();
    session.evaluate(
        "test",
        "(defun f (n) (if (= n 0) 0 (+ 1 (f (- n 1)))))
         (trace f)
         (f 1)
         (ignore-errors (f :wrong))
         (catch 'out (flet ((thrown () (throw 'out 1))) (defun g () (thrown)) (trace g) (g)))
         (untrace f)
         (f 1)",
        &mut |event| {
            if let Event::Output(text) = event {
                output.push_str(&text);
            }
        },
    );
    assert_eq!(
        output,
        "  0: (F 1)\n    1: (F 0)\n    1: F returned 0\n  0: F returned 1\n  0: (F :WRONG)\n  0: F failed: The value :WRONG is not of type NUMBER\n  0: (G)\n  0: G was left\n"
    );
}

#[test]
fn subtypes_are_told_where_the_standard_tells_them() {
    let cases = [
        ("symbol", "(or null (and symbol (not null)))", "T T"),
        ("(integer 5 3)", "nil", "T T"),
        ("t", "(or integer (not integer))", "T T"),
        ("(and integer float)", "nil", "T T"),
        ("character", "(or base-char extended-char)", "T T"),
        ("character", "base-char", "NIL T"),
        ("integer", "(or fixnum bignum)", "T T"),
        ("integer", "fixnum", "NIL T"),
        ("(and rational (not integer))", "ratio", "T T"),
        ("(integer 0 3)", "(member 0 1 2 3 a)", "T T"),
        ("(integer 0 4)", "(member 0 1 2 3 a)", "NIL T"),
        (
            "(integer 0 10)",
            "(or (integer 0 4) (integer 6 10))",
            "NIL T",
        ),
        ("(cons integer t)", "(or (cons number t) null)", "T T"),
        ("(cons number t)", "(cons integer t)", "NIL T"),
        ("(and list (not null))", "cons", "T T"),
        ("(integer (9))", "(integer 10)", "T T"),
        ("(and integer (real -1/2 (3/2)))", "(integer 0 1)", "T T"),
        (
            "(and integer (not (eql 10)))",
            "(or (integer * 9) (integer 11))",
            "T T",
        ),
        ("(and ratio (rational 0 0))", "nil", "T T"),
        ("(not cons)", "atom", "T T"),
        ("(member a b)", "(or (eql a) (eql b))", "T T"),
        ("(satisfies evenp)", "integer", "NIL NIL"),
        ("(and integer (satisfies evenp))", "number", "T T"),
        ("(or string symbol)", "(or symbol vector)", "T T"),
        ("(or string cons)", "(or symbol vector)", "NIL T"),
        ("string", "number", "NIL T"),
        (
            "(array t (2 2))",
            "(or (array t (3 3)) cons symbol number)",
            "NIL T",
        ),
        ("function", "(or symbol number)", "NIL T"),
        ("hash-table", "(or package hash-table)", "T T"),
        ("hash-table", "(not (or package hash-table))", "NIL T"),
    ];
    let forms: Vec<(String, String)> = cases
        .iter()
        .map(|(a, b, expected)| {
            let form = format!("(multiple-value-list (subtypep '{a} '{b}))");
            (form, format!("({expected})"))
        })
        .collect();
    let pairs: Vec<(&str, &str)> = forms
        .iter()
        .map(|(form, expected)| (form.as_str(), expected.as_str()))
        .collect();
    check(&pairs);
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
fn displaced_arrays_share_their_elements() {
    check(&[
        (
            "(let* ((a (make-array '(2 3) :initial-contents '((1 2 3) (4 5 6)))) (v (make-array 4 :displaced-to a :displaced-index-offset 1))) (setf (aref v 0) :x (aref a 1 0) :y) (list v a))",
            "(#(:X 3 :Y 5) #2A((1 :X 3) (:Y 5 6)))",
        ),
        (
            "(let* ((s (copy-seq \"hello\")) (d (make-array 3 :element-type 'character :displaced-to s :displaced-index-offset 1))) (setf (char d 0) #\\E) (nstring-upcase d :start 1) (list s d (length d) (position #\\L d)))",
            "(\"hELLo\" \"ELL\" 3 1)",
        ),
        (
            "(let* ((v (vector 1 2 3 4)) (d (make-array 3 :displaced-to v :fill-pointer 1))) (vector-push :a d) (list v d (fill-pointer d) (multiple-value-list (array-displacement d))))",
            "(#(1 :A 3 4) #(1 :A) 2 (#(1 :A 3 4) 0))",
        ),
        // Elements that are needed beyond those of the other array are the array's own.
        (
            "(let* ((v (vector 1 2)) (d (make-array 2 :displaced-to v :fill-pointer 2 :adjustable t))) (vector-push-extend 3 d) (setf (aref d 0) :own) (list v d (array-displacement d)))",
            "(#(1 2) #(:OWN 2 3) NIL)",
        ),
        (
            "(let* ((v (vector 1 2 3 4)) (a (make-array 2 :adjustable t))) (adjust-array a 3 :displaced-to v :displaced-index-offset 1) (list a (typep a 'simple-array)))",
            "(#(2 3 4) NIL)",
        ),
        (
            "(let* ((v (vector 1 2 3)) (d (make-array 2 :displaced-to v)) (e (make-array 1 :displaced-to d :displaced-index-offset 1))) (setf (aref e 0) :deep) (list v (subseq d 0) (reverse d) (equalp d #(1 :deep))))",
            "(#(1 :DEEP 3) #(1 :DEEP) #(:DEEP 1) T)",
        ),
        (
            "(make-array 3 :displaced-to #(1 2 3) :displaced-index-offset 1)",
            "!! An array of 3 elements cannot be displaced to index 1 of one that has 3.",
        ),
        (
            "(let ((a (make-array 2 :adjustable t))) (adjust-array a 2 :displaced-to a))",
            "!! An array cannot be displaced to itself.",
        ),
        (
            "(let ((s (make-array 4 :element-type 'character :fill-pointer 2 :initial-element #\\a))) (setf (char s 3) #\\z) (list (copy-seq s) (char s 3) (progn (setf (fill-pointer s) 4) s)))",
            "(\"aa\" #\\z \"aaaz\")",
        ),
    ]);
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
fn assertions_are_tried_again() {
    check(&[
        (
            "(let ((x 0)) (handler-bind ((type-error (lambda (c) (incf x) (continue c)))) (assert (> x 5) () 'type-error) x))",
            "6",
        ),
        (
            "(let ((*error-output* (make-string-output-stream))) (warn \"w\") (get-output-stream-string *error-output*))",
            "\"WARNING: w \"",
        ),
        (
            "(handler-case (nbutlast (list 1) 20.0) (type-error () :type-error))",
            ":TYPE-ERROR",
        ),
        ("(let ((x (list* 'a 'b 'c 'd))) (nbutlast x))", "(A B)"),
    ]);
}

#[test]
fn files_have_characters_or_bytes() {
    let folder = std::env::temp_dir().join(format!("planwright-files-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let name = |file: &str| format!("{:?}", folder.join(file).to_str().unwrap());
    let bytes = format!(
        "(progn (with-open-file (s {0} :direction :output :element-type '(unsigned-byte 16)) (write-sequence #(1 65535) s) (write-byte 258 s)) (with-open-file (s {0} :element-type '(unsigned-byte 8)) (list (file-length s) (loop for b = (read-byte s nil) while b collect b) (stream-element-type s))))",
        name("bytes")
    );
    let signed = format!(
        "(with-open-file (s {} :element-type '(signed-byte 16)) (file-position s 1) (list (read-byte s) (file-position s) (typep s 'file-stream)))",
        name("bytes")
    );
    let both = format!(
        "(progn (with-open-file (s {0} :direction :io :if-does-not-exist :create) (write-string \"naïve\" s) (file-position s 0) (read-char s) (write-char #\\A s) (finish-output s) (read-line s)) (with-open-file (s {0}) (read-line s)))",
        name("both")
    );
    let files = format!(
        "(let ((all (directory {}))) (mapcar #'pathname-name all))",
        name("*")
    );
    let load = format!(
        "(progn (with-open-file (s {0} :direction :output) (print '(defparameter cl-user::*seen* *load-truename*) s) (print '(setq *package* (find-package :keyword)) s)) (load (pathname {0})) (list (package-name *package*) (pathname-name cl-user::*seen*)))",
        name("load.lisp")
    );
    check(&[
        (&bytes, "(6 (1 0 255 255 2 1) (UNSIGNED-BYTE 8))"),
        (&signed, "(-1 2 T)"),
        (&both, "\"nAïve\" ; T"),
        (&files, "(\"both\" \"bytes\")"),
        (&load, "(\"COMMON-LISP-USER\" \"load\")"),
        (
            "(read-byte (make-string-input-stream \"a\"))",
            "!! The elements of the stream are characters, not bytes; give OPEN an :ELEMENT-TYPE such as (UNSIGNED-BYTE 8).",
        ),
    ]);
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn pathnames_are_objects() {
    check(&[
        (
            "(let ((p (make-pathname :directory '(:absolute \"a\") :name \"b\" :type \"c\"))) (list p (pathnamep p) (stringp p) (equal p #P\"/a/b.c\") (princ-to-string p)))",
            "(#P\"/a/b.c\" T NIL T \"/a/b.c\")",
        ),
        (
            "(list (merge-pathnames \"x.lisp\" #P\"/a/b.c\") (merge-pathnames \"../y\" \"/a/b.c\") (enough-namestring \"/a/b\" \"/a/\"))",
            "(#P\"/a/x.lisp\" #P\"/a/../y.c\" \"b\")",
        ),
        (
            "(mapcar (lambda (p) (pathname-match-p p \"/a/**/*-x.lisp\")) '(\"/a/1-x.lisp\" \"/a/b/c/2-x.lisp\" \"/b/1-x.lisp\" \"/a/1-x.plan\"))",
            "(T T NIL NIL)",
        ),
        (
            "(make-pathname :directory 5)",
            "!! 5 is no directory; it is a string, or a list of :ABSOLUTE or :RELATIVE and names.",
        ),
        (
            "(open \"a*.lisp\")",
            "!! \"a*.lisp\" stands for several files; one is needed here.",
        ),
        (
            "(let ((s (make-string-output-stream))) (close s) (list (typep s 'string-stream) (typep (make-broadcast-stream) 'broadcast-stream) (class-name (class-of (make-concatenated-stream)))))",
            "(T T CONCATENATED-STREAM)",
        ),
        (
            "(handler-case (make-two-way-stream (make-broadcast-stream) (make-broadcast-stream)) (type-error (c) (typep (type-error-datum c) (type-error-expected-type c))))",
            "NIL",
        ),
    ]);
}

#[test]
fn names_of_types_stand_for_sequences_and_elements() {
    check(&[
        (
            "(progn (deftype letter () 'character) (deftype word () '(vector letter *)) (list (map 'word #'char-upcase \"ab\") (concatenate 'word \"a\" '(#\\b)) (make-array 2 :element-type 'letter :initial-element #\\x)))",
            "(\"AB\" \"ab\" \"xx\")",
        ),
        (
            "(progn (deftype row (&optional (n '*)) `(vector bit ,n)) (make-sequence 'row 3))",
            "#*000",
        ),
        (
            "(progn (defstruct (ring (:constructor)) a) (ring-a (make-ring :a 1)))",
            "1",
        ),
        (
            "(progn (defconstant +nine+ 9 \"Nine.\") (documentation '+nine+ 'variable))",
            "\"Nine.\"",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (setf (readtable-case *readtable*) :invert) (list (symbol-name (read-from-string \"CupTray\")) (read-from-string \"cup\") (prin1-to-string 'cup) (prin1-to-string '|Cup|)))",
            "(\"CupTray\" CUP \"cup\" \"Cup\")",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (setf (readtable-case *readtable*) :downcase) (list (symbol-name (read-from-string \"Cup\")) (let ((*print-case* :capitalize)) (prin1-to-string '|cup|))))",
            "(\"cup\" \"Cup\")",
        ),
        (
            "(setf (readtable-case (copy-readtable nil)) :sideways)",
            "!! The value :SIDEWAYS is not of type (MEMBER :UPCASE :DOWNCASE :PRESERVE :INVERT)",
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
fn restarts_show_what_they_report_and_belong_to_what_macros_signal() {
    check(&[
        (
            "(restart-case (princ-to-string (find-restart 'r)) (r () :report (lambda (s) (write-string \"Go on.\" s))))",
            "\"Go on.\"",
        ),
        (
            "(restart-bind ((r #'list :report-function (lambda (s) (write-string \"Again.\" s)))) (format nil \"~a\" (find-restart 'r)))",
            "\"Again.\"",
        ),
        (
            "(macrolet ((fail-now () '(error \"one\"))) (handler-bind ((error (lambda (c) (invoke-restart (find-restart 'r c))))) (handler-bind ((error (lambda (c) (declare (ignore c)) (error \"two\")))) (restart-case (restart-case (fail-now) (r () :inner)) (r () :outer)))))",
            ":OUTER",
        ),
        (
            "(handler-case (warn (make-condition 'simple-warning) 1) (type-error (c) (type-error-datum c)))",
            "(1)",
        ),
        (
            "(handler-case (error (make-condition 'simple-error) 1) (type-error (c) (type-error-datum c)))",
            "(1)",
        ),
        (
            "(handler-bind ((error #'continue)) (cerror \"Go ~a.\" (make-condition 'simple-error) 1))",
            "NIL",
        ),
    ]);
}

#[test]
fn what_slots_lack_is_answered_with_one_value() {
    check(&[
        (
            "(progn (defclass lacking () (a)) (defmethod slot-unbound (class (object lacking) name) (values name 2 3)) (defmethod slot-missing (class (object lacking) name operation &optional new) (values (list name operation new) 5)) (multiple-value-list (slot-value (make-instance 'lacking) 'a)))",
            "(A)",
        ),
        (
            "(multiple-value-list (slot-value (make-instance 'lacking) 'b))",
            "((B SLOT-VALUE NIL))",
        ),
        ("(setf (slot-value (make-instance 'lacking) 'b) 7)", "7"),
        ("(slot-boundp (make-instance 'lacking) 'b)", "T"),
        (
            "(typep (slot-makunbound (make-instance 'lacking) 'b) 'lacking)",
            "T",
        ),
        (
            "(handler-case (eval '(defclass twice () ((a :type t :type t)))) (program-error () :wrong))",
            ":WRONG",
        ),
        (
            "(handler-case (eval '(defclass twice () (a) (:default-initargs :a 1 :a 2))) (program-error () :wrong))",
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
            "(RATIONAL NIL)",
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
