;;;; The macros of ALEXANDRIA.

(in-package :alexandria)

;;; For macros

(defun parse-body (body &key documentation)
  "The forms of a body, its declarations, and, if asked for, its documentation string.
  Examples:
  (alexandria:parse-body '((declare (ignore x)) 1 2)) => (1 2) ; ((DECLARE (IGNORE X))) ; NIL"
  (let ((declarations '())
        (text nil))
    (loop
      (let ((form (first body)))
        (cond ((and documentation (stringp form) (null text) (rest body))
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

;;; Choice

(defmacro switch ((object &key (test '#'eql) key) &body clauses)
  "Like `case`, with values that are evaluated and a test of choice.
  Examples:
  (alexandria:switch (\"b\" :test #'equal) (\"a\" 1) (\"b\" 2)) => 2"
  (let ((value (gensym "OBJECT")))
    `(let ((,value ,(if key `(funcall ,key ,object) object)))
       (cond ,@(loop for (wanted . forms) in clauses
                     for matches = (if (member wanted '(t otherwise))
                                       t
                                       `(funcall ,test ,value ,wanted))
                     collect `(,matches (progn ,@forms)))))))

(defmacro eswitch ((object &key (test '#'eql) key) &body clauses)
  "Like `switch`; an error if no clause matches.
  Examples:
  (alexandria:eswitch (1) (1 'one)) => ONE"
  (let ((value (gensym "OBJECT")))
    `(let ((,value ,(if key `(funcall ,key ,object) object)))
       (switch (,value :test ,test)
         ,@clauses
         (t (error "No clause of ESWITCH matches ~s." ,value))))))

;;; Property lists and hash tables

(defmacro doplist ((key value plist &optional result) &body body)
  "Evaluates the body for each entry of a property list.
  Examples:
  (let (r) (alexandria:doplist (k v '(:a 1 :b 2) r) (push (list k v) r))) => ((:B 2) (:A 1))"
  `(loop for (,key ,value) on ,plist by #'cddr
         do (tagbody ,@body)
         finally (return ,result)))

(defmacro ensure-gethash (key table &optional default)
  "The value of a key; a key that is missing gets the default.
  Examples:
  (alexandria:ensure-gethash 'a (make-hash-table) 1) => 1 ; NIL"
  (once-only (key table)
    (with-gensyms (value found)
      `(multiple-value-bind (,value ,found) (gethash ,key ,table)
         (if ,found
             (values ,value t)
             (values (setf (gethash ,key ,table) ,default) nil))))))

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

(define-modify-macro reversef () reverse
  "Reverses the sequence in a place.
  Examples:
  (let ((l (list 1 2))) (alexandria:reversef l) l) => (2 1)")

(define-modify-macro maxf (&rest numbers) max
  "Sets a place to the largest of it and numbers.
  Examples:
  (let ((n 1)) (alexandria:maxf n 3 2) n) => 3")

(define-modify-macro minf (&rest numbers) min
  "Sets a place to the smallest of it and numbers.
  Examples:
  (let ((n 5)) (alexandria:minf n 3 4) n) => 3")

(defun %remove-item (sequence item &rest options)
  "REMOVE with the sequence as the first argument."
  (apply #'remove item sequence options))

(define-modify-macro removef (item &rest options) %remove-item
  "Removes an item from the sequence in a place.
  Examples:
  (let ((l (list 1 2))) (alexandria:removef l 1) l) => (2)")

(defun %delete-item (sequence item &rest options)
  "DELETE with the sequence as the first argument."
  (apply #'delete item sequence options))

(define-modify-macro deletef (item &rest options) %delete-item
  "Deletes an item from the sequence in a place.
  Examples:
  (let ((l (list 1 2))) (alexandria:deletef l 1) l) => (2)")
