//! Weak pointers, under the names of trivial-garbage.

use super::standard::check;

#[test]
fn a_weak_pointer_keeps_nothing() {
    check(&[
        (
            "(let* ((cup (list 1)) (pointer (tg:make-weak-pointer cup))) (list (tg:weak-pointer-p pointer) (eq cup (tg:weak-pointer-value pointer)) (progn (setq cup nil) (tg:weak-pointer-value pointer))))",
            "(T T NIL)",
        ),
        (
            "(let ((pointers (mapcar #'tg:make-weak-pointer (list (list 1) (make-array 3) (make-hash-table) (copy-seq \"abc\") 'cup 17)))) (mapcar #'tg:weak-pointer-value pointers))",
            "(NIL NIL NIL NIL CUP 17)",
        ),
        (
            "(tg:make-weak-pointer (list 1))",
            "#<WEAK-POINTER to nothing>",
        ),
    ]);
}

#[test]
fn a_circle_with_a_weak_pointer_to_it_can_be_used() {
    check(&[
        (
            "(let ((ring (list 1 2))) (let ((pointer (tg:make-weak-pointer ring))) (setf (cddr ring) ring) (setf (car ring) pointer) (eq ring (tg:weak-pointer-value pointer))))",
            "T",
        ),
        (
            "(dotimes (i 20000 :done) (let ((ring (list i))) (tg:make-weak-pointer ring) (setf (cdr ring) ring)))",
            ":DONE",
        ),
    ]);
}
