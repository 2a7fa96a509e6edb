;;; Control: chapter 5 of the standard.

(in-package :common-lisp)

(defmacro when (test &body body)
  "The body if the test is true, else NIL.
  Examples:
  (when t 1 2) => 2"
  (list 'if test (%progn body)))

(defmacro unless (test &body body)
  "The body if the test is false, else NIL.
  Examples:
  (unless nil 1 2) => 2"
  (list 'if test nil (%progn body)))

(defun %progn (forms)
  "The forms as one."
  (if (and forms (null (cdr forms)))
      (car forms)
      (cons 'progn forms)))

(defmacro return (&optional value)
  "Leaves the block NIL: the innermost loop.
  Examples:
  (dolist (x '(1 2 3)) (when (= x 2) (return :found))) => :FOUND"
  (list 'return-from nil value))

(defmacro prog (bindings &body tags-and-statements)
  "LET, BLOCK NIL and TAGBODY in one.
  Examples:
  (prog ((i 0)) again (incf i) (when (< i 3) (go again)) (return i)) => 3"
  (%prog 'let bindings tags-and-statements))

(defmacro prog* (bindings &body tags-and-statements)
  "LET*, BLOCK NIL and TAGBODY in one.
  Examples:
  (prog* ((i 1) (j (+ i 1))) (return j)) => 2"
  (%prog 'let* bindings tags-and-statements))

(defun %prog (binder bindings body)
  "The form of PROG or PROG*."
  (multiple-value-bind (declarations forms) (%split-body body)
    `(block nil
       (,binder ,bindings ,@declarations (tagbody ,@forms)))))

(defun %split-body (body)
  "The declarations at the start of a body, and the other forms."
  (let ((forms (member-if-not (lambda (form) (and (consp form) (eq (car form) 'declare)))
                              body)))
    (values (ldiff body forms) forms)))

(defun %body-parts (body)
  "The declarations at the start of a body, the other forms, and the documentation string among the
  declarations, or NIL."
  (let ((declarations '())
        (text nil))
    (loop (let ((form (first body)))
            (cond ((and (consp form) (eq (first form) 'declare))
                   (push form declarations))
                  ((and (stringp form) (null text) (rest body))
                   (setq text form))
                  (t (return)))
            (setq body (rest body))))
    (values (nreverse declarations) body text)))

(defmacro prog2 (first second &rest forms)
  "The value of the second form, after all are evaluated.
  Examples:
  (prog2 1 2 3) => 2"
  `(progn ,first (prog1 ,second ,@forms)))

(defmacro multiple-value-setq (variables form)
  "Assigns variables the values of a form.
  Examples:
  (let (q r) (multiple-value-setq (q r) (floor 7 2)) (list q r)) => (3 1)"
  (if variables
      `(values (setf (values ,@variables) ,form))
      `(prog1 ,form)))

(defmacro nth-value (n form)
  "One of the values of a form, counted from 0.
  Examples:
  (nth-value 1 (floor 7 2)) => 1"
  `(nth ,n (multiple-value-list ,form)))

(defmacro time (form)
  "The values of a form, and a line on how long it took."
  `(call-with-timing (lambda () ,form)))

(defun system:call-with-timing (function)
  "Calls a function. A program that has clocks puts one in its place that tells the time."
  (funcall function))
