;;;; Failure handling: handlers around a body that can be restarted. The handlers run where the
;;;; failure is signalled, so that they may decline; RETRY jumps to the start of the body.

(in-package :cram-language-implementation)

(defun %check-handling-clause (clause)
  "Signals an error unless a clause of WITH-FAILURE-HANDLING is well-formed."
  (unless (and (consp clause) (listp (rest clause)) (listp (second clause)))
    (%malformed
     "~s is not a clause of WITH-FAILURE-HANDLING: (type (variable) form…) was expected."
     clause)))

(defun %unwrapping-handler (handlers)
  "A handler of errors in envelopes, which hands what is inside to the first of some handlers
that is for it."
  (let ((envelope (gensym "ENVELOPE"))
        (inner (gensym "INNER")))
    `(lambda (,envelope)
       (let ((,inner (envelop-error ,envelope)))
         (typecase ,inner
           ,@(mapcar (lambda (handler)
                       `(,(first handler) (funcall ,(second handler) ,inner)))
                     handlers))))))

(defun %handling-function (clause)
  "The function that a clause stands for. One in a program tells when it begins to handle a failure."
  (let* ((parameters (or (second clause) (list (gensym "FAILURE"))))
         (number (and (null (rest parameters)) (plan-system:know-handler clause))))
    (if number
        `(lambda ,parameters
           (plan-system:note-handled ,number ,(first parameters))
           (locally ,@(cddr clause)))
        `(lambda ,parameters ,@(cddr clause)))))

(defun %with-handlers (clauses body)
  "The body inside handlers. Those of failures of plans get just these; others also what is
in an envelope, so that they have names."
  (let ((handlers '())
        (functions '())
        (named '()))
    (dolist (clause clauses)
      (let ((type (first clause))
            (function (%handling-function clause)))
        (if (subtypep type 'plan-failure)
            (push (list type function) handlers)
            (let ((name (gensym "HANDLER")))
              (push (list name function) functions)
              (push (list type name) named)
              (push (list type name) handlers)))))
    (if named
        `(let ,(reverse functions)
           (handler-bind ((common-lisp-error-envelope ,(%unwrapping-handler (reverse named)))
                          ,@(reverse handlers))
             ,@body))
        `(handler-bind ,(reverse handlers) ,@body))))

(defmacro with-failure-handling ((&rest clauses) &body body)
  "Runs the body; a clause (TYPE (VARIABLE) FORM…) handles failures and errors of a type: it
  may leave with (RETURN value), begin the body again with (RETRY), or decline by coming to
  its end.
  Examples:
  (let ((n 0)) (cpl:with-failure-handling ((cpl:plan-failure (e) (cpl:retry))) (incf n) (when (< n 3) (cpl:fail)) n)) => 3
  (cpl:with-failure-handling ((cpl:plan-failure (e) (return :given-up))) (cpl:fail)) => :GIVEN-UP"
  (mapc #'%check-handling-clause clauses)
  (let* ((again (gensym "AGAIN"))
         (jump `(go ,again))
         (attempt `(return-from nil ,(%with-handlers clauses body))))
    (cond ((null clauses)
           `(block nil ,@body))
          ((plan-system:mentions-function 'retry (cons clauses body))
           `(block nil
              (tagbody ,again (flet ((retry () ,jump)) ,attempt))))
          (t
           `(block nil
              (tagbody ,again (macrolet ((retry () ',jump)) ,attempt)))))))

;;; Retry counters: a counter is a list of its name, the variable with the remaining number of
;;; retries, and the variable with the initial number.

(defun %expand-do-retry (counters name body)
  "The expansion of DO-RETRY."
  (let ((left (second (assoc name counters))))
    `(when (> ,left 0)
       (setq ,left (1- ,left))
       ,@body)))

(defun %expand-reset-counter (counters name)
  "The expansion of RESET-COUNTER."
  (destructuring-bind (&optional left start) (rest (assoc name counters))
    (unless left
      (%malformed "There is no retry counter ~s here." name))
    `(setq ,left ,start)))

(defmacro with-retry-counters (counters &body body)
  "Binds counters, a list of (name count), for DO-RETRY, GET-COUNTER and RESET-COUNTER.
  Examples:
  (cpl:with-retry-counters ((c 1)) (list (cpl:do-retry c :again) (cpl:do-retry c :again))) => (:AGAIN NIL)"
  (let ((bound (mapcar (lambda (counter)
                         (list (first counter) (gensym "COUNTER") (gensym "START")))
                       counters)))
    `(let* ,(mapcan (lambda (counter variables)
                      `((,(third variables) ,(second counter))
                        (,(second variables) ,(third variables))))
                    counters bound)
       (macrolet ((do-retry (name &body body) (%expand-do-retry ',bound name body))
                  (get-counter (name) (second (assoc name ',bound)))
                  (reset-counter (name) (%expand-reset-counter ',bound name)))
         ,@body))))
