;;;; ALEXANDRIA: types, and predicates for them.

(in-package :alexandria)

(%export-names "ARRAY-INDEX" "ARRAY-LENGTH" "CIRCULAR-LIST" "PROPER-LIST" "PROPER-SEQUENCE"
               "STRING-DESIGNATOR")

(deftype array-index (&optional (length (1- array-dimension-limit)))
  `(integer 0 (,length)))

(deftype array-length (&optional (length (1- array-dimension-limit)))
  `(integer 0 ,length))

(deftype proper-list () '(and list (satisfies proper-list-p)))

(deftype circular-list () '(and cons (satisfies circular-list-p)))

(deftype proper-sequence () '(or proper-list (and sequence (not list))))

(deftype string-designator () '(or symbol string character))

;;; Types of numbers by their sign: POSITIVE-INTEGER, NON-NEGATIVE-REAL, …

(%define-number-types)

(defun %define-number-types ()
  "Defines the types of numbers by their sign, for each type of real numbers."
  (dolist (base '(fixnum integer rational real float short-float single-float double-float
                  long-float))
    (loop for (sign low high) in '(("POSITIVE" (zero) *) ("NEGATIVE" * (zero))
                                   ("NON-POSITIVE" * zero) ("NON-NEGATIVE" zero *))
          for name = (format nil "~a-~a" sign base)
          do (%export-names name)
             (let ((specifier (%number-type base low high)))
               (%define-type (find-symbol name :alexandria)
                             (lambda (arguments)
                               (declare (ignore arguments))
                               specifier)
                             (list specifier))))))

(defun %number-type (base low high)
  "The type of the numbers of a base type within limits, in which ZERO is the zero of that type."
  (case base
    (fixnum `(and fixnum ,(%number-type 'integer low high)))
    ;; A negative zero is no negative number.
    (t (let ((zero (if (subtypep base 'float) (coerce 0 base) 0)))
         (list base (subst zero 'zero low) (subst zero 'zero high))))))

;;; Predicates

(defun of-type (type)
  "A predicate: is an object of this type?
  Examples:
  (funcall (alexandria:of-type 'symbol) 'a) => T"
  (lambda (object) (typep object type)))

(defun type= (type-1 type-2)
  "Are two types the same? The second value says whether that could be decided.
  Examples:
  (alexandria:type= 'list '(or cons null)) => T ; T"
  (multiple-value-bind (part-p sure-p) (subtypep type-1 type-2)
    (multiple-value-bind (whole-p also-sure-p) (subtypep type-2 type-1)
      (cond ((and part-p whole-p) (values t t))
            ((or (and sure-p (not part-p)) (and also-sure-p (not whole-p))) (values nil t))
            (t (values nil nil))))))

(define-modify-macro coercef (type) coerce
  "Coerces the value of a place to a type.
  Examples:
  (let ((n 1)) (alexandria:coercef n 'float) n) => 1.0")

(defun positive-fixnum-p (object)
  "Is the object a fixnum greater than zero?
  Examples:
  (alexandria:positive-fixnum-p 1) => T"
  (typep object 'positive-fixnum))

(defun negative-fixnum-p (object)
  "Is the object a fixnum less than zero?
  Examples:
  (alexandria:negative-fixnum-p -1) => T"
  (typep object 'negative-fixnum))

(defun non-positive-fixnum-p (object)
  "Is the object a fixnum not greater than zero?
  Examples:
  (alexandria:non-positive-fixnum-p 0) => T"
  (typep object 'non-positive-fixnum))

(defun non-negative-fixnum-p (object)
  "Is the object a fixnum not less than zero?
  Examples:
  (alexandria:non-negative-fixnum-p 0) => T"
  (typep object 'non-negative-fixnum))

(defun positive-integer-p (object)
  "Is the object an integer greater than zero?
  Examples:
  (alexandria:positive-integer-p 1) => T"
  (typep object 'positive-integer))

(defun negative-integer-p (object)
  "Is the object an integer less than zero?
  Examples:
  (alexandria:negative-integer-p -1) => T"
  (typep object 'negative-integer))

(defun non-positive-integer-p (object)
  "Is the object an integer not greater than zero?
  Examples:
  (alexandria:non-positive-integer-p 0) => T"
  (typep object 'non-positive-integer))

(defun non-negative-integer-p (object)
  "Is the object an integer not less than zero?
  Examples:
  (alexandria:non-negative-integer-p 0) => T"
  (typep object 'non-negative-integer))

(defun positive-rational-p (object)
  "Is the object a rational greater than zero?
  Examples:
  (alexandria:positive-rational-p 1/2) => T"
  (typep object 'positive-rational))

(defun negative-rational-p (object)
  "Is the object a rational less than zero?
  Examples:
  (alexandria:negative-rational-p -1/2) => T"
  (typep object 'negative-rational))

(defun non-positive-rational-p (object)
  "Is the object a rational not greater than zero?
  Examples:
  (alexandria:non-positive-rational-p 0) => T"
  (typep object 'non-positive-rational))

(defun non-negative-rational-p (object)
  "Is the object a rational not less than zero?
  Examples:
  (alexandria:non-negative-rational-p 0) => T"
  (typep object 'non-negative-rational))

(defun positive-real-p (object)
  "Is the object a real greater than zero?
  Examples:
  (alexandria:positive-real-p 1) => T"
  (typep object 'positive-real))

(defun negative-real-p (object)
  "Is the object a real less than zero?
  Examples:
  (alexandria:negative-real-p -1.0) => T"
  (typep object 'negative-real))

(defun non-positive-real-p (object)
  "Is the object a real not greater than zero?
  Examples:
  (alexandria:non-positive-real-p 0) => T"
  (typep object 'non-positive-real))

(defun non-negative-real-p (object)
  "Is the object a real not less than zero?
  Examples:
  (alexandria:non-negative-real-p 0) => T"
  (typep object 'non-negative-real))

(defun positive-float-p (object)
  "Is the object a float greater than zero?
  Examples:
  (alexandria:positive-float-p 1.0) => T"
  (typep object 'positive-float))

(defun negative-float-p (object)
  "Is the object a float less than zero?
  Examples:
  (alexandria:negative-float-p -1.0) => T"
  (typep object 'negative-float))

(defun non-positive-float-p (object)
  "Is the object a float not greater than zero?
  Examples:
  (alexandria:non-positive-float-p 0.0) => T"
  (typep object 'non-positive-float))

(defun non-negative-float-p (object)
  "Is the object a float not less than zero?
  Examples:
  (alexandria:non-negative-float-p 0.0) => T"
  (typep object 'non-negative-float))

(defun positive-short-float-p (object)
  "Is the object a short-float greater than zero?
  Examples:
  (alexandria:positive-short-float-p 1.0) => T"
  (typep object 'positive-short-float))

(defun negative-short-float-p (object)
  "Is the object a short-float less than zero?
  Examples:
  (alexandria:negative-short-float-p -1.0) => T"
  (typep object 'negative-short-float))

(defun non-positive-short-float-p (object)
  "Is the object a short-float not greater than zero?
  Examples:
  (alexandria:non-positive-short-float-p 0.0) => T"
  (typep object 'non-positive-short-float))

(defun non-negative-short-float-p (object)
  "Is the object a short-float not less than zero?
  Examples:
  (alexandria:non-negative-short-float-p 0.0) => T"
  (typep object 'non-negative-short-float))

(defun positive-single-float-p (object)
  "Is the object a single-float greater than zero?
  Examples:
  (alexandria:positive-single-float-p 1.0) => T"
  (typep object 'positive-single-float))

(defun negative-single-float-p (object)
  "Is the object a single-float less than zero?
  Examples:
  (alexandria:negative-single-float-p -1.0) => T"
  (typep object 'negative-single-float))

(defun non-positive-single-float-p (object)
  "Is the object a single-float not greater than zero?
  Examples:
  (alexandria:non-positive-single-float-p 0.0) => T"
  (typep object 'non-positive-single-float))

(defun non-negative-single-float-p (object)
  "Is the object a single-float not less than zero?
  Examples:
  (alexandria:non-negative-single-float-p 0.0) => T"
  (typep object 'non-negative-single-float))

(defun positive-double-float-p (object)
  "Is the object a double-float greater than zero?
  Examples:
  (alexandria:positive-double-float-p 1d0) => T"
  (typep object 'positive-double-float))

(defun negative-double-float-p (object)
  "Is the object a double-float less than zero?
  Examples:
  (alexandria:negative-double-float-p -1d0) => T"
  (typep object 'negative-double-float))

(defun non-positive-double-float-p (object)
  "Is the object a double-float not greater than zero?
  Examples:
  (alexandria:non-positive-double-float-p 0d0) => T"
  (typep object 'non-positive-double-float))

(defun non-negative-double-float-p (object)
  "Is the object a double-float not less than zero?
  Examples:
  (alexandria:non-negative-double-float-p 0d0) => T"
  (typep object 'non-negative-double-float))

(defun positive-long-float-p (object)
  "Is the object a long-float greater than zero?
  Examples:
  (alexandria:positive-long-float-p 1d0) => T"
  (typep object 'positive-long-float))

(defun negative-long-float-p (object)
  "Is the object a long-float less than zero?
  Examples:
  (alexandria:negative-long-float-p -1d0) => T"
  (typep object 'negative-long-float))

(defun non-positive-long-float-p (object)
  "Is the object a long-float not greater than zero?
  Examples:
  (alexandria:non-positive-long-float-p 0d0) => T"
  (typep object 'non-positive-long-float))

(defun non-negative-long-float-p (object)
  "Is the object a long-float not less than zero?
  Examples:
  (alexandria:non-negative-long-float-p 0d0) => T"
  (typep object 'non-negative-long-float))
