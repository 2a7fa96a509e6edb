;;;; Lists as sets. The functions whose names begin with N are allowed to reuse their arguments
;;;; but do not.

(in-package :common-lisp)

(defun %hashing-test (test)
  "The test of a hash table that compares as a function does, or NIL."
  (cond ((or (null test) (member test (list 'eql #'eql))) 'eql)
        ((member test (list 'eq #'eq)) 'eq)
        ((member test (list 'equal #'equal)) 'equal)))

(defun %finder (list key test test-not &optional swapped)
  "A predicate of items: does an element of a list match the item? The test gets the item
first, or second if swapped. A long list is put into a table, so that the work on two sets
grows with the sum, not the product, of their lengths."
  (let ((key (or key #'identity))
        (hashing-test (and (nthcdr 32 list) (null test-not) (%hashing-test test))))
    (flet ((turned (function)
             (if (and function swapped)
                 (lambda (item element) (funcall function element item))
                 function)))
      (if hashing-test
          (let ((table (make-hash-table :test hashing-test)))
            (dolist (element list)
              (setf (gethash (funcall key element) table) t))
            (lambda (item) (gethash (funcall key item) table)))
          (let ((test (turned test))
                (test-not (turned test-not)))
            (lambda (item)
              (member (funcall key item) list :key key :test test :test-not test-not)))))))

(defun %push-unless (predicate items list)
  "The list with the items in front for which the predicate is false, the last one first."
  (dolist (item items list)
    (unless (funcall predicate item)
      (push item list))))

(defun adjoin (item list &key key test test-not)
  "The list with an item in front, unless an element matches it.
  Examples:
  (adjoin 3 '(1 2)) => (3 1 2)
  (adjoin 2 '(1 2)) => (1 2)"
  (if (funcall (%finder list key test test-not) item)
      list
      (cons item list)))

(defun union (list-1 list-2 &key key test test-not)
  "The elements that are in one of two lists.
  Examples:
  (union '(1 2) '(2 3)) => (1 2 3)"
  (if (< (length list-1) (length list-2))
      (%push-unless (%finder list-1 key test test-not t) list-2 list-1)
      (%push-unless (%finder list-2 key test test-not) list-1 list-2)))

(defun nunion (list-1 list-2 &key key test test-not)
  "Like `union`.
  Examples:
  (nunion (list 1 2) (list 2 3)) => (1 2 3)"
  (union list-1 list-2 :key key :test test :test-not test-not))

(defun intersection (list-1 list-2 &key key test test-not)
  "The elements that are in both lists.
  Examples:
  (intersection '(1 2) '(2 3)) => (2)"
  (%push-unless (complement (%finder list-2 key test test-not)) list-1 '()))

(defun nintersection (list-1 list-2 &key key test test-not)
  "Like `intersection`.
  Examples:
  (nintersection (list 1 2) (list 2 3)) => (2)"
  (intersection list-1 list-2 :key key :test test :test-not test-not))

(defun set-difference (list-1 list-2 &key key test test-not)
  "The elements of the first list that are not in the second.
  Examples:
  (set-difference '(1 2) '(2 3)) => (1)"
  (if list-2
      (%push-unless (%finder list-2 key test test-not) list-1 '())
      list-1))

(defun nset-difference (list-1 list-2 &key key test test-not)
  "Like `set-difference`.
  Examples:
  (nset-difference (list 1 2) (list 2 3)) => (1)"
  (set-difference list-1 list-2 :key key :test test :test-not test-not))

(defun set-exclusive-or (list-1 list-2 &key key test test-not)
  "The elements that are in exactly one of two lists.
  Examples:
  (set-exclusive-or '(1 2) '(2 3)) => (3 1)"
  (%push-unless
   (%finder list-1 key test test-not t)
   list-2
   (%push-unless (%finder list-2 key test test-not) list-1 '())))

(defun nset-exclusive-or (list-1 list-2 &key key test test-not)
  "Like `set-exclusive-or`.
  Examples:
  (nset-exclusive-or (list 1 2) (list 2 3)) => (3 1)"
  (set-exclusive-or list-1 list-2 :key key :test test :test-not test-not))

(defun subsetp (list-1 list-2 &key key test test-not)
  "Is every element of the first list in the second?
  Examples:
  (subsetp '(1 2) '(1 2 3)) => T"
  (%check-list list-1)
  (every (%finder list-2 key test test-not) list-1))
