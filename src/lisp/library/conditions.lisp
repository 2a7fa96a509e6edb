;;; Conditions: chapter 9 of the standard. SIGNAL, ERROR, HANDLER-BIND and the restarts
;;; themselves are written in Rust.

(in-package :common-lisp)

(defmacro handler-case (form &rest clauses)
  "The form; a condition of a clause's type unwinds and evaluates the clause.
  Examples:
  (handler-case (error \"x\") (error (e) (princ-to-string e))) => \"x\"
  (handler-case 1 (:no-error (x) (list x))) => (1)"
  (mapc #'%check-handler-clause clauses)
  (let ((no-error (assoc :no-error clauses)))
    (if no-error
        (%handler-case-no-error form (cdr no-error) (remove no-error clauses))
        (if clauses
            (%handler-case form clauses)
            form))))

(defun %check-handler-clause (clause)
  "Signals an error unless a clause of HANDLER-CASE is well-formed."
  (unless (and (consp clause)
               (consp (cdr clause))
               (listp (second clause))
               (or (eq (first clause) :no-error) (null (cdr (second clause)))))
    (%malformed "~s is not a clause of HANDLER-CASE: (type ([variable]) form…) was expected~@[; ~a~]."
                clause
                (and (not (consp clause)) "a pair of parentheses is missing around it"))))

(defun %handler-case-no-error (form function clauses)
  "The form of HANDLER-CASE with a clause for the values of its form."
  (let ((error-return (gensym "ERROR-RETURN"))
        (normal-return (gensym "NORMAL-RETURN")))
    `(block ,error-return
       (multiple-value-call (lambda ,@function)
         (block ,normal-return
           (return-from ,error-return
             (handler-case (return-from ,normal-return ,form) ,@clauses)))))))

(defun %handler-case (form clauses)
  "The form of HANDLER-CASE. Each clause is a tag: its handler keeps the condition in a
  variable and jumps there."
  (let ((block (gensym "BLOCK"))
        (condition (gensym "CONDITION"))
        (handlers '())
        (statements '()))
    (dolist (clause clauses)
      (let ((tag (gensym "CLAUSE"))
            (parameter (gensym "C"))
            (variable (car (cadr clause)))
            (body (cddr clause)))
        (push `(,(car clause) (lambda (,parameter) (setq ,condition ,parameter) (go ,tag)))
              handlers)
        (push tag statements)
        (push `(return-from ,block
                 ,(if variable
                      `(let ((,variable ,condition)) ,@body)
                      `(locally ,@body)))
              statements)))
    `(block ,block
       (let ((,condition nil))
         (tagbody
            (return-from ,block (handler-bind ,(nreverse handlers) ,form))
            ,@(nreverse statements))))))

(defun %call-with-handlers (function &rest handlers)
  "Calls a function while handlers are there, given as types and functions: what HANDLER-BIND means."
  (handler-bind ((condition (lambda (condition)
                              (loop for (type handler) on handlers by #'cddr
                                    when (typep condition type)
                                      do (funcall handler condition)))))
    (funcall function)))

(defun %call-with-restarts (restarts function)
  "Calls a function while restarts are there."
  (with-restarts restarts (funcall function)))

(defmacro ignore-errors (&body body)
  "The body; an error makes it NIL and the condition.
  Examples:
  (null (ignore-errors (error \"x\"))) => T"
  (let ((condition (gensym "CONDITION")))
    `(handler-case ,(%progn body)
       (error (,condition) (values nil ,condition)))))

(defmacro restart-case (form &rest clauses &environment environment)
  "The form, with restarts that unwind and evaluate their clause. If the form signals a
  condition, they belong to that condition.
  Examples:
  (restart-case (invoke-restart 'go-on 1) (go-on (x) (list x))) => (1)"
  (mapc #'%check-restart-clause clauses)
  (let ((block (gensym "BLOCK"))
        (arguments (gensym "ARGUMENTS"))
        (restarts '())
        (statements '()))
    (dolist (clause clauses)
      (let* ((tag (gensym "RESTART"))
             (parameter (gensym "ARGS"))
             (body (%after-options (cddr clause) '(:report :interactive :test)))
             (options (ldiff (cddr clause) body)))
        (push `(make-restart ',(car clause)
                             (lambda (&rest ,parameter)
                               (setq ,arguments ,parameter)
                               (go ,tag))
                             ,(%report (getf options :report))
                             ,(%function-form (getf options :interactive))
                             ,(%function-form (getf options :test)))
              restarts)
        (push tag statements)
        (push `(return-from ,block
                 (apply #'(lambda ,(cadr clause) ,@body) ,arguments))
              statements)))
    `(block ,block
       (let ((,arguments nil))
         (tagbody
            (return-from ,block ,(%with-restarts (macroexpand form environment)
                                                   (nreverse restarts)))
            ,@(nreverse statements))))))

(defun %check-restart-clause (clause)
  "Signals an error unless a clause of RESTART-CASE is well-formed."
  (unless (and (consp clause)
               (symbolp (first clause))
               (consp (cdr clause))
               (listp (second clause)))
    (%malformed "~s is not a clause of RESTART-CASE: (name (parameter…) form…) was expected~@[; ~a~]."
                clause
                (and (not (consp clause)) "a pair of parentheses is missing around it"))))

(defun %with-restarts (form restarts)
  "The form of a form, whose macro is expanded, with restarts. If it is a call of a function that
  signals, they belong to its condition."
  (let ((variable (gensym "RESTARTS"))
        (class (and (consp form)
                    (cdr (assoc (car form) '((signal . simple-condition)
                                             (error . simple-error)
                                             (cerror . simple-error)
                                             (warn . simple-warning)))))))
    (if class
        (let* ((before (if (eq (car form) 'cerror) (list (second form)) '()))
               (arguments (nthcdr (length before) (cdr form)))
               (continue-arguments (and before (cdr arguments))))
          `(let ((,variable (list ,@restarts)))
             (with-restarts ,variable
               ,(at-place-of form
                             `(,(car form) ,@before
                               (associate-restarts
                                (%condition ,(car arguments) (list ,@(cdr arguments)) ',class)
                                ,variable)
                               ,@continue-arguments)))))
        `(with-restarts (list ,@restarts) ,form))))

(defun %after-options (list names)
  "What stands in a list after the keywords of these names and their values."
  (if (member (car list) names)
      (%after-options (cddr list) names)
      list))

(defun %function-form (function)
  "The form of a function that a clause names, if it names one."
  (and function `(function ,function)))

(defun %report (report)
  "The form of the report of a restart: a string, or what a function writes."
  (if (stringp report) report (%function-form report)))

(defmacro restart-bind (bindings &body body)
  "Restarts that run on top of whoever invokes them.
  Examples:
  (restart-bind ((three (lambda () 3))) (invoke-restart 'three)) => 3"
  `(with-restarts
       (list ,@(mapcar (lambda (binding)
                         (destructuring-bind
                             (name function &key report-function interactive-function
                                              test-function)
                             binding
                           `(make-restart ',name ,function ,report-function
                                          ,interactive-function ,test-function)))
                       bindings))
     ,@body))

(defmacro with-simple-restart ((name format-control &rest format-arguments) &body body)
  "The body, with a restart that leaves it: NIL and T.
  Examples:
  (with-simple-restart (skip \"Skip it.\") (invoke-restart 'skip)) => NIL ; T"
  `(restart-case ,(%progn body)
     (,name () :report (lambda (stream) (format stream ,format-control ,@format-arguments))
       (values nil t))))

(defmacro with-condition-restarts (condition restarts &body body)
  "The body; meanwhile the restarts belong to the condition, and apply to no other.
  Examples:
  (restart-case (let ((c (make-condition 'error)) (d (make-condition 'error))) (with-condition-restarts c (list (find-restart 'r)) (find-restart 'r d))) (r () 1)) => NIL"
  (let ((object (gensym "CONDITION"))
        (list (gensym "RESTARTS")))
    `(let ((,object ,condition)
           (,list ,restarts))
       (associate-restarts ,object ,list)
       (unwind-protect (progn ,@body)
         (dissociate-restarts ,object ,list)))))

(defun %condition (datum arguments class)
  "The condition that the arguments of ERROR and its kin designate; if they are a format
  control and its arguments, it is of the class."
  (if (typep datum 'condition)
      datum
      (if (or (stringp datum) (functionp datum))
          (make-condition class :format-control datum :format-arguments arguments)
          (if (or (symbolp datum) (typep datum 'class))
              (apply #'make-condition datum arguments)
              (error 'type-error :datum datum :expected-type 'condition)))))

(defun cerror (continue-control datum &rest arguments)
  "Like ERROR, with a restart CONTINUE that goes on.
  Examples:
  (handler-bind ((error #'continue)) (cerror \"Go on.\" \"Stop.\")) => NIL"
  ;; Arguments beside a condition are those of the text of the restart.
  (restart-case (apply #'error datum (if (typep datum 'condition) '() arguments))
    (continue ()
      :report (lambda (stream) (apply #'format stream continue-control arguments))
      nil)))

(defun warn (datum &rest arguments)
  "Signals a warning and prints it unless a handler muffles it.
  Examples:
  (handler-bind ((warning #'muffle-warning)) (warn \"x\")) => NIL"
  (let ((condition (%condition datum arguments 'simple-warning)))
    (if (and arguments (typep datum 'condition))
        (error 'type-error :datum arguments :expected-type 'null))
    (if (not (typep condition 'warning))
        (error 'type-error :datum condition :expected-type 'warning))
    (restart-case
        (progn
          (signal condition)
          (let ((kind (if (typep condition 'style-warning) "STYLE-WARNING" "WARNING"))
                (text (princ-to-string condition)))
            (fresh-line *error-output*)
            (format *error-output* "~A: ~A~%" kind text)
            nil))
      (muffle-warning () :report "Skip warning." nil))))

(defmacro assert (test &optional places datum &rest arguments)
  "An error unless the test is true. Its restart CONTINUE evaluates the test again; change the places first.
  Examples:
  (assert (= 1 1)) => NIL
  (let ((x 1)) (handler-bind ((error (lambda (c) (setq x 2) (continue c)))) (assert (= x 2) (x))) x) => 2"
  (declare (ignore places))
  (let ((again (gensym "AGAIN"))
        (done (gensym "DONE")))
    `(tagbody
        ,again
        (if ,test (go ,done))
        (with-simple-restart (continue "Retry the assertion.")
          (error ,@(if datum
                       (cons datum arguments)
                       `("The assertion ~S failed." ',test))))
        (go ,again)
        ,done)))

(defmacro check-type (place type &optional string)
  "An error unless the place's value has the type; its restart STORE-VALUE stores another one.
  Examples:
  (let ((x 1)) (check-type x integer)) => NIL
  (let ((x 1)) (handler-bind ((type-error (lambda (c) (store-value \"a\" c)))) (check-type x string) x)) => \"a\""
  (let ((value (gensym "VALUE"))
        (again (gensym "AGAIN")))
    `(prog (,value)
        ,again
        (setq ,value ,place)
        (if (typep ,value ',type) (return nil))
        (setf ,place
              (%other-value ',place (lambda ()
                                      (check-type-failed ,value ',place ',type ,string))))
        (go ,again))))

(defun %other-value (place fail)
  "The value that somebody chooses to store in a place, after the error that a function signals."
  (restart-case (funcall fail)
    (store-value (value)
      :report (lambda (stream) (format stream "Supply a new value for ~S." place))
      value)))

(defmacro ccase (place &rest clauses &environment environment)
  "Like ECASE, with a restart STORE-VALUE that stores another value in the place and tries again.
  Examples:
  (let ((x 3)) (handler-bind ((type-error (lambda (c) (store-value 1 c)))) (ccase x (1 :one) (2 :two)))) => :ONE"
  (%correctable-case 'case place (mapcar #'%with-key-list clauses) 'ccase
                     (mapcan (lambda (clause) (copy-list (car (%with-key-list clause))))
                             clauses)
                     environment))

(defmacro ctypecase (place &rest clauses &environment environment)
  "Like ETYPECASE, with a restart STORE-VALUE that stores another value in the place and tries
  again.
  Examples:
  (let ((x 1)) (ctypecase x (string :string) (integer :integer))) => :INTEGER"
  (%correctable-case 'typecase place clauses 'ctypecase (mapcar #'car clauses) environment))

(defun %with-key-list (clause)
  "A clause of CASE with its keys as a list."
  (cons (if (listp (car clause)) (car clause) (list (car clause)))
        (cdr clause)))

(defun %correctable-case (operator place clauses name wanted environment)
  "The form of CCASE and CTYPECASE. In a constant no other value can be stored."
  (let ((value (gensym "VALUE"))
        (again (gensym "AGAIN"))
        (block (gensym "BLOCK")))
    (if (constantp (macroexpand place environment))
        (return-from %correctable-case
          `(let ((,value ,place))
             (,operator ,value
               ,@clauses
               (t (case-failed ,value ',name ',wanted))))))
    `(block ,block
       (let (,value)
         (tagbody
            ,again
            (setq ,value ,place)
            (return-from ,block
              (,operator ,value
                ,@clauses
                (t (setf ,place
                         (%other-value ',place (lambda ()
                                                 (case-failed ,value ',name ',wanted))))
                   (go ,again)))))))))

(defun abort (&optional condition)
  "Invokes the restart ABORT.
  Examples:
  (restart-case (abort) (abort () 1)) => 1"
  (invoke-restart (or (find-restart 'abort condition) 'abort)))

(defun muffle-warning (&optional condition)
  "Invokes the restart MUFFLE-WARNING.
  Examples:
  (handler-bind ((warning #'muffle-warning)) (warn \"x\")) => NIL"
  (invoke-restart (or (find-restart 'muffle-warning condition) 'muffle-warning)))

(defun continue (&optional condition)
  "Invokes the restart CONTINUE, if there is one.
  Examples:
  (continue) => NIL"
  (%invoke-if-active 'continue condition))

(defun use-value (value &optional condition)
  "Invokes the restart USE-VALUE, if there is one.
  Examples:
  (restart-case (use-value 1) (use-value (v) v)) => 1"
  (%invoke-if-active 'use-value condition value))

(defun store-value (value &optional condition)
  "Invokes the restart STORE-VALUE, if there is one.
  Examples:
  (restart-case (store-value 1) (store-value (v) v)) => 1"
  (%invoke-if-active 'store-value condition value))

(defun %invoke-if-active (name condition &rest arguments)
  "Invokes the innermost restart of a name that applies to the condition, if there is one."
  (let ((restart (find-restart name condition)))
    (and restart (apply #'invoke-restart restart arguments))))

;; A report may print its condition.
(defun %write-message (condition stream)
  "Writes what a condition says, as far as its report can be written: a part of its printed form."
  (ignore-errors
   (let ((%*in-report* t))
     (princ condition stream))))

(defun %call-debugger-hook (condition)
  "What happens instead of stopping at a condition that nobody handles while there is a *DEBUGGER-HOOK*: that
  function is called. If it returns, the condition stops the program after all."
  (let ((hook *debugger-hook*)
        (*debugger-hook* nil))
    (funcall hook condition hook)
    (invoke-debugger condition)))
