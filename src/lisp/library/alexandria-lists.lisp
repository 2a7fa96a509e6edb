;;;; ALEXANDRIA: lists, property lists and association lists.

(in-package :alexandria)

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

(defun lastcar (list)
  "The last element of a list, or `NIL`. It is a place.
  Examples:
  (alexandria:lastcar '(1 2 3)) => 3
  (let ((l (list 1 2))) (setf (alexandria:lastcar l) 3) l) => (1 3)"
  (%check-sequence list)
  (first (last list)))

(defun (setf lastcar) (object list)
  "Replaces the last element of a list."
  (%check-sequence list)
  (setf (first (last list)) object))

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

(defun map-product (function list &rest lists)
  "The results of a function for every combination of elements of the lists; the last list is run
  through first.
  Examples:
  (alexandria:map-product #'list '(1 2) '(a b)) => ((1 A) (1 B) (2 A) (2 B))"
  (labels ((results (function lists)
             (if (rest lists)
                 (loop for element in (first lists)
                       append (results (curry function element) (rest lists)))
                 (mapcar function (first lists)))))
    (results (ensure-function function) (cons list lists))))

;;; What kind of list

(defun %cells (object)
  "The number of pairs from an object on, and what ends them: an atom, or :CIRCULAR."
  (let ((count 0)
        (slow object))
    (loop
      (when (atom object) (return (values count object)))
      (setf object (cdr object))
      (incf count)
      (when (evenp count) (setf slow (cdr slow)))
      (when (and (consp object) (eq object slow))
        (return (values count :circular))))))

(defun proper-list-p (object)
  "Is the object a list that ends with `NIL`?
  Examples:
  (alexandria:proper-list-p '(1 . 2)) => NIL"
  (and (listp object) (null (nth-value 1 (%cells object)))))

(defun proper-list-length (list)
  "The length of a list; an error if it does not end with `NIL`.
  Examples:
  (alexandria:proper-list-length '(1 2)) => 2"
  (if (proper-list-p list)
      (length list)
      (error 'type-error :datum list :expected-type 'proper-list)))

(defun circular-list-p (object)
  "Is the object a list that leads back into itself?
  Examples:
  (alexandria:circular-list-p (alexandria:circular-list 1)) => T"
  (and (consp object) (eq (nth-value 1 (%cells object)) :circular)))

(defun circular-tree-p (object)
  "Is a pair of the tree part of itself?
  Examples:
  (alexandria:circular-tree-p '(1 (2))) => NIL"
  (let ((outside (make-hash-table :test 'eq))
        (finished (make-hash-table :test 'eq)))
    (labels ((visit (part)
               (cond ((or (atom part) (gethash part finished)) nil)
                     ((gethash part outside) (return-from circular-tree-p t))
                     (t (setf (gethash part outside) t)
                        (visit (car part))
                        (visit (cdr part))
                        (remhash part outside)
                        (setf (gethash part finished) t)
                        nil))))
      (visit object))))

(defun circular-list (&rest elements)
  "A list of the elements that leads back to its beginning.
  Examples:
  (third (alexandria:circular-list 1 2)) => 1"
  (let ((list (copy-list elements)))
    (when list (setf (cdr (last list)) list))))

(defun make-circular-list (length &key initial-element)
  "A list of so many elements that leads back to its beginning.
  Examples:
  (third (alexandria:make-circular-list 2 :initial-element 'a)) => A"
  (apply #'circular-list (make-list length :initial-element initial-element)))

;;; Sets

(defun setp (object &key (test #'eql) (key #'identity))
  "Is the object a list in which no element occurs twice?
  Examples:
  (alexandria:setp '(1 2 1)) => NIL"
  (and (proper-list-p object)
       (let ((key (or key #'identity)))
         (loop for (element . rest) on object
               never (member (funcall key element) rest :test test :key key)))))

(defun set-equal (list-1 list-2 &key (test #'eql) (key nil))
  "Have two lists the same elements, whatever their order?
  Examples:
  (alexandria:set-equal '(1 2) '(2 1 1)) => T"
  (let ((key (or key #'identity)))
    (flet ((contains-p (whole part)
             (every (lambda (element)
                      (member (funcall key element) whole :test test :key key))
                    part)))
      (and (contains-p list-2 list-1)
           (contains-p list-1 list-2)
           t))))

;;; Property lists

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

(defun delete-from-plist (plist &rest keys)
  "Like `remove-from-plist`, but changes the property list.
  Examples:
  (alexandria:delete-from-plist (list :a 1 :b 2) :a) => (:B 2)"
  (let ((before nil)
        (rest plist))
    (loop while rest
          do (cond ((not (member (first rest) keys))
                    (setf before (rest rest)))
                   (before (setf (rest before) (cddr rest)))
                   (t (setf plist (cddr rest))))
             (setf rest (cddr rest)))
    plist))

(defun alexandria-2:delete-from-plist* (plist &rest keys)
  "Like `delete-from-plist`; the second value is an association list of what was removed, the last first.
  Examples:
  (alexandria-2:delete-from-plist* (list :a 1 :b 2) :a) => (:B 2) ; ((:A . 1))"
  (let ((removed '()))
    (doplist (key value plist)
      (when (member key keys) (push (cons key value) removed)))
    (values (apply #'delete-from-plist plist keys) removed)))

(define-modify-macro remove-from-plistf (&rest keys) remove-from-plist
  "Removes keys from the property list in a place.
  Examples:
  (let ((p (list :a 1 :b 2))) (alexandria:remove-from-plistf p :a) p) => (:B 2)")

(define-modify-macro delete-from-plistf (&rest keys) delete-from-plist
  "Removes keys from the property list in a place, which may be changed.
  Examples:
  (let ((p (list :a 1 :b 2))) (alexandria:delete-from-plistf p :a) p) => (:B 2)")

(defmacro doplist ((key value plist &optional result) &body body)
  "Evaluates the body for each entry of a property list.
  Examples:
  (let (r) (alexandria:doplist (k v '(:a 1 :b 2) r) (push (list k v) r))) => ((:B 2) (:A 1))"
  (multiple-value-bind (forms declarations) (parse-body body)
    (let ((rest (gensym "PLIST")))
      `(do ((,rest ,plist (cddr ,rest)))
           ((endp ,rest)
            (let ((,key nil) (,value nil))
              (declare (ignorable ,key ,value))
              ,result))
         (let ((,key (first ,rest))
               (,value (second ,rest)))
           ,@declarations
           (tagbody ,@forms))))))

;;; Association lists

(defun assoc-value (alist key &key (test #'eql))
  "The value of a key in an association list, and its entry. It is a place.
  Examples:
  (alexandria:assoc-value '((a . 1)) 'a) => 1 ; (A . 1)
  (let ((l (list (cons 'a 1)))) (setf (alexandria:assoc-value l 'b) 2) l) => ((B . 2) (A . 1))"
  (let ((entry (assoc key alist :test test)))
    (values (cdr entry) entry)))

(defun rassoc-value (alist value &key (test #'eql))
  "The key of a value in an association list, and its entry. It is a place.
  Examples:
  (alexandria:rassoc-value '((a . 1)) 1) => A ; (A . 1)"
  (let ((entry (rassoc value alist :test test)))
    (values (car entry) entry)))

(define-setf-expander assoc-value (alist key &key (test '#'eql) &environment environment)
  (%entry-expansion alist key test environment
                    (lambda (key test list) `(assoc ,key ,list :test ,test))
                    (lambda (entry new) `(setf (cdr ,entry) ,new))
                    (lambda (key new list) `(acons ,key ,new ,list))
                    'cdr))

(define-setf-expander rassoc-value (alist value &key (test '#'eql) &environment environment)
  (%entry-expansion alist value test environment
                    (lambda (value test list) `(rassoc ,value ,list :test ,test))
                    (lambda (entry new) `(setf (car ,entry) ,new))
                    (lambda (value new list) `(acons ,new ,value ,list))
                    'car))

(defun %entry-expansion (place item test environment find change add read)
  "The setf expansion for the other half of an entry in the association list in a place. Functions make
the forms that find an entry, change it and add one."
  (multiple-value-bind (variables forms stores writer reader)
      (get-setf-expansion place environment)
    (let ((item-variable (gensym "ITEM"))
          (test-variable (gensym "TEST"))
          (list (gensym "LIST"))
          (entry (gensym "ENTRY"))
          (new (gensym "NEW")))
      (values (append variables (list item-variable test-variable list entry))
              (append forms
                      (list item test reader
                            (funcall find item-variable test-variable list)))
              (list new)
              `(progn
                 (if ,entry
                     ,(funcall change entry new)
                     (let ((,(first stores) ,(funcall add item-variable new list)))
                       ,writer))
                 ,new)
              `(,read ,entry)))))
