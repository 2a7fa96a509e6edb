;;; The printer: chapter 22 of the standard.

(in-package :common-lisp)

(defmacro print-unreadable-object ((object stream &key type identity) &body body)
  "Writes #<…> around what the body writes.
  Examples:
  (with-output-to-string (s) (print-unreadable-object (1 s) (princ \"one\" s))) => \"#<one>\""
  `(write-unreadable ,object ,stream ,type ,identity
                     ,(and body `#'(lambda () ,@body))))

(defmacro with-standard-io-syntax (&body body)
  "Runs the body with the standard values of the variables of printer and reader.
  Examples:
  (let ((*print-base* 2)) (with-standard-io-syntax (prin1-to-string 5))) => \"5\""
  `(let ((*print-array* t)
         (*print-base* 10)
         (*print-case* :upcase)
         (*print-circle* nil)
         (*print-escape* t)
         (*print-gensym* t)
         (*print-length* nil)
         (*print-level* nil)
         (*print-lines* nil)
         (*print-miser-width* nil)
         (*print-pprint-dispatch* (copy-pprint-dispatch nil))
         (*print-pretty* nil)
         (*print-radix* nil)
         (*print-readably* t)
         (*print-right-margin* nil)
         (*read-base* 10)
         (*read-default-float-format* 'single-float)
         (*read-eval* t)
         (*read-suppress* nil)
         (*readtable* (copy-readtable nil))
         (*package* (find-package "COMMON-LISP-USER")))
     ,@body))

(defun %iterate (stream function arguments most once sublists)
  "What FORMAT's iteration does whose body is a function: calls it with the arguments, then with those that it leaves, or with each sublist."
  (loop with count = 0
        while (and (or arguments once) (or (null most) (< count most)))
        do (setq once nil
                 count (1+ count))
           (let ((rest (if sublists
                           (progn (apply function stream (car arguments)) (cdr arguments))
                           (apply function stream arguments))))
             (if (and rest (null most) (>= (length rest) (length arguments)))
                 (error "The iteration uses no argument, so it would never end."))
             (setq arguments rest))))
