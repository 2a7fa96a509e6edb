;;;; ALEXANDRIA: symbols.

(in-package :alexandria)

(defun make-keyword (name)
  "The keyword of a name.
  Examples:
  (alexandria:make-keyword 'foo) => :FOO"
  (values (intern (string name) :keyword)))

(defun ensure-symbol (name &optional (package *package*))
  "The symbol of a name in a package, and how it was found there, as by `intern`.
  Examples:
  (alexandria:ensure-symbol 'car :cl) => CAR ; :EXTERNAL"
  (intern (string name) package))

(defun format-symbol (package control &rest arguments)
  "The symbol whose name `format` makes: in a package, in the present one (T) or in none (NIL).
  Examples:
  (alexandria:format-symbol :keyword \"~a-~d\" 'arm 1) => :ARM-1"
  (let ((name (with-standard-io-syntax (apply #'format nil (string control) arguments))))
    (if package
        (values (intern name (if (eq package t) *package* package)))
        (make-symbol name))))

(defun symbolicate (&rest names)
  "The symbol whose name is made of all names.
  Examples:
  (alexandria:symbolicate 'foo '- 'bar) => FOO-BAR"
  (values (intern (apply #'concatenate 'string (mapcar #'string names)))))

(defun make-gensym (name)
  "A fresh symbol: with a name that begins so, or with this number.
  Examples:
  (symbol-package (alexandria:make-gensym 'arm)) => NIL"
  (gensym (if (integerp name) name (string name))))

(defun make-gensym-list (length &optional (name "G"))
  "A list of fresh symbols.
  Examples:
  (length (alexandria:make-gensym-list 2)) => 2"
  (let ((prefix (if (integerp name) name (string name))))
    (loop repeat length collect (gensym prefix))))
