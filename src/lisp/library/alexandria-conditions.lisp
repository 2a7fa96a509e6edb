;;;; ALEXANDRIA: conditions with a text of their own.

(in-package :alexandria)

(%export-names "SIMPLE-STYLE-WARNING" "SIMPLE-READER-ERROR" "SIMPLE-PARSE-ERROR"
               "SIMPLE-PROGRAM-ERROR")

(define-condition simple-style-warning (simple-warning style-warning) ())

(define-condition simple-reader-error (simple-error reader-error) ())

(define-condition simple-parse-error (simple-error parse-error) ())

(define-condition simple-program-error (simple-error program-error) ())

(defun %export-names (&rest names)
  "Exports symbols from ALEXANDRIA, which are made if there are none."
  (dolist (name names)
    (export (list (intern name :alexandria)) :alexandria)))

(defun simple-style-warning (message &rest arguments)
  "Warns of style with a text.
  Examples:
  (handler-case (alexandria:simple-style-warning \"~a\" 1) (style-warning (w) (princ-to-string w))) => \"1\""
  (warn 'simple-style-warning :format-control message :format-arguments arguments))

(defun simple-reader-error (stream message &rest arguments)
  "Signals an error of the reader with a text.
  Examples:
  (handler-case (alexandria:simple-reader-error nil \"~a\" 1) (reader-error () 'caught)) => CAUGHT"
  (error 'simple-reader-error
         :stream stream :format-control message :format-arguments arguments))

(defun simple-parse-error (message &rest arguments)
  "Signals an error of parsing with a text.
  Examples:
  (handler-case (alexandria:simple-parse-error \"~a\" 1) (parse-error (e) (princ-to-string e))) => \"1\""
  (error 'simple-parse-error :format-control message :format-arguments arguments))

(defun simple-program-error (message &rest arguments)
  "Signals an error of the program with a text.
  Examples:
  (handler-case (alexandria:simple-program-error \"~a\" 1) (program-error (e) (princ-to-string e))) => \"1\""
  (error 'simple-program-error :format-control message :format-arguments arguments))
