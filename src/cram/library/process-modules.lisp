;;; Process modules: functions that carry out motions, each module one motion at a time.

(in-package :cram-process-modules)

(defun %busy-fluent (module)
  "Whether a module is at work."
  (or (get module 'busy)
      (setf (get module 'busy) (cpl:make-fluent :name module :value nil))))

(defun pm-execute (module designator)
  "Lets a process module carry out a motion, after the one that it is at."
  (let ((busy (%busy-fluent module)))
    (when (cpl:value busy)
      (warn "Process module ~a already processing input. Waiting for it to become free."
            module))
    (loop while (cpl:value busy)
          do (cpl:wait-for (cpl-impl:fl-not busy)))
    (setf (cpl:value busy) t)
    (unwind-protect (funcall module designator)
      (setf (cpl:value busy) nil))))

(defun pm-execute-matching (designator)
  "Lets the process module that matches a motion carry it out."
  (exe:perform designator))

(defmacro def-process-module (name (designator) &body body)
  "Defines a process module: what it does with a motion."
  `(progn
     (defun ,name (,designator) ,@body)
     (setf (get ',name 'busy) nil)
     ',name))

(defmacro with-process-modules-running (modules &body body)
  "The body. Process modules are ready whenever they are defined."
  (declare (ignore modules))
  `(progn ,@body))
