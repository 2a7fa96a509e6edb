;;;; Lists and association lists.

(in-package :common-lisp)

(defun revappend (list tail)
  "The elements of a list in reverse order, in front of a tail.
  Examples:
  (revappend '(1 2) '(3)) => (2 1 3)"
  (dolist (element list tail)
    (push element tail)))

(defun nreconc (list tail)
  "Like `revappend`, but reuses the pairs of the list.
  Examples:
  (nreconc (list 1 2) '(3)) => (2 1 3)"
  (nconc (nreverse list) tail))

(defun %check-list (list)
  "An error unless the argument is a list. CHECK-TYPE needs the functions that call this."
  (unless (listp list)
    (error 'type-error :datum list :expected-type 'list)))

(defun ldiff (list tail)
  "A copy of the part of a list before one of its tails.
  Examples:
  (let ((l (list 1 2 3))) (ldiff l (cddr l))) => (1 2)"
  (%check-list list)
  (do ((rest list (cdr rest))
       (part '() (cons (car rest) part)))
      ((or (atom rest) (eql rest tail))
       (nreconc part (if (eql rest tail) '() rest)))))

(defun tailp (tail list)
  "Is the first argument a tail of the list?
  Examples:
  (let ((l (list 1 2))) (tailp (cdr l) l)) => T"
  (do ((rest list (cdr rest)))
      ((or (atom rest) (eql rest tail))
       (eql rest tail))))

(defun nbutlast (list &optional (n 1))
  "Cuts the last `n` (1) elements off a list.
  Examples:
  (nbutlast (list 1 2 3)) => (1 2)"
  (check-type list list)
  (check-type n (integer 0))
  (let ((kept (- (loop for pair on list count t) n)))
    (when (plusp kept)
      (setf (cdr (nthcdr (1- kept) list)) '())
      list)))

(defun copy-alist (alist)
  "A copy of an association list and of its pairs.
  Examples:
  (copy-alist '((a . 1))) => ((A . 1))"
  (mapcar (lambda (entry)
            (if (consp entry) (cons (car entry) (cdr entry)) entry))
          alist))

(defun acons (key datum alist)
  "An association list with another entry in front.
  Examples:
  (acons 'a 1 '((b . 2))) => ((A . 1) (B . 2))"
  (cons (cons key datum) alist))

(defun pairlis (keys data &optional alist)
  "An association list of keys with data.
  Examples:
  (pairlis '(a b) '(1 2)) => ((B . 2) (A . 1))"
  (%check-list keys)
  (%check-list data)
  (unless (= (length keys) (length data))
    (error "The lists of keys and data are of unequal length."))
  (loop for key in keys
        for datum in data
        do (push (cons key datum) alist))
  alist)

(defun %entry-where (predicate part key alist)
  "The first entry of an association list of which a part satisfies a predicate."
  (%check-list alist)
  (let ((key (or key #'identity)))
    (find-if (lambda (entry)
               (and entry (funcall predicate (funcall key (funcall part entry)))))
             alist)))

(defun assoc-if (predicate alist &key key)
  "The first entry whose car satisfies a predicate.
  Examples:
  (assoc-if #'evenp '((1 . a) (2 . b))) => (2 . B)"
  (%entry-where predicate #'car key alist))

(defun assoc-if-not (predicate alist &key key)
  "The first entry whose car does not satisfy a predicate.
  Examples:
  (assoc-if-not #'evenp '((2 . b) (1 . a))) => (1 . A)"
  (%entry-where (complement predicate) #'car key alist))

(defun rassoc (item alist &key key test test-not)
  "The first entry of an association list whose cdr matches an item.
  Examples:
  (rassoc 2 '((a . 1) (b . 2))) => (B . 2)"
  (%entry-where (%equal-to item test test-not) #'cdr key alist))

(defun rassoc-if (predicate alist &key key)
  "The first entry whose cdr satisfies a predicate.
  Examples:
  (rassoc-if #'evenp '((a . 1) (b . 2))) => (B . 2)"
  (%entry-where predicate #'cdr key alist))

(defun rassoc-if-not (predicate alist &key key)
  "The first entry whose cdr does not satisfy a predicate.
  Examples:
  (rassoc-if-not #'oddp '((a . 1) (b . 2))) => (B . 2)"
  (%entry-where (complement predicate) #'cdr key alist))

(defun member-if (predicate list &key key)
  "The list from the first element that satisfies a predicate.
  Examples:
  (member-if #'evenp '(1 2 3)) => (2 3)"
  (%check-list list)
  (let ((position (position-if predicate list :key key)))
    (and position (nthcdr position list))))

(defun member-if-not (predicate list &key key)
  "The list from the first element that does not satisfy a predicate.
  Examples:
  (member-if-not #'oddp '(1 2 3)) => (2 3)"
  (%check-list list)
  (let ((position (position-if-not predicate list :key key)))
    (and position (nthcdr position list))))
