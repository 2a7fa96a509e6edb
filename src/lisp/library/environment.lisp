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
