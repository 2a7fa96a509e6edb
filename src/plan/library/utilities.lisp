;;;; CRAM-UTILITIES: bindings, and lazy lists, which are ordinary lists here.

(in-package :cram-utilities)

(defun is-var (object)
  "Is this a ?variable?
  Examples:
  (cut:is-var '?x) => T"
  (and (symbolp object)
       (alexandria:starts-with-subseq "?" (symbol-name object))))

(defun var-value (variable bindings)
  "What a ?variable is bound to in a list of bindings; itself if it is not.
  Examples:
  (cut:var-value '?x '((?x . 1))) => 1"
  (loop with value = variable
        ;; Variables may be bound to variables; a chain is no longer than the list.
        repeat (length bindings)
        for binding = (and (is-var value) (assoc value bindings))
        while binding
        do (setf value (cdr binding))
        finally (return value)))

(defmacro with-vars-bound (variables bindings &body body)
  "Binds ?variables to what a list of bindings says of them.
  Examples:
  (cut:with-vars-bound (?x) '((?x . 1)) ?x) => 1"
  (let ((all (gensym "BINDINGS")))
    `(let* ((,all ,bindings)
            ,@(loop for variable in variables
                    collect `(,variable (var-value ',variable ,all))))
       ,@body)))

(defun lazy-car (list)
  "The first element.
  Examples:
  (cut:lazy-car '(1 2)) => 1"
  (car list))

(defun lazy-cdr (list)
  "The list without its first element.
  Examples:
  (cut:lazy-cdr '(1 2)) => (2)"
  (cdr list))

(defun force-ll (list)
  "The list with all its elements.
  Examples:
  (cut:force-ll '(1 2)) => (1 2)"
  (the list list))

(defun lazy-take (count list)
  "The first elements, at most so many.
  Examples:
  (cut:lazy-take 2 '(1 2 3)) => (1 2)"
  (loop repeat count
        for element in list
        collect element))

(defun lazy-mapcar (function list &rest lists)
  "Like MAPCAR.
  Examples:
  (cut:lazy-mapcar #'1+ '(1 2)) => (2 3)"
  (apply #'mapcar function list lists))

(defun lazy-mapcan (function list &rest lists)
  "Like MAPCAN.
  Examples:
  (cut:lazy-mapcan #'list '(1 2)) => (1 2)"
  (apply #'mapcan function list lists))

(defun lazy-filter (predicate list)
  "The elements for which the predicate holds.
  Examples:
  (cut:lazy-filter #'oddp '(1 2 3)) => (1 3)"
  (remove-if-not predicate list))

(defun lazy-append (list &rest lists)
  "All elements of all lists.
  Examples:
  (cut:lazy-append '(1) '(2)) => (1 2)"
  (apply #'append list lists))

(defmacro lazy-dolist ((variable list &optional result) &body body)
  "Like DOLIST.
  Examples:
  (let ((s 0)) (cut:lazy-dolist (x '(1 2) s) (incf s x))) => 3"
  `(dolist (,variable ,list ,result) ,@body))
