;;;; Waiting for conditions repeatedly; suspending tasks.

(in-package :cram-language-implementation)

(defmacro whenever ((fluent) &body body)
  "Runs the body each time the fluent's value is not NIL, until (RETURN value).
  Examples:
  (cpl:whenever ((cpl:make-fluent :value 1)) (return 42)) => 42"
  (let ((watched (gensym "FLUENT"))
        (again (gensym "AGAIN")))
    `(block nil
       (let ((,watched ,fluent))
         (tagbody
            ,again
            (wait-for ,watched)
            (progn ,@body)
            (go ,again))))))

(defmacro with-task-suspended ((task &key reason) &body body)
  "Runs the body while a task holds still."
  (declare (ignore reason))
  (let ((suspended (gensym "TASK")))
    `(progn
       (plan-system:check-plan "WITH-TASK-SUSPENDED")
       (let ((,suspended ,task))
         (unwind-protect
              (progn
                (suspend ,suspended)
                (plan-system:wait-until-suspended ,suspended)
                ,@body)
           (wake-up ,suspended))))))

(defmacro on-suspension (form &body body)
  "Runs the body; each time the task is suspended meanwhile, runs the form.
  Examples:
  (cpl:top-level (cpl:on-suspension (print :held) :done)) => :DONE"
  `(progn
     (plan-system:push-suspension-hook (lambda () ,form))
     (unwind-protect (progn ,@body)
       (plan-system:pop-suspension-hook))))

(defmacro without-scheduling (&body body)
  "Runs the body; the task is not suspended or evaporated while it waits in there.
  Examples:
  (cpl:top-level (cpl:without-scheduling 1)) => 1"
  `(progn
     (plan-system:allow-scheduling -1)
     (unwind-protect (progn ,@body)
       (plan-system:allow-scheduling 1))))

(defmacro with-scheduling (&body body)
  "Inside WITHOUT-SCHEDULING, allows again that the task is disturbed.
  Examples:
  (cpl:top-level (cpl:without-scheduling (cpl:with-scheduling 1))) => 1"
  `(progn
     (plan-system:allow-scheduling 1)
     (unwind-protect (progn ,@body)
       (plan-system:allow-scheduling -1))))

(defmacro retry-after-suspension (&body body)
  "Runs the body. (Tasks hold no locks, so there is nothing to leave on suspension.)
  Examples:
  (cpl:retry-after-suspension 1) => 1"
  `(progn ,@body))
