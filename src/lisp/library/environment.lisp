;;; What the standard lets programs ask about machine and software (chapter 25). Programs that ask see
;;; the same everywhere, so that their output is.

(in-package :common-lisp)

(defun machine-instance ()
  "The name of the machine: NIL, since it is not told.
  Examples:
  (machine-instance) => NIL"
  nil)

(defun machine-type ()
  "The kind of the machine: NIL, since it is not told.
  Examples:
  (machine-type) => NIL"
  nil)

(defun machine-version ()
  "The version of the machine: NIL, since it is not told.
  Examples:
  (machine-version) => NIL"
  nil)

(defun software-type ()
  "The operating system: NIL, since it is not told.
  Examples:
  (software-type) => NIL"
  nil)

(defun software-version ()
  "The version of the operating system: NIL, since it is not told.
  Examples:
  (software-version) => NIL"
  nil)

(defun short-site-name ()
  "The name of the site: NIL, since it is not told.
  Examples:
  (short-site-name) => NIL"
  nil)

(defun long-site-name ()
  "The name of the site: NIL, since it is not told.
  Examples:
  (long-site-name) => NIL"
  nil)

(defun room (&optional (detail :default))
  "Tells that it is not told how much memory is in use: programs print the same everywhere.
  Examples:
  (let ((*standard-output* (make-broadcast-stream))) (room)) => NIL"
  (check-type detail (member t nil :default))
  (format t "How much memory is in use is not told.~%")
  nil)

(defun disassemble (function)
  "Tells that the code of a function is not shown; its source may be.
  Examples:
  (let ((*standard-output* (make-broadcast-stream))) (disassemble 'car)) => NIL"
  (when (and (consp function) (eq (first function) 'lambda))
    (setf function (coerce function 'function)))
  (unless (or (functionp function) (fboundp function))
    (error 'undefined-function :name function))
  (format t "The code of ~s is not shown~:[~;; (describe '~:*~s) tells more~].~%"
          function (and (symbolp function) function))
  nil)

(defun dribble (&optional file)
  "Signals that a session cannot be written to a file from inside.
  Examples:
  (handler-case (dribble \"a.txt\") (error () 'cannot)) => CANNOT"
  (declare (ignore file))
  (error "DRIBBLE is not there: what a session prints is not written to a file from inside."))

(defmacro step (form)
  "The values of the form. Nothing stops in between: forms are compiled before they are evaluated. TRACE shows calls, BREAK stops.
  Examples:
  (handler-bind ((warning #'muffle-warning)) (eval '(step (+ 1 2)))) => 3"
  `(progn
     (warn 'simple-style-warning
           :format-control "STEP stops nowhere; (trace …) shows calls and (break) stops at a place.")
     ,form))

(defun ed (&optional file)
  "Signals that there is no editor.
  Examples:
  (handler-case (ed \"a.lisp\") (error () 'cannot)) => CANNOT"
  (declare (ignore file))
  (error "There is no editor here; planwright works with Emacs."))

(defun compile-file (file &key output-file verbose print external-format)
  "Signals that there are no compiled files: LOAD compiles what it reads.
  Examples:
  (handler-case (compile-file \"a.lisp\") (error () 'cannot)) => CANNOT"
  (declare (ignore output-file verbose print external-format))
  (error "There are no compiled files; (load ~s) reads the source and compiles each form." file))
