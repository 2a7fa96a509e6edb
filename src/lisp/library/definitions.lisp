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
  (let ((definition `(%define-constant ',(%name name "a constant") ,value)))
    (if documentation
        `(prog1 ,definition
           (setf (documentation ',name 'variable) ,documentation))
        definition)))

(defun %define-constant (name value)
  "Defines a constant, unless it has another value already and nobody wants to give it a new one."
  (when (and (constantp name)
             (boundp name)
             (not (equal (symbol-value name) value)))
    (cerror "Give it the new value; code that has been compiled keeps the old one."
            'system:simple-program-error
            :name name
            :format-control "The constant ~s has the value ~s; DEFCONSTANT would give it ~s."
            :format-arguments (list name (symbol-value name) value)))
  (define-constant name value))

(defmacro define-compiler-macro (name lambda-list &body body)
  "Keeps a compiler macro for COMPILER-MACRO-FUNCTION. It is never used: calls are evaluated as they are.
  Examples:
  (progn (define-compiler-macro nothing (x) (list 'quote x)) (funcall (compiler-macro-function 'nothing) '(nothing 1) nil)) => '1"
  (let ((form (gensym "FORM"))
        (environment (gensym "ENVIRONMENT"))
        (bindings '())
        (parameters '()))
    (check-type name (or symbol (cons (eql setf) (cons symbol null))) "the name of a function")
    (when (eq (car lambda-list) '&whole)
      (push (list (second lambda-list) form) bindings)
      (setq lambda-list (cddr lambda-list)))
    (loop while (consp lambda-list)
          do (let ((parameter (pop lambda-list)))
               (if (eq parameter '&environment)
                   (push (list (pop lambda-list) environment) bindings)
                   (push parameter parameters))))
    (multiple-value-bind (declarations forms) (%body-parts body)
     `(progn
       (setf (compiler-macro-function ',name)
             #'(lambda (,form &optional ,environment)
                 (declare (ignorable ,environment))
                 (let ,bindings
                   (destructuring-bind ,(revappend parameters lambda-list)
                       (if (eq (car ,form) 'funcall) (cddr ,form) (cdr ,form))
                     ,@declarations
                     (block ,(if (consp name) (second name) name) ,@forms)))))
       ',name))))

(defun compiler-macro-function (name &optional environment)
  "The function of a compiler macro, or NIL. What it would make faster is evaluated as it is.
  Examples:
  (compiler-macro-function 'car) => NIL"
  (declare (ignore environment))
  (check-type name (or symbol (cons (eql setf) (cons symbol null))))
  (get (if (consp name) (second name) name) (if (consp name) 'setf-compiler-macro 'compiler-macro)))

(defun (setf compiler-macro-function) (function name &optional environment)
  "Keeps the function of a compiler macro.
  Examples:
  (progn (setf (compiler-macro-function 'kept) #'list) (funcall (compiler-macro-function 'kept) 1 2)) => (1 2)"
  (declare (ignore environment))
  (setf (get (if (consp name) (second name) name) (if (consp name) 'setf-compiler-macro 'compiler-macro))
        function))

(defun (setf macro-function) (function name &optional environment)
  "Makes a function of a form and an environment the macro of a name.
  Examples:
  (progn (setf (macro-function 'twice) (lambda (form environment) (declare (ignore environment)) (list 'list (second form) (second form)))) (twice 3)) => (3 3)"
  (when environment
    (error "A local macro cannot be set; the macro of ~s everywhere is set without an environment." name))
  (define-macro (%name name "a macro") function nil nil)
  function)

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
          (multiple-value-bind (declarations forms) (%body-parts body)
            `(define-setf-long ',access-function
               (lambda (,list ,@lambda-list)
                 (destructuring-bind ,stores ,list
                   ,@declarations
                   (block ,access-function ,@forms)))
               ,(length stores)))))))

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
