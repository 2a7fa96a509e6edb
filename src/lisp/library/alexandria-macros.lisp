;;;; ALEXANDRIA: bindings, places of lists, and what macros are made with.

(in-package :alexandria)

;;; For macros

(defun parse-body (body &key documentation whole)
  "The forms of a body, its declarations, and, if asked for, its documentation string. Errors show the
  whole form.
  Examples:
  (alexandria:parse-body '((declare (ignore x)) 1 2)) => (1 2) ; ((DECLARE (IGNORE X))) ; NIL"
  (let ((declarations '())
        (text nil))
    (loop
      (let ((form (first body)))
        (cond ((and documentation (stringp form) (rest body))
               (when text
                 (error "There is more than one documentation string in ~s." (or whole body)))
               (setf text form))
              ((and (consp form) (eq (first form) 'declare))
               (push form declarations))
              (t
               (return (values body (nreverse declarations) text)))))
      (pop body))))

(defmacro with-gensyms (names &body body)
  "Binds each name to a fresh symbol.
  Examples:
  (alexandria:with-gensyms (a b) (eq a b)) => NIL"
  `(let ,(loop for name in names
               for (variable prefix) = (if (consp name) name (list name name))
               collect `(,variable (gensym ,(string prefix))))
     ,@body))

(defmacro with-unique-names (names &body body)
  "Binds each name to a fresh symbol.
  Examples:
  (alexandria:with-unique-names (a b) (eq a b)) => NIL"
  `(with-gensyms ,names ,@body))

(defmacro once-only (variables &body body)
  "In a macro: lets the expansion evaluate the forms in some variables once.
  Examples:
  (macrolet ((twice (x) (alexandria:once-only (x) `(list ,x ,x)))) (let ((n 0)) (twice (incf n)))) => (1 1)"
  (let ((holders (loop for variable in variables
                       for (name form) = (if (consp variable) variable (list variable variable))
                       collect (list (gensym "ONCE") name form))))
    `(let ,(loop for (holder) in holders
                 collect `(,holder (gensym)))
       (list 'let
             (list ,@(loop for (holder nil form) in holders
                           collect `(list ,holder ,form)))
             (let ,(loop for (holder name) in holders
                         collect `(,name ,holder))
               ,@body)))))

;;; Bindings

(defun %binding-list (bindings)
  "The bindings as a list, of which there may be just one."
  (if (and bindings (symbolp (first bindings)))
      (list bindings)
      bindings))

(defmacro if-let (bindings then &optional else)
  "Binds variables; evaluates `then` if all are true, else `else`.
  Examples:
  (alexandria:if-let (x 1) (list x) 'none) => (1)"
  (let ((bindings (%binding-list bindings)))
    `(let ,bindings
       (if (and ,@(mapcar #'first bindings))
           ,then
           ,else))))

(defmacro when-let (bindings &body body)
  "Binds variables; evaluates the body if all are true.
  Examples:
  (alexandria:when-let ((x 1) (y 2)) (list x y)) => (1 2)"
  (let ((bindings (%binding-list bindings)))
    (multiple-value-bind (forms declarations) (parse-body body)
      `(let ,bindings
         ,@declarations
         (when (and ,@(mapcar #'first bindings))
           ,@forms)))))

(defmacro when-let* (bindings &body body)
  "Binds variables one after the other; evaluates the body if all are true.
  Examples:
  (alexandria:when-let* ((x 1) (y (list x))) y) => (1)"
  (reduce (lambda (binding form)
            `(let (,binding)
               (when ,(first binding) ,form)))
          (%binding-list bindings)
          :from-end t
          :initial-value `(progn ,@body)))

;;; Places

(define-modify-macro appendf (&rest lists) append
  "Appends lists to a place.
  Examples:
  (let ((l (list 1))) (alexandria:appendf l '(2)) l) => (1 2)")

(define-modify-macro nconcf (&rest lists) nconc
  "Joins lists to a place.
  Examples:
  (let ((l (list 1))) (alexandria:nconcf l (list 2)) l) => (1 2)")

(define-modify-macro unionf (list &rest options) union
  "Sets a place to the union with a list.
  Examples:
  (let ((l (list 1))) (alexandria:unionf l '(1)) l) => (1)")

(define-modify-macro nunionf (list &rest options) nunion
  "Like `unionf`, but may change both lists.
  Examples:
  (let ((l (list 1))) (alexandria:nunionf l (list 1)) l) => (1)")

(define-modify-macro nreversef () nreverse
  "Reverses the sequence in a place, which may be changed.
  Examples:
  (let ((l (list 1 2))) (alexandria:nreversef l) l) => (2 1)")

(define-modify-macro reversef () reverse
  "Reverses the sequence in a place.
  Examples:
  (let ((l (list 1 2))) (alexandria:reversef l) l) => (2 1)")

;;; Nested calls in the order in which they happen

(defmacro alexandria-2:line-up-first (&rest forms)
  "Puts each form into the next one as its first argument.
  Examples:
  (alexandria-2:line-up-first 5 (- 2) list) => (3)"
  (%line-up forms (lambda (form call) (list* (first call) form (rest call)))))

(defmacro alexandria-2:line-up-last (&rest forms)
  "Puts each form into the next one as its last argument.
  Examples:
  (alexandria-2:line-up-last 5 (- 2) list) => (-3)"
  (%line-up forms (lambda (form call) (append call (list form)))))

(defun %line-up (forms insert)
  "Inserts each form into the next. A symbol is a call without arguments."
  (when forms
    (reduce (lambda (form call) (funcall insert form (ensure-list call))) forms)))
