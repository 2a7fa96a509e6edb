;;;; Networks of fluents. They are made by the functions of CRAM-LANGUAGE that work on numbers and
;;;; fluents; these are other names for those functions.

(in-package :cram-language-implementation)

(defun fl+ (&rest numbers)
  "As CPL:+.
  Examples:
  (cpl:value (cpl:fl+ (cpl:make-fluent :value 1) 2)) => 3"
  (apply #'cpl:+ numbers))

(defun fl- (number &rest numbers)
  "As CPL:-.
  Examples:
  (cpl:value (cpl:fl- (cpl:make-fluent :value 1) 2)) => -1"
  (apply #'cpl:- number numbers))

(defun fl* (&rest numbers)
  "As CPL:*.
  Examples:
  (cpl:value (cpl:fl* (cpl:make-fluent :value 3) 2)) => 6"
  (apply #'cpl:* numbers))

(defun fl/ (number &rest numbers)
  "As CPL:/.
  Examples:
  (cpl:value (cpl:fl/ (cpl:make-fluent :value 6) 2)) => 3"
  (apply #'cpl:/ number numbers))

(defun fl< (number &rest numbers)
  "As CPL:<.
  Examples:
  (cpl:value (cpl:fl< (cpl:make-fluent :value 1) 2)) => T"
  (apply #'cpl:< number numbers))

(defun fl> (number &rest numbers)
  "As CPL:>.
  Examples:
  (cpl:value (cpl:fl> (cpl:make-fluent :value 1) 2)) => NIL"
  (apply #'cpl:> number numbers))

(defun fl= (number &rest numbers)
  "As CPL:=.
  Examples:
  (cpl:value (cpl:fl= (cpl:make-fluent :value 2) 2)) => T"
  (apply #'cpl:= number numbers))

(defun fl-eq (a b)
  "As CPL:EQ.
  Examples:
  (cpl:value (cpl:fl-eq (cpl:make-fluent :value 'a) 'a)) => T"
  (cpl:eq a b))

(defun fl-eql (a b)
  "As CPL:EQL.
  Examples:
  (cpl:value (cpl:fl-eql (cpl:make-fluent :value 2) 2)) => T"
  (cpl:eql a b))

(defun fl-not (object)
  "As CPL:NOT.
  Examples:
  (cpl:value (cpl:fl-not (cpl:make-fluent :value t))) => NIL"
  (cpl:not object))
