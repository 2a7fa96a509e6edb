;;;; CRAM-UTILITIES: values and lists that are computed when they are asked for. A lazy list is a
;;;; list whose last pair has a function in place of its rest; once that has been called, the pair
;;;; holds the rest itself, so that a lazy list turns into an ordinary one.

(in-package :cram-utilities)

(defvar system::%*lazy-variables* '()
  "Special variables that the functions of lazy lists bind when they are called.")

(defvar system::%*lazy-values* '()
  "Their values.")

(defun %tail (function)
  "The function in place of a rest: it keeps the dynamic environment of lazy lists."
  (let ((variables %*lazy-variables*)
        (values %*lazy-values*))
    (if variables
        (lambda ()
          (let ((%*lazy-variables* variables)
                (%*lazy-values* values))
            (progv variables values (funcall function))))
        function)))

(defmacro %lazily (first rest)
  "A list of a first element, and of a rest that is computed when it is asked for."
  `(cons ,first (%tail (lambda () ,rest))))

(defmacro with-lazy-list-dynamic-environment (bindings &body body)
  "Binds special variables around the body, and whenever lazy lists that are made in it are
  continued.
  Examples:
  (progn (defvar *step* 1) (let ((l (cut:with-lazy-list-dynamic-environment ((*step* 5)) (cut:lazy-list ((i 0)) (cut:cont i (+ i *step*)))))) (cut:force-ll (cut:lazy-take 3 l)))) => (0 5 10)"
  (let ((values (gensym "VALUES"))
        (variables (mapcar (lambda (binding) (if (consp binding) (first binding) binding))
                           bindings)))
    `(let ((,values (list ,@(mapcar (lambda (binding) (if (consp binding) (second binding) nil))
                                    bindings))))
       (let ((%*lazy-variables* (append ',variables %*lazy-variables*))
             (%*lazy-values* (append ,values %*lazy-values*)))
         (progv ',variables ,values ,@body)))))

(defmacro lazy-list (bindings &body body)
  "A list whose elements the body computes, one after the other, when they are asked for.
  (CUT:CONT ELEMENT VALUE…) gives an element and the values of the variables for the next one;
  (CUT:NEXT VALUE…) computes again with other values; (CUT:FINISH ELEMENT) gives the last element. If
  the body ends without any of these, the list ends.
  Examples:
  (cut:force-ll (cut:lazy-list ((i 0)) (when (< i 3) (cut:cont i (1+ i))))) => (0 1 2)"
  (let ((step (gensym "STEP"))
        (again (gensym "AGAIN"))
        (element (gensym "ELEMENT"))
        (values (gensym "VALUES"))
        (variables (mapcar (lambda (binding) (if (consp binding) (first binding) binding))
                           bindings))
        (new-values (mapcar (lambda (binding) (declare (ignore binding)) (gensym "NEW"))
                            bindings)))
    `(labels ((,step (&optional ,@variables)
                (block ,step
                  (tagbody
                     ,again
                     (flet ((cont (,element &rest ,values)
                              (return-from ,step (%lazily ,element (apply #',step ,values))))
                            (finish (&rest ,element)
                              (return-from ,step ,element))
                            (next (&rest ,values)
                              (destructuring-bind (&optional ,@new-values) ,values
                                (setf ,@(mapcan #'list variables new-values)))
                              (go ,again)))
                       (declare (ignorable #'cont #'finish #'next))
                       ,@body))
                  nil)))
       (,step ,@(mapcar (lambda (binding) (if (consp binding) (second binding) nil))
                        bindings)))))

(defmacro cont (element &rest values)
  "In LAZY-LIST: gives an element, and the values of the variables for the next one."
  (declare (ignore element values))
  (%outside-lazy-list 'cont))

(defmacro next (&rest values)
  "In LAZY-LIST: computes again with other values of the variables."
  (declare (ignore values))
  (%outside-lazy-list 'next))

(defmacro finish (&rest element)
  "In LAZY-LIST: gives the last element, or ends the list."
  (declare (ignore element))
  (%outside-lazy-list 'finish))

(defun %outside-lazy-list (name)
  "The error of what has a meaning in LAZY-LIST alone."
  (error 'simple-program-error :format-control "~a has a meaning only in the body of LAZY-LIST."
                               :format-arguments (list name)))

(defun lazy-list-p (object)
  "Is this a list whose rest has not been computed yet?
  Examples:
  (cut:lazy-list-p (cut:lazy-mapcar #'1+ '(1 2))) => T
  (cut:lazy-list-p '(1 2)) => NIL"
  (and (consp object)
       (functionp (cdr (last object)))))

(defun lazy-car (list)
  "The first element.
  Examples:
  (cut:lazy-car '(1 2)) => 1"
  (car list))

(defun lazy-cdr (list)
  "The list without its first element, computed if need be.
  Examples:
  (cut:lazy-cdr '(1 2)) => (2)"
  (let ((rest (cdr list)))
    (if (functionp rest)
        (setf (cdr list) (funcall rest))
        rest)))

(defun lazy-elt (list index)
  "The element at an index.
  Examples:
  (cut:lazy-elt (cut:lazy-mapcar #'1+ '(1 2 3)) 2) => 4"
  (loop repeat index do (setf list (lazy-cdr list)))
  (lazy-car list))

(defun force-ll (list &optional limit)
  "The list with all its elements, which are computed now; with a limit, a list of at most so many.
  Examples:
  (cut:force-ll (cut:lazy-mapcar #'1+ '(1 2))) => (2 3)
  (cut:force-ll (cut:lazy-list ((i 0)) (cut:cont i (1+ i))) 3) => (0 1 2)"
  (if limit
      (force-ll (lazy-take limit list))
      (loop for rest = list then (lazy-cdr rest)
            while rest
            finally (return list))))

(defun copy-lazy-list (list)
  "A copy; what has not been computed yet is computed by whichever is asked first, for itself.
  Examples:
  (cut:copy-lazy-list '(1 2)) => (1 2)"
  (copy-list list))

(defun lazy-take (count list)
  "The first elements, at most so many.
  Examples:
  (cut:force-ll (cut:lazy-take 2 '(1 2 3))) => (1 2)"
  (cond ((or (null list) (<= count 0)) nil)
        ((= count 1) (list (lazy-car list)))
        (t (%lazily (lazy-car list) (lazy-take (1- count) (lazy-cdr list))))))

(defun lazy-skip (count list)
  "The list without so many elements.
  Examples:
  (cut:lazy-skip 2 '(1 2 3)) => (3)"
  (loop repeat count do (setf list (lazy-cdr list)))
  list)

(defun lazy-mapcar (function list &rest lists)
  "Like MAPCAR; the function is called for an element when that is asked for.
  Examples:
  (cut:force-ll (cut:lazy-mapcar #'1+ '(1 2))) => (2 3)"
  (let ((lists (cons list lists)))
    (unless (some #'null lists)
      (%lazily (apply function (mapcar #'lazy-car lists))
               (apply #'lazy-mapcar function (mapcar #'lazy-cdr lists))))))

(defun lazy-mapcan (function list &rest lists)
  "The elements of the lists that a function returns, which is called when they are asked for.
  Examples:
  (cut:force-ll (cut:lazy-mapcan #'list '(1 2))) => (1 2)"
  (loop for rests = (cons list lists) then (mapcar #'lazy-cdr rests)
        until (some #'null rests)
        do (let ((part (apply function (mapcar #'lazy-car rests))))
             (unless (listp part)
               (error "The function of LAZY-MAPCAN returned ~s; a list was expected." part))
             (when part
               (return (%lazy-append part
                                     (lambda ()
                                       (apply #'lazy-mapcan function
                                              (mapcar #'lazy-cdr rests)))))))))

(defun %lazy-append (list rest)
  "The elements of a list, then those of the list that a function returns."
  (if list
      (%lazily (lazy-car list) (%lazy-append (lazy-cdr list) rest))
      (funcall rest)))

(defun lazy-append (list &rest lists)
  "All elements of all lists.
  Examples:
  (cut:force-ll (cut:lazy-append '(1) '(2))) => (1 2)"
  (if lists
      (%lazy-append list (lambda () (apply #'lazy-append lists)))
      list))

(defun lazy-filter (predicate list)
  "The elements for which the predicate holds; none after one for which its second value is true.
  Examples:
  (cut:force-ll (cut:lazy-filter #'oddp '(1 2 3))) => (1 3)"
  (loop for rest = list then (lazy-cdr rest)
        while rest
        do (multiple-value-bind (is-kept is-last) (funcall predicate (lazy-car rest))
             (cond ((and is-kept is-last) (return (list (lazy-car rest))))
                   (is-kept (return (%lazily (lazy-car rest)
                                             (lazy-filter predicate (lazy-cdr rest)))))
                   (is-last (return nil))))))

(defun lazy-fold (function list &key (initial-value nil has-initial-value))
  "What a function of two arguments makes of all elements, as REDUCE.
  Examples:
  (cut:lazy-fold #'+ (cut:lazy-mapcar #'1+ '(1 2 3))) => 9"
  (loop with rest = (if has-initial-value list (lazy-cdr list))
        with result = (if has-initial-value initial-value (lazy-car list))
        while rest
        do (setf result (funcall function result (lazy-car rest))
                 rest (lazy-cdr rest))
        finally (return result)))

(defun lazy-flatten (list)
  "The elements of a list and of all lists in it.
  Examples:
  (cut:force-ll (cut:lazy-flatten '(1 (2 (3)) 4))) => (1 2 3 4)"
  (lazy-mapcan (lambda (element)
                 (if (listp element) (lazy-flatten element) (list element)))
               list))

(defun lazy-rests (list)
  "The list, the list without its first element, and so on.
  Examples:
  (cut:force-ll (cut:lazy-rests '(1 2))) => ((1 2) (2))"
  (when list
    (%lazily list (lazy-rests (lazy-cdr list)))))

(defmacro lazy-dolist ((variable list &optional result) &body body)
  "Like DOLIST; elements are computed one at a time.
  Examples:
  (let ((s 0)) (cut:lazy-dolist (x (cut:lazy-mapcar #'1+ '(1 2 3)) s) (incf s x))) => 9"
  (let ((rest (gensym "REST")))
    `(do* ((,rest ,list (lazy-cdr ,rest))
           (,variable (lazy-car ,rest) (lazy-car ,rest)))
          ((null ,rest) ,result)
       ,@body)))

(defstruct (delay (:constructor system::%make-delay (function)))
  "A value that is computed when FORCE asks for it."
  function value)

(defmacro delay (&body body)
  "A value that the body computes when FORCE asks for it for the first time.
  Examples:
  (let* ((n 0) (d (cut:delay (incf n)))) (list n (cut:force d) (cut:force d))) => (0 1 1)"
  `(%make-delay (lambda () ,@body)))

(defun force (object)
  "The value of a DELAY; any other object itself.
  Examples:
  (cut:force 1) => 1"
  (cond ((not (delay-p object)) object)
        ((delay-function object)
         (let ((value (funcall (delay-function object))))
           (setf (delay-function object) nil
                 (delay-value object) value)))
        (t (delay-value object))))
