;;;; ALEXANDRIA: functions.

(in-package :alexandria)

(defun ensure-function (designator)
  "The function that a symbol or function means.
  Examples:
  (funcall (alexandria:ensure-function 'car) '(1)) => 1"
  (coerce designator 'function))

(defmacro ensure-functionf (&rest places)
  "Replaces the function designators in places by their functions.
  Examples:
  (let ((f 'car)) (alexandria:ensure-functionf f) (functionp f)) => T"
  `(progn ,@(loop for place in places collect `(%ensure-functionf ,place))))

(define-modify-macro %ensure-functionf () ensure-function
  "ENSURE-FUNCTIONF for one place.")

(defun compose (function &rest more)
  "A function that calls the last function, then the one before with the result, and so on.
  Examples:
  (funcall (alexandria:compose #'list #'length) '(a b)) => (2)"
  (reduce (lambda (outer inner)
            (lambda (&rest arguments)
              (funcall outer (apply inner arguments))))
          (mapcar #'ensure-function (cons function more))))

(defun multiple-value-compose (function &rest more)
  "Like `compose`; each function gets all values of the next.
  Examples:
  (funcall (alexandria:multiple-value-compose #'list #'floor) 7 2) => (3 1)"
  (reduce (lambda (outer inner)
            (lambda (&rest arguments)
              (multiple-value-call outer (apply inner arguments))))
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
      (loop for (predicate . rest) on predicates
            unless rest
              return (apply predicate arguments)
            unless (apply predicate arguments)
              return nil))))

(defun disjoin (predicate &rest more)
  "A predicate that is true where one is.
  Examples:
  (funcall (alexandria:disjoin #'consp #'null) nil) => T"
  (let ((predicates (mapcar #'ensure-function (cons predicate more))))
    (lambda (&rest arguments)
      (loop for (predicate . rest) on predicates
            unless rest
              return (apply predicate arguments)
            thereis (apply predicate arguments)))))

(defmacro named-lambda (name lambda-list &body body)
  "A function with a name, by which it can call itself.
  Examples:
  (funcall (alexandria:named-lambda down (n) (if (plusp n) (down (1- n)) n)) 3) => 0"
  `(labels ((,name ,lambda-list ,@body)) #',name))
