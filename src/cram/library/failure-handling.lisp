;;;; Failure handling: handlers around a body that can be restarted. The handlers run where the
;;;; failure is signalled, so that they may decline; RETRY jumps to the start of the body.

(in-package :cram-language-implementation)

(defun %check-handling-clause (clause)
  "Signals an error unless a clause of WITH-FAILURE-HANDLING is well-formed."
  (unless (and (consp clause) (listp (rest clause)) (listp (second clause)))
    (%malformed
     "~s is not a clause of WITH-FAILURE-HANDLING: (type (variable) form…) was expected, and a list of such clauses."
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
  "The function that a clause stands for. One in a program tells when it begins to handle a failure;
what a system brings along is no part of the program."
  (let* ((parameters (or (second clause) (list (gensym "FAILURE"))))
         (is-of-system (and (boundp 'system::%*loading-systems*)
                            (symbol-value 'system::%*loading-systems*)))
         (number (and (null (rest parameters))
                      (not is-of-system)
                      (plan-system:know-handler clause))))
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
;;; retries, and the form of the initial number, which RESET-COUNTER evaluates again.

(defmacro %retry-counters ()
  "The counters in whose scope this stands, innermost first: a list, not a form. WITH-RETRY-COUNTERS
redefines it locally."
  '())

(defun %counter (name operator environment)
  "The counter of a name in whose scope a form stands."
  (let* ((counters (macroexpand-1 '(%retry-counters) environment))
         (names (mapcar #'first counters)))
    (or (assoc name counters)
        (if counters
            (%malformed "~a: there is no retry counter ~s here~:[. Known ~:[are~;is~] ~{~s~^, ~}.~;~:*; did you mean ~a?~]"
                        operator name
                        (and (symbolp name)
                             (system:closest-name (string name) (mapcar #'string names)))
                        (null (rest counters)) names)
            (%malformed "~a: there is no retry counter ~s here; WITH-RETRY-COUNTERS around it makes some."
                        operator name)))))

(defun %check-retry-counters (counters)
  "Signals an error unless these are counters as WITH-RETRY-COUNTERS takes them."
  (unless (and (listp counters)
               (every (lambda (counter)
                        (and (consp counter)
                             (symbolp (first counter))
                             (consp (rest counter))
                             (null (cddr counter))))
                      counters))
    (%malformed "~s in WITH-RETRY-COUNTERS: a list of counters, ((name count)…), was expected."
                counters)))

(defmacro do-retry (counter &body body &environment environment)
  "Counts a counter of WITH-RETRY-COUNTERS down and evaluates the body, unless no retry is left.
  Examples:
  (cpl:with-retry-counters ((c 1)) (list (cpl:do-retry c :again) (cpl:do-retry c :again))) => (:AGAIN NIL)
  (cpl:with-retry-counters ((outer 1)) (cpl:with-retry-counters ((inner 1)) (cpl:do-retry outer :again))) => :AGAIN"
  (let ((left (second (%counter counter 'do-retry environment))))
    `(when (> ,left 0)
       (setq ,left (1- ,left))
       ,@body)))

(defmacro get-counter (counter &environment environment)
  "The number of retries that a counter of WITH-RETRY-COUNTERS has left.
  Examples:
  (cpl:with-retry-counters ((c 2)) (cpl:do-retry c) (cpl:get-counter c)) => 1"
  (second (%counter counter 'get-counter environment)))

(defmacro reset-counter (counter &environment environment)
  "Gives a counter of WITH-RETRY-COUNTERS all its retries back: their number is computed again.
  Examples:
  (cpl:with-retry-counters ((c 2)) (cpl:do-retry c) (cpl:reset-counter c)) => 2"
  (destructuring-bind (left count) (rest (%counter counter 'reset-counter environment))
    `(setq ,left ,count)))

(defmacro with-retry-counters (counters &body body &environment environment)
  "Binds counters, a list of (name count), for DO-RETRY, GET-COUNTER and RESET-COUNTER.
  Examples:
  (cpl:with-retry-counters ((c 1)) (list (cpl:do-retry c :again) (cpl:do-retry c :again))) => (:AGAIN NIL)"
  (%check-retry-counters counters)
  (let ((bound (mapcar (lambda (counter)
                         (list (first counter) (gensym "COUNTER") (second counter)))
                       counters)))
    `(let* ,(mapcar #'rest bound)
       (macrolet ((%retry-counters ()
                    ',(append bound (macroexpand-1 '(%retry-counters) environment))))
         ,@body))))

