;;;; ALEXANDRIA: the parts of that library that plans use.

(in-package :alexandria)

;;; Functions

(defun ensure-function (designator)
  "The function that a symbol or function means.
  Examples:
  (funcall (alexandria:ensure-function 'car) '(1)) => 1"
  (coerce designator 'function))

(defun compose (function &rest more)
  "A function that calls the last function, then the one before with the result, and so on.
  Examples:
  (funcall (alexandria:compose #'list #'length) '(a b)) => (2)"
  (reduce (lambda (outer inner)
            (lambda (&rest arguments)
              (funcall outer (apply inner arguments))))
          (mapcar #'ensure-function (cons function more))))

(defun curry (function &rest arguments)
  "A function that calls another with arguments in front of its own.
  Examples:
  (funcall (alexandria:curry #'list 1 2) 3) => (1 2 3)"
  (let ((function (ensure-function function)))
    (lambda (&rest more)
      (apply function (append arguments more)))))

(defun rcurry (function &rest arguments)
  "A function that calls another with arguments behind its own.
  Examples:
  (funcall (alexandria:rcurry #'list 1 2) 3) => (3 1 2)"
  (let ((function (ensure-function function)))
    (lambda (&rest more)
      (apply function (append more arguments)))))

(defun conjoin (predicate &rest more)
  "A predicate that is true where all are.
  Examples:
  (funcall (alexandria:conjoin #'symbolp #'null) nil) => T"
  (let ((predicates (mapcar #'ensure-function (cons predicate more))))
    (lambda (&rest arguments)
      (let (value)
        (dolist (predicate predicates value)
          (setf value (apply predicate arguments))
          (unless value (return nil)))))))

(defun disjoin (predicate &rest more)
  "A predicate that is true where one is.
  Examples:
  (funcall (alexandria:disjoin #'consp #'null) nil) => T"
  (let ((predicates (mapcar #'ensure-function (cons predicate more))))
    (lambda (&rest arguments)
      (some (lambda (predicate) (apply predicate arguments)) predicates))))

;;; Lists

(defun ensure-list (object)
  "The object if it is a list, else a list of it.
  Examples:
  (alexandria:ensure-list 1) => (1)"
  (if (listp object) object (list object)))

(defun ensure-cons (object)
  "The object if it is a pair, else a pair of it and `NIL`.
  Examples:
  (alexandria:ensure-cons 1) => (1)"
  (if (consp object) object (cons object nil)))

(defun ensure-car (object)
  "The car of a pair, else the object.
  Examples:
  (alexandria:ensure-car '(1 2)) => 1"
  (if (consp object) (car object) object))

(defun proper-list-p (object)
  "Is the object a list that ends?
  Examples:
  (alexandria:proper-list-p '(1 . 2)) => NIL"
  (and (listp object)
       (ignore-errors (list-length object))
       t))

(defun lastcar (list)
  "The last element of a list, or `NIL`.
  Examples:
  (alexandria:lastcar '(1 2 3)) => 3"
  (first (last list)))

(defun flatten (tree)
  "The leaves of a tree, without `NIL`.
  Examples:
  (alexandria:flatten '(1 (2 (3 nil)) 4)) => (1 2 3 4)"
  (labels ((leaves (part rest)
             (cond ((null part) rest)
                   ((atom part) (cons part rest))
                   (t (leaves (car part) (leaves (cdr part) rest))))))
    (leaves tree '())))

(defun mappend (function list &rest lists)
  "The results of a function for the elements of lists, appended.
  Examples:
  (alexandria:mappend #'list '(1 2) '(a b)) => (1 A 2 B)"
  (apply #'append (apply #'mapcar function list lists)))

(defun iota (n &key (start 0) (step 1))
  "A list of `n` numbers from `start` (0) in steps (1).
  Examples:
  (alexandria:iota 3) => (0 1 2)
  (alexandria:iota 3 :start 1 :step 2) => (1 3 5)"
  ;; All numbers have one type, even if only the step is a float.
  (let ((number (+ start (- step step))))
    (map-into (make-list n)
              (lambda () (prog1 number (incf number step))))))

;;; Property lists, association lists and hash tables

(defun plist-alist (plist)
  "A property list as association list.
  Examples:
  (alexandria:plist-alist '(:a 1)) => ((:A . 1))"
  (loop for (key value) on plist by #'cddr
        collect (cons key value)))

(defun alist-plist (alist)
  "An association list as property list.
  Examples:
  (alexandria:alist-plist '((:a . 1))) => (:A 1)"
  (loop for entry in alist
        when entry
          collect (car entry)
          and collect (cdr entry)))

(defun remove-from-plist (plist &rest keys)
  "A property list without some keys.
  Examples:
  (alexandria:remove-from-plist '(:a 1 :b 2) :a) => (:B 2)"
  (loop for (key value) on plist by #'cddr
        unless (member key keys)
          collect key
          and collect value))

(defun hash-table-keys (table)
  "The keys of a table.
  Examples:
  (alexandria:hash-table-keys (make-hash-table)) => NIL"
  (loop for key being the hash-keys of table
        collect key))

(defun hash-table-values (table)
  "The values of a table.
  Examples:
  (alexandria:hash-table-values (make-hash-table)) => NIL"
  (loop for value being the hash-values of table
        collect value))

(defun hash-table-alist (table)
  "The entries of a table as an association list.
  Examples:
  (alexandria:hash-table-alist (make-hash-table)) => NIL"
  (loop for key being the hash-keys of table using (hash-value value)
        collect (cons key value)))

(defun hash-table-plist (table)
  "The entries of a table as property list.
  Examples:
  (alexandria:hash-table-plist (make-hash-table)) => NIL"
  (alist-plist (hash-table-alist table)))

(defun alist-hash-table (alist &rest options)
  "A hash table of the entries of an association list; the options are those of `make-hash-table`.
  Examples:
  (gethash 'a (alexandria:alist-hash-table '((a . 1)))) => 1 ; T"
  (let ((table (apply #'make-hash-table options)))
    (dolist (entry alist table)
      (when entry
        (ensure-gethash (car entry) table (cdr entry))))))

(defun plist-hash-table (plist &rest options)
  "A hash table of the entries of a property list; the options are those of `make-hash-table`.
  Examples:
  (gethash 'a (alexandria:plist-hash-table '(a 1))) => 1 ; T"
  (apply #'alist-hash-table (plist-alist plist) options))

(defun copy-hash-table (table)
  "A copy of a hash table.
  Examples:
  (hash-table-count (alexandria:copy-hash-table (make-hash-table))) => 0"
  (let ((copy (make-hash-table :test (hash-table-test table))))
    (maphash (lambda (key value) (setf (gethash key copy) value)) table)
    copy))

;;; Sequences

(defun emptyp (sequence)
  "Has the sequence no elements?
  Examples:
  (alexandria:emptyp \"\") => T"
  (zerop (length sequence)))

(defun length= (sequence &rest more)
  "Are all lengths (or given numbers) the same?
  Examples:
  (alexandria:length= '(a b) 2) => T"
  (flet ((size (object)
           (if (integerp object) object (length object))))
    (apply #'= (size sequence) (mapcar #'size more))))

(defun %check-elements (sequence)
  "Signals an error if a sequence is empty."
  (when (emptyp sequence)
    (error 'simple-type-error
           :datum sequence :expected-type 'sequence
           :format-control "The sequence is empty, so it has no such element.")))

(defun first-elt (sequence)
  "The first element.
  Examples:
  (alexandria:first-elt \"abc\") => #\\a"
  (%check-elements sequence)
  (elt sequence 0))

(defun last-elt (sequence)
  "The last element.
  Examples:
  (alexandria:last-elt '(1 2 3)) => 3"
  (%check-elements sequence)
  (elt sequence (1- (length sequence))))

(defun random-elt (sequence)
  "A random element.
  Examples:
  (alexandria:random-elt '(a)) => A"
  (%check-elements sequence)
  (elt sequence (random (length sequence))))

(defun shuffle (sequence)
  "Puts the elements of a sequence in random order.
  Examples:
  (length (alexandria:shuffle (list 1 2 3))) => 3"
  (let ((elements (coerce sequence 'simple-vector)))
    (loop for last from (1- (length elements)) above 0
          do (rotatef (svref elements last)
                      (svref elements (random (1+ last)))))
    (replace sequence elements)))

(defun starts-with (object sequence &key (test #'eql) key)
  "Is the object the first element?
  Examples:
  (alexandria:starts-with 1 '(1 2)) => T"
  (and (not (emptyp sequence))
       (funcall test (funcall (or key #'identity) (first-elt sequence)) object)))

(defun ends-with (object sequence &key (test #'eql) key)
  "Is the object the last element?
  Examples:
  (alexandria:ends-with 2 '(1 2)) => T"
  (and (not (emptyp sequence))
       (funcall test (funcall (or key #'identity) (last-elt sequence)) object)))

(defun starts-with-subseq (prefix sequence)
  "Does a sequence start with another?
  Examples:
  (alexandria:starts-with-subseq \"he\" \"hello\") => T"
  (let ((end (mismatch prefix sequence)))
    (or (null end) (= end (length prefix)))))

(defun ends-with-subseq (suffix sequence)
  "Does a sequence end with another?
  Examples:
  (alexandria:ends-with-subseq \"lo\" \"hello\") => T"
  (let ((start (mismatch suffix sequence :from-end t)))
    (or (null start) (zerop start))))

(defun extremum (sequence predicate &key key)
  "The element that would be first after sorting.
  Examples:
  (alexandria:extremum '(3 1 2) #'<) => 1"
  (let ((key (or key #'identity)))
    (unless (emptyp sequence)
      (reduce (lambda (best element)
                (if (funcall predicate (funcall key element) (funcall key best))
                    element
                    best))
              sequence))))

;;; Numbers

(defun clamp (number min max)
  "The number, or the bound that it is beyond.
  Examples:
  (alexandria:clamp 11 0 10) => 10"
  (cond ((< number min) min)
        ((> number max) max)
        (t number)))

(defun lerp (way from to)
  "The number at a part of the way between two others.
  Examples:
  (alexandria:lerp 1/2 0 10) => 5"
  (+ from (* way (- to from))))

(defun mean (numbers)
  "The mean of a sequence of numbers.
  Examples:
  (alexandria:mean '(1 2 3)) => 2"
  (/ (reduce #'+ numbers) (length numbers)))

;;; Symbols

(defun make-keyword (name)
  "The keyword of a name.
  Examples:
  (alexandria:make-keyword 'foo) => :FOO"
  (values (intern (string name) :keyword)))

(defun symbolicate (&rest names)
  "The symbol whose name is made of all names.
  Examples:
  (alexandria:symbolicate 'foo '- 'bar) => FOO-BAR"
  (values (intern (apply #'concatenate 'string (mapcar #'string names)))))
