;;;; Policies: conditions that are watched while a body runs.

(in-package :cram-language-implementation)

(defun %policy-function (parameters forms)
  "A function of a storage and a policy's parameters, with POLICY-SETF and POLICY-GET."
  (let ((storage (gensym "STORAGE")))
    `(lambda (,storage ,@parameters)
       (flet ((policy-setf (symbol value) (setf (gethash symbol ,storage) value))
              (policy-get (symbol) (values (gethash symbol ,storage))))
         ,@forms))))

(defmacro make-policy (name parameters &body parts)
  "A policy of parts (:INIT form…), (:CHECK form…), (:RECOVER form…) and (:CLEAN-UP form…).
  Examples:
  (cpl-impl:name (cpl:make-policy calm () (:check nil))) => CALM"
  (multiple-value-bind (parts declarations documentation)
      (alexandria:parse-body parts :documentation t)
    (declare (ignore declarations))
    (let ((kinds '(:init :check :recover :clean-up)))
      (dolist (part parts)
        (unless (and (consp part) (member (first part) kinds))
          (%malformed
           "~s is not a part of a policy: :INIT, :CHECK, :RECOVER or :CLEAN-UP was expected."
           part)))
      `(plan-system:make-policy
        ',name ',parameters ,documentation
        (list ,@(mapcan (lambda (part)
                          (list (first part) (%policy-function parameters (rest part))))
                        parts))))))

(defmacro define-policy (name parameters &body parts)
  "Defines a policy and a variable that holds it.
  Examples:
  (cpl-impl:name (cpl:define-policy quiet () (:check nil))) => QUIET"
  `(progn
     (defparameter ,name
       (setf (get ',name '%policy) (make-policy ,name ,parameters ,@parts)))
     ,name))

(defun named-policy (name)
  "The policy of a name; fails with POLICY-NOT-FOUND."
  (or (and (symbolp name) (get name '%policy))
      (fail 'policy-not-found :name name)))

(defun %call-with-policy (policy arguments body)
  "Calls a function while a policy's check, made every 10 ms, is NIL."
  (let ((storage (make-hash-table))
        (is-met nil))
    (labels ((has (part) (getf (plan-system:policy-parts policy) part))
             (call (part) (apply (has part) storage arguments))
             (fail-by (condition)
               (fail condition :name (name policy) :parameters arguments))
             (watch ()
               (loop until (call :check) do (sleep* 0.01d0))
               (setf is-met t)))
      (when (and (has :init) (not (call :init)))
        (fail-by 'policy-init-failed))
      (unwind-protect
           (if (has :check)
               (plan-system:pursue #'watch body)
               (funcall body))
        (when (and is-met (has :recover))
          (call :recover))
        (when (has :clean-up)
          (call :clean-up))
        (when is-met
          (fail-by 'policy-check-condition-met))))))

(defmacro with-policy (policy (&rest parameters) &body body)
  "Runs the body while the policy's check, made every 10 ms, is NIL; else recovers and fails
  with POLICY-CHECK-CONDITION-MET.
  Examples:
  (cpl:top-level (cpl:with-policy cpl:timeout-policy (10) :in-time)) => :IN-TIME"
  `(%call-with-policy ,policy (list ,@parameters) (lambda () ,@body)))

(defmacro with-named-policy (name (&rest parameters) &body body)
  "WITH-POLICY by the name of the policy.
  Examples:
  (cpl:top-level (cpl:with-named-policy 'cpl:timeout-policy (10) :in-time)) => :IN-TIME"
  `(with-policy (named-policy ,name) ,parameters ,@body))

(defmacro with-policies (policies &body body)
  "Several policies around a body: POLICIES is a list of (policy (&rest parameters)).
  Examples:
  (cpl:top-level (cpl:with-policies ((cpl:timeout-policy (10))) :in-time)) => :IN-TIME"
  (reduce (lambda (policy form) `(with-policy ,@policy ,form))
          policies
          :from-end t
          :initial-value `(progn ,@body)))

(defmacro with-named-policies (policies &body body)
  "WITH-POLICIES by the names of the policies.
  Examples:
  (cpl:top-level (cpl:with-named-policies (('cpl:timeout-policy (10))) :in-time)) => :IN-TIME"
  (reduce (lambda (policy form) `(with-named-policy ,@policy ,form))
          policies
          :from-end t
          :initial-value `(progn ,@body)))

(define-policy timeout-policy (seconds)
  "Met when so many simulated seconds have passed."
  (:check (sleep* seconds) t))
