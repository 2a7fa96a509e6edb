//! Arrays: adjusted, displaced, compared.

use super::standard::check;

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
