;;;; Forms that run others: in order, in parallel, until one succeeds.

(in-package :cram-language-implementation)

(defun %thunk (form)
  "A function of no arguments that evaluates a form, as a form."
  `(lambda () ,form))

(defmacro top-level (&body body)
  "Runs a plan and returns its values.
  Examples:
  (cpl:top-level 1 2) => 2"
  `(plan-system:start nil (lambda () (block nil ,@body))))

(defmacro named-top-level ((&key name) &body body)
  "Runs a plan that keeps its task tree under a name.
  Examples:
  (cpl-impl::named-top-level (:name x) 1) => 1"
  `(plan-system:start ',name (lambda () (block nil ,@body))))

(defmacro seq (&body forms)
  "Runs forms in order.
  Examples:
  (cpl:seq 1 2) => 2"
  `(progn ,@forms))

(defmacro par (&body forms)
  "Runs forms in parallel until all have succeeded; the values of the first. Fails as soon
  as one fails.
  Examples:
  (cpl:top-level (cpl:par (cpl:seq (cpl:sleep 1) :slow) :fast)) => :SLOW"
  `(plan-system:par ,@(mapcar #'%thunk forms)))

(defmacro pursue (&body forms)
  "Runs forms in parallel until one succeeds; its values. Fails as soon as one fails.
  Examples:
  (cpl:top-level (cpl:pursue (cpl:seq (cpl:sleep 1) :slow) :fast)) => :FAST"
  `(plan-system:pursue ,@(mapcar #'%thunk forms)))

(defmacro try-all (&body forms)
  "Runs forms in parallel until one succeeds; its values. Fails when all have failed.
  Examples:
  (cpl:top-level (cpl:try-all (cpl:fail) :ok)) => :OK"
  `(plan-system:try-all ,@(mapcar #'%thunk forms)))

(defun %attempt (form failures)
  "A form that leaves the block NIL with the values of another, or notes its failure."
  (let ((failure (gensym "FAILURE")))
    `(handler-case (return-from nil ,form)
       (plan-failure (,failure)
         (setq ,failures (cons ,failure ,failures))))))

(defmacro try-in-order (&body forms)
  "Runs forms one after the other until one succeeds; its values. Fails when all have
  failed.
  Examples:
  (cpl:top-level (cpl:try-in-order (cpl:fail) 2 3)) => 2"
  (let ((failures (gensym "FAILURES")))
    `(progn
       (plan-system:check-plan "TRY-IN-ORDER")
       (block nil
         (let ((,failures nil))
           ,@(mapcar (lambda (form) (%attempt form failures)) forms)
           (plan-system:all-failed (reverse ,failures)))))))

(defmacro try-each-in-order ((variable list) &body body)
  "Runs the body for one element after the other until it succeeds.
  Examples:
  (cpl:top-level (cpl:try-each-in-order (x '(1 2)) (if (oddp x) (cpl:fail) x))) => 2"
  (let ((failures (gensym "FAILURES")))
    `(progn
       (plan-system:check-plan "TRY-EACH-IN-ORDER")
       (let ((,failures nil))
         (dolist (,variable ,list (plan-system:all-failed (reverse ,failures)))
           ,(%attempt `(progn ,@body) failures))))))

(defmacro par-loop ((variable list) &body body)
  "Runs the body for all elements in parallel; the values for the first.
  Examples:
  (cpl:top-level (cpl:par-loop (x '(1 2 3)) (* 10 x))) => 10"
  `(plan-system:par-loop (lambda (,variable) ,@body) ,list))

(defun %order (order)
  "A form for the tasks of an order, the earlier one first."
  (unless (and (consp order)
               (eq (first order) :order)
               (eql (list-length order) 3))
    (error "Malformed ordering constraint."))
  `(list ,@(rest order)))

(defmacro partial-order ((&body forms) &body orders)
  "Runs forms in parallel, tagged ones as the orders (:ORDER earlier later) say.
  Examples:
  (cpl:top-level (cpl:with-tags (cpl:partial-order ((:tag b :b) (:tag a :a)) (:order a b)))) => :B"
  `(progn
     (plan-system:check-plan "PARTIAL-ORDER")
     (plan-system:partial-order (list ,@(mapcar #'%order orders))
                                ,@(mapcar #'%thunk forms))))

(defun mapcar-clean (function list)
  "Like MAPCAR, without the values that are NIL.
  Examples:
  (cpl:mapcar-clean (lambda (x) (when (oddp x) x)) '(1 2 3)) => (1 3)"
  (remove nil (mapcar function list)))
