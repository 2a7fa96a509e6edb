;;;; ALEXANDRIA: choosing what to evaluate.

(in-package :alexandria)

;;; Choice by value

(defun %switch-clauses (value test clauses)
  "The clauses of COND for those of a switch."
  (loop for (wanted . forms) in clauses
        for matches = (if (member wanted '(t otherwise))
                          t
                          `(funcall ,test ,value ,wanted))
        collect `(,matches ,@(or forms '(nil)))))

(defun %designated-function (form)
  "The form of a function that may be given by its mere name."
  (if (symbolp form) `#',form form))

(defun %switch (object test key clauses otherwise)
  "The form of a switch. `otherwise` is called with the variable that holds the value, and returns
the form for a value that no clause wants."
  (let ((value (gensym "OBJECT"))
        (test-function (gensym "TEST")))
    `(let ((,value ,(if key `(funcall ,(%designated-function key) ,object) object))
           (,test-function ,(%designated-function test)))
       (declare (ignorable ,value ,test-function))
       (cond ,@(%switch-clauses value test-function clauses)
             ,@(and otherwise `((t ,(funcall otherwise value))))))))

(defmacro switch ((object &key (test '#'eql) key) &body clauses)
  "Like `case`, with values that are evaluated and a test of choice.
  Examples:
  (alexandria:switch (\"b\" :test #'equal) (\"a\" 1) (\"b\" 2)) => 2"
  (%switch object test key clauses nil))

(defmacro eswitch ((object &key (test '#'eql) key) &body clauses)
  "Like `switch`; an error if no clause matches.
  Examples:
  (alexandria:eswitch (1) (1 'one)) => ONE"
  (%switch object test key clauses
           (lambda (value)
             `(error "No clause of ESWITCH matches ~s." ,value))))

(defmacro cswitch ((object &key (test '#'eql) key) &body clauses)
  "Like `eswitch`; the restart `continue` returns `NIL`.
  Examples:
  (handler-bind ((error #'continue)) (alexandria:cswitch (2) (1 'one))) => NIL"
  (%switch object test key clauses
           (lambda (value)
             `(cerror "Return NIL." "No clause of CSWITCH matches ~s." ,value))))

;;; Choice by shape

(defun %destructuring-clauses (value clauses)
  "The clauses of CASE for those of DESTRUCTURING-CASE."
  (loop for ((keys . lambda-list) . body) in clauses
        collect `(,keys (destructuring-bind ,lambda-list (rest ,value) ,@body))))

(defun %destructuring-case (operator key-form clauses)
  "The form of DESTRUCTURING-CASE and its relatives."
  (let ((value (gensym "KEY")))
    `(let ((,value ,key-form))
       (,operator (first ,value)
         ,@(%destructuring-clauses value clauses)))))

(defmacro destructuring-case (key-form &body clauses)
  "Chooses a clause by the first element of a list, and binds variables to the others. A clause is
  written ((key lambda-list…) body…), with a list of keys or T instead of a key.
  Examples:
  (alexandria:destructuring-case '(:move 1 2) ((:stop) 0) ((:move x y) (+ x y))) => 3"
  (%destructuring-case 'case key-form clauses))

(defmacro destructuring-ccase (key-form &body clauses)
  "Like `destructuring-case`; an error that can be corrected if no clause matches.
  Examples:
  (alexandria:destructuring-ccase '(:move 1) ((:move x) x)) => 1"
  (%destructuring-case 'ccase key-form clauses))

(defmacro destructuring-ecase (key-form &body clauses)
  "Like `destructuring-case`; an error if no clause matches.
  Examples:
  (alexandria:destructuring-ecase '(:move 1) (((:move :drive) x) x)) => 1"
  (%destructuring-case 'ecase key-form clauses))

;;; Other choices

(defmacro whichever (&rest possibilities)
  "Evaluates one of the forms, chosen at random.
  Examples:
  (alexandria:whichever 1 1) => 1"
  `(case (random ,(length possibilities))
     ,@(loop for form in possibilities
             for number from 0
             collect `(,number ,form))))

(defmacro xor (&rest forms)
  "The value of the only form that is true, and T. If none is true: NIL and T; if several are: NIL and
  NIL, and the forms after the second of them are not evaluated.
  Examples:
  (alexandria:xor nil 1 nil) => 1 ; T
  (alexandria:xor 1 2) => NIL ; NIL"
  (let ((result (gensym "RESULT"))
        (value (gensym "VALUE"))
        (block (gensym "XOR")))
    `(let ((,result nil))
       (block ,block
         ,@(loop for form in forms
                 collect `(let ((,value ,form))
                            (when ,value
                              (when ,result (return-from ,block (values nil nil)))
                              (setf ,result ,value))))
         (values ,result t)))))

(defmacro nth-value-or (n &body forms)
  "The values of the first form whose value number `n` (from 0) is true, else `NIL`.
  Examples:
  (alexandria:nth-value-or 1 (values 1 nil) (values 2 3)) => 2 ; 3"
  (let ((number (gensym "N"))
        (all (gensym "VALUES"))
        (block (gensym "OR")))
    `(let ((,number ,n))
       (block ,block
         ,@(loop for form in forms
                 collect `(let ((,all (multiple-value-list ,form)))
                            (when (nth ,number ,all)
                              (return-from ,block (values-list ,all)))))
         nil))))

(defmacro multiple-value-prog2 (first second &body forms)
  "Evaluates all forms; the values of the second.
  Examples:
  (alexandria:multiple-value-prog2 1 (values 2 3) 4) => 2 ; 3"
  `(progn ,first (multiple-value-prog1 ,second ,@forms)))

(defmacro unwind-protect-case ((&optional abort-flag) protected-form &body clauses)
  "Like `unwind-protect`, with clauses (:normal forms…), (:abort forms…) and (:always forms…) for how the
  form is left. The variable is true if it was left by a jump.
  Examples:
  (let (r) (alexandria:unwind-protect-case () 1 (:normal (push 'n r)) (:abort (push 'a r)) (:always (push 'z r))) r) => (Z N)"
  (let ((flag (or abort-flag (gensym "ABORTED"))))
    `(let ((,flag t))
       (unwind-protect
            (multiple-value-prog1 ,protected-form (setf ,flag nil))
         ,@(loop for (kind . forms) in clauses
                 collect (ecase kind
                           (:normal `(unless ,flag ,@forms))
                           (:abort `(when ,flag ,@forms))
                           (:always `(progn ,@forms))))))))

(defmacro ignore-some-conditions ((&rest conditions) &body body)
  "The body; a condition of these types makes it NIL and the condition.
  Examples:
  (null (alexandria:ignore-some-conditions (division-by-zero) (/ 1 0))) => T"
  `(handler-case (progn ,@body)
     ,@(loop for type in conditions
             collect `(,type (condition) (values nil condition)))))

;;; Definitions

(defmacro define-constant (name initial-value &key (test ''eql) documentation)
  "Defines a constant that may be defined again with a value that is the same by the test.
  Examples:
  (progn (alexandria:define-constant +some-list+ '(1) :test #'equal) (alexandria:define-constant +some-list+ '(1) :test #'equal) +some-list+) => (1)"
  `(defconstant ,name (%constant-value ',name ,initial-value ,test)
     ,@(and documentation (list documentation))))

(defun %constant-value (name new test)
  "The value that a constant has already, if the new one is the same."
  (if (boundp name)
      (let ((old (symbol-value name)))
        (if (funcall test old new)
            old
            (error "The constant ~s is ~s; ~s is not the same by ~s." name old new test)))
      new))

(defun required-argument (&optional name)
  "Signals that an argument is missing. It serves as default of a parameter that has to be given.
  Examples:
  (handler-case (alexandria:required-argument 'size) (error () 'missing)) => MISSING"
  (error "The argument~@[ ~s~] is required." name))

(defun featurep (expression)
  "Is a feature expression, as after #+, true?
  Examples:
  (alexandria:featurep '(and :common-lisp (not :sbcl))) => T"
  (etypecase expression
    (symbol (and (member expression *features*) t))
    (cons
     (let ((parts (rest expression)))
       (ecase (intern (string (first expression)) :keyword)
         (:and (every #'featurep parts))
         (:or (and (some #'featurep parts) t))
         (:not (not (featurep (first parts)))))))))
