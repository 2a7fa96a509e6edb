;;; Control: chapter 5 of the standard.

(in-package :common-lisp)

(defmacro prog2 (first second &rest forms)
  "The value of the second form, after all are evaluated.
  Examples:
  (prog2 1 2 3) => 2"
  `(progn ,first (prog1 ,second ,@forms)))

(defmacro nth-value (n form)
  "One of the values of a form, counted from 0.
  Examples:
  (nth-value 1 (floor 7 2)) => 1"
  `(nth ,n (multiple-value-list ,form)))
