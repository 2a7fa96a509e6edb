;;; Streams: chapter 21 of the standard.

(in-package :common-lisp)

(defmacro with-output-to-string ((variable &optional string &key element-type) &body body)
  "Evaluates the body with a stream; returns the text that was written to it.
  Examples:
  (with-output-to-string (s) (princ 1 s) (princ 2 s)) => \"12\""
  (multiple-value-bind (declarations forms) (%split-body body)
    (if string
        `(let ((,variable (prog1 (%make-fill-pointer-stream ,string) ,element-type)))
           ,@declarations
           (progn ,@forms))
        `(let ((,variable (prog1 (make-string-output-stream) ,element-type)))
           ,@declarations
           (progn ,@forms)
           (get-output-stream-string ,variable)))))

(defmacro with-input-from-string ((variable string &key start end index) &body body)
  "Evaluates the body with a stream that gives the characters of a string.
  Examples:
  (with-input-from-string (s \"abc\" :start 1) (read-char s)) => #\\b"
  (multiple-value-bind (declarations forms) (%split-body body)
    (let ((start (or start 0))
          (result `(progn ,@forms)))
      `(let ((,variable (make-string-input-stream ,string ,start ,end)))
         ,@declarations
         ,(if index
              `(multiple-value-prog1 ,result
                 (setf ,index (+ ,start (file-position ,variable))))
              result)))))

(defmacro with-open-stream ((variable stream) &body body)
  "Evaluates the body with a stream and closes it afterwards.
  Examples:
  (with-open-stream (s (make-string-input-stream \"a\")) (read-char s)) => #\\a"
  (multiple-value-bind (declarations forms) (%split-body body)
    `(let ((,variable ,stream))
       ,@declarations
       (unwind-protect (progn ,@forms)
         (when ,variable (close ,variable))))))

(defmacro with-open-file ((variable path &rest options) &body body)
  "Opens a file, evaluates the body with the stream, and closes it afterwards.
  Examples:
  (with-open-file (s \"no-such-file.txt\" :if-does-not-exist nil) s) => NIL"
  `(with-open-stream (,variable (open ,path ,@options)) ,@body))

(defun y-or-n-p (&optional control &rest arguments)
  "Asks a question until it is answered with y or n: T or NIL.
  Examples:
  (with-input-from-string (*query-io* \"y\") (let ((*standard-output* (make-broadcast-stream))) (y-or-n-p \"Go on?\"))) => T"
  (%ask control arguments "y" "n"))

(defun yes-or-no-p (&optional control &rest arguments)
  "Asks a question until it is answered with yes or no: T or NIL.
  Examples:
  (with-input-from-string (*query-io* \"no\") (let ((*standard-output* (make-broadcast-stream))) (yes-or-no-p \"Go on?\"))) => NIL"
  (%ask control arguments "yes" "no"))

(defun %ask (control arguments yes no)
  "Whether a question is answered with one word rather than the other."
  (loop
    (let ((output (if (output-stream-p *query-io*) *query-io* *standard-output*)))
      (format output "~&~@[~?~] (~a or ~a) " control arguments yes no)
      (finish-output output))
    (let ((answer (string-trim " " (read-line *query-io*))))
      (cond ((string-equal answer yes) (return t))
            ((string-equal answer no) (return nil))))))
