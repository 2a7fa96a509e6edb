//! Functions that call themselves, and functions that are redefined while they run.

use super::evaluate;

#[test]
fn a_recursion_without_end_is_a_condition() {
    let got =
        evaluate("(defun f (x) (+ 1 (f x))) (handler-case (f 1) (storage-condition () :deep))");
    assert_eq!(got, ":DEEP");
}

#[test]
fn a_tail_recursion_of_a_hundred_thousand_calls_is_fine() {
    let got = evaluate("(labels ((down (n) (if (= n 0) :done (down (- n 1))))) (down 100000))");
    assert_eq!(got, ":DONE");
}

#[test]
fn a_function_that_ends_by_calling_itself_needs_no_stack() {
    for (form, expected) in [
        (
            "(progn (defun f (n) (if (= n 0) 'done (f (- n 1)))) (f 2000000))",
            "DONE",
        ),
        (
            "(progn (defun f (n sum) (let* ((next (- n 1)) (more (+ sum n))) (if (= n 0) sum (f next more)))) (f 1000 0))",
            "500500",
        ),
        (
            "(progn (defun f (n) (if (= n 0) (values 1 2) (f (- n 1)))) (f 4))",
            "1 ; 2",
        ),
        (
            "(progn (defun f (a b) (if (= a 0) (list a b) (f (- a 1) (cons a b)))) (f 3 nil))",
            "(0 (1 2 3))",
        ),
    ] {
        assert_eq!(evaluate(form), expected, "{form}");
    }
}

#[test]
fn a_function_that_calls_itself_has_variables_of_its_own_each_time() {
    let form = "(progn
        (defun f (n made)
          (if (= n 0) (mapcar #'funcall made) (f (- n 1) (cons (lambda () (incf n 10)) made))))
        (f 3 nil))";
    assert_eq!(evaluate(form), "(11 12 13)");
}

#[test]
fn a_function_that_is_redefined_while_it_runs_calls_the_new_one() {
    let form = "(progn
        (defun f (n)
          (when (= n 3) (defun f (n) (list 'new n)))
          (if (= n 0) 'old (f (- n 1))))
        (f 5))";
    assert_eq!(evaluate(form), "(NEW 2)");
}

#[test]
fn what_a_function_that_calls_itself_has_bound_is_undone() {
    for (form, expected) in [
        (
            "(progn (defvar *d* 0) (defun f (*d* n) (if (= n 0) *d* (f (+ *d* 1) (- n 1)))) (list (f 1 5) *d*))",
            "(6 0)",
        ),
        (
            "(progn (defvar *e* 0) (defun f (n) (let ((*e* (+ *e* 1))) (if (= n 0) *e* (f (- n 1))))) (list (f 5) *e*))",
            "(6 0)",
        ),
        (
            "(progn (defvar *l* nil) (defun f (n) (unwind-protect (if (= n 0) 'end (f (- n 1))) (push n *l*))) (list (f 2) *l*))",
            "(END (2 1 0))",
        ),
        (
            "(progn (defun f (n) (catch 'out (if (= n 0) (throw 'out 'end) (f (- n 1))))) (f 3))",
            "END",
        ),
    ] {
        assert_eq!(evaluate(form), expected, "{form}");
    }
}

#[test]
fn a_function_that_calls_itself_wrongly_is_told_so() {
    let form = "(progn (defun f (n) (if (= n 0) 'done (f (- n 1) 2))) (f 1))";
    assert_eq!(evaluate(form), "!! invalid number of arguments: 2");
}

#[test]
fn what_is_defined_anew_while_it_runs_is_called_from_then_on() {
    for (form, expected) in [
        (
            "(defun f (n) (when (= n 5) (eval '(defun f (n) (list 'new n)))) (f (1+ n))) (f 0)",
            "(NEW 6)",
        ),
        (
            "(defun f (n) (list n (progn (eval '(defun f (n) (list 'new n))) (f n)))) (f 1)",
            "(1 (NEW 1))",
        ),
        (
            "(defgeneric g (x))
             (defmethod g ((x integer)) (eval '(defmethod g ((x integer)) 'new)) (list 'old (g x)))
             (list (g 1) (g 1))",
            "((OLD NEW) NEW)",
        ),
        (
            "(defclass c () ((s :initform 1 :accessor s)))
             (let ((c (make-instance 'c)))
               (list (s c)
                     (progn (eval '(defmethod s :around ((c c)) (list 'around (call-next-method)))) (s c))
                     (progn (eval '(defclass c () ((a :initform 2) (s :initform 3 :accessor s)))) (s c))))",
            "(1 (AROUND 1) (AROUND 1))",
        ),
    ] {
        assert_eq!(evaluate(form), expected, "{form}");
    }
}
