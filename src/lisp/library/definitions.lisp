;;; Definitions: everything but DEFUN, DEFMACRO, DEFVAR and DEFPARAMETER.

(in-package :common-lisp)

(defun %name (name what)
  "The name, unless it is no symbol; then the error says what it should name."
  (if (and name (symbolp name))
      name
      (%malformed "~S is not a symbol: the name of ~A was expected." name what)))

(defun %malformed (control &rest arguments)
  "Signals that a form is not written as its macro wants it."
  (error 'simple-program-error :format-control control :format-arguments arguments))

(defmacro defconstant (name value &optional documentation)
  "Defines a constant.
  Examples:
  (progn (defconstant +answer+ 42) +answer+) => 42"
  (let ((definition `(define-constant ',(%name name "a constant") ,value)))
    (if documentation
        `(prog1 ,definition
           (setf (documentation ',name 'variable) ,documentation))
        definition)))

(defmacro define-compiler-macro (name lambda-list &body body)
  "Has no effect: there are no compiler macros.
  Examples:
  (define-compiler-macro nothing (x) x) => NOTHING"
  (declare (ignore lambda-list body))
  `',(%name name "a function"))

(defmacro define-symbol-macro (name expansion)
  "Lets a symbol stand for a form everywhere.
  Examples:
  (progn (define-symbol-macro my-pi 3) my-pi) => 3"
  `(set-symbol-macro ',(%name name "a symbol macro") ',expansion))

(defmacro declaim (&rest specifiers)
  "Global declarations; SPECIAL has an effect.
  Examples:
  (progn (declaim (special *demo-special*)) 1) => 1"
  `(progn ,@(mapcar (lambda (specifier) `(proclaim ',specifier)) specifiers)))

(defmacro defsetf (access-function &rest how)
  "Defines how SETF of a form is carried out.
  Examples:
  (progn (defun set-head (l v) (rplaca l v) v) (defsetf head set-head) (let ((l (list 1))) (setf (head l) 2) l)) => (2)"
  (%name access-function "an accessor")
  (if (and (car how) (symbolp (car how)))
      `(define-setf-update ',access-function ',(car how))
      (destructuring-bind (lambda-list stores &body body) how
        (let ((list (gensym "STORES")))
          `(define-setf-long ',access-function
             (lambda (,list ,@lambda-list)
               (destructuring-bind ,stores ,list ,@body))
             ,(length stores))))))

(defmacro define-modify-macro (name lambda-list function &optional documentation)
  "Defines a macro like INCF.
  Examples:
  (progn (define-modify-macro appendf (&rest l) append) (let ((x '(1))) (appendf x '(2)) x)) => (1 2)"
  (declare (ignore documentation))
  (let ((place (gensym "PLACE"))
        (rest (cadr (member '&rest lambda-list)))
        (positional (ldiff lambda-list (member '&rest lambda-list))))
    `(defmacro ,(%name name "a macro") (,place ,@lambda-list &environment environment)
       (modify-place ,place ',function
                     (list* ,@(mapcar (lambda (parameter)
                                        (if (consp parameter) (car parameter) parameter))
                                      (remove '&optional positional))
                            ,rest)
                     environment))))
