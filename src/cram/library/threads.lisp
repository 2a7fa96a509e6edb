;;;; Bordeaux threads: there are no threads of the machine, but locks, which tasks hold.

(in-package :bordeaux-threads)

(defvar bordeaux-threads:*supports-threads-p* nil
  "Are there threads of the machine? There are none.")

(defstruct (system::%lock (:constructor system::%make-lock (name recursive))
                          (:copier nil))
  name
  recursive
  (free (cpl:make-fluent :value t))
  (holder nil)
  (depth 0))

(defun make-lock (&optional name)
  "A lock.
  Examples:
  (bt:lock-p (bt:make-lock \"mine\")) => T"
  (%make-lock name nil))

(defun make-recursive-lock (&optional name)
  "A lock that whoever holds it can take again.
  Examples:
  (bt:recursive-lock-p (bt:make-recursive-lock)) => T"
  (%make-lock name t))

(defun lock-p (object)
  "Is it a lock?
  Examples:
  (bt:lock-p 1) => NIL"
  (and (typep object '%lock) (not (%lock-recursive object))))

(defun recursive-lock-p (object)
  "Is it a lock that can be taken again?
  Examples:
  (bt:recursive-lock-p 1) => NIL"
  (and (typep object '%lock) (%lock-recursive object)))

(defun %this-holder ()
  "Who takes locks now: the task, or the session outside of tasks."
  (or cpl:*current-task* :session))

(defun acquire-lock (lock &optional (waitp t))
  "Takes a lock and waits for it if need be. NIL if that is not wanted and another task has it.
  Examples:
  (let ((lock (bt:make-lock))) (list (bt:acquire-lock lock) (bt:acquire-lock lock nil))) => (T NIL)"
  (check-type lock %lock)
  (let ((me (%this-holder)))
    (loop
      (cond ((null (%lock-holder lock))
             (setf (%lock-holder lock) me
                   (%lock-depth lock) 1
                   (cpl:value (%lock-free lock)) nil)
             (return t))
            ((and (eq (%lock-holder lock) me) (%lock-recursive lock))
             (incf (%lock-depth lock))
             (return t))
            ((not waitp)
             (return nil))
            ((eq (%lock-holder lock) me)
             (error "The lock ~@[~s ~]is held already by the task that would wait for it for ever."
                    (%lock-name lock)))
            (t (cpl:wait-for (%lock-free lock)))))))

(defun release-lock (lock)
  "Gives a lock back.
  Examples:
  (let ((lock (bt:make-lock))) (bt:acquire-lock lock) (bt:release-lock lock) (bt:acquire-lock lock nil)) => T"
  (check-type lock %lock)
  (unless (%lock-holder lock)
    (error "The lock ~@[~s ~]is not held." (%lock-name lock)))
  (when (zerop (decf (%lock-depth lock)))
    (setf (%lock-holder lock) nil
          (cpl:value (%lock-free lock)) t))
  (values))

(defmacro with-lock-held ((lock &key timeout) &body body)
  "The body while a lock is held.
  Examples:
  (let ((lock (bt:make-lock))) (bt:with-lock-held (lock) 1)) => 1"
  (declare (ignore timeout))
  (let ((held (gensym "LOCK")))
    `(let ((,held ,lock))
       (acquire-lock ,held)
       (unwind-protect (progn ,@body)
         (release-lock ,held)))))

(defmacro with-recursive-lock-held ((lock &key timeout) &body body)
  "The body while a lock is held that the body may take again.
  Examples:
  (let ((lock (bt:make-recursive-lock))) (bt:with-recursive-lock-held (lock) (bt:with-recursive-lock-held (lock) 1))) => 1"
  `(with-lock-held (,lock :timeout ,timeout) ,@body))

(defun acquire-recursive-lock (lock)
  "Takes a lock that can be taken again."
  (acquire-lock lock))

(defun release-recursive-lock (lock)
  "Gives a lock back that can be taken again."
  (release-lock lock))

(defun current-thread ()
  "What runs now: the task, or :SESSION outside of tasks.
  Examples:
  (null (bt:current-thread)) => NIL"
  (%this-holder))

(defun threadp (object)
  "Is it a thread of the machine? Nothing is.
  Examples:
  (bt:threadp 1) => NIL"
  (declare (ignore object))
  nil)

(defun all-threads ()
  "The threads of the machine: none.
  Examples:
  (bt:all-threads) => NIL"
  '())

(defun thread-yield ()
  "Nothing: there are no other threads.
  Examples:
  (bt:thread-yield) => NIL"
  nil)

(defun start-multiprocessing ()
  "Nothing: there are no threads.
  Examples:
  (bt:start-multiprocessing) => NIL"
  nil)

(defun %no-threads (what)
  "The error for what needs threads."
  (error "~a: there are no threads of the machine; CPL:PAR and CPL:PURSUE do several things at once."
         what))

(defun make-thread (function &key name initial-bindings)
  "Signals an error: there are no threads of the machine.
  Examples:
  (handler-case (bt:make-thread #'list) (error () 'no-threads)) => NO-THREADS"
  (declare (ignore function initial-bindings))
  (%no-threads (format nil "The thread ~@[~s ~]cannot be made" name)))

(defun make-condition-variable (&key name)
  "Signals an error: condition variables are for threads.
  Examples:
  (handler-case (bt:make-condition-variable) (error () 'no-threads)) => NO-THREADS"
  (%no-threads (format nil "The condition variable ~@[~s ~]cannot be made" name)))
