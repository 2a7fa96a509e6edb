;;; TRACE of what plans do: actions and motions, by their types, and fluents, by the variables that
;;; hold them.

(in-package :cram-executive)

(defvar system::%*traced-types* '()
  "The names of the types of actions and motions that are traced. PERFORM looks at it.")

(push 'system::%trace-type %*tracers*)
(push 'system::%trace-fluent %*tracers*)

;; What a task calls is inside of what its parent has called.
(plan-system:define-task-variable '%*trace-depth* nil)

(defun %trace-type (name)
  "Shows each performance of a type of actions or motions, if the name is that of one."
  (let ((types (and (symbolp name) (%types-named name))))
    (when types
      (setf %*traced-types* (append types %*traced-types*))
      (values (constantly t)
              (lambda ()
                (dolist (type types)
                  (setf %*traced-types*
                        (remove type %*traced-types* :test #'string= :count 1))))))))

(defun %perform-traced (designator)
  "Performs an action or motion, and shows that if its type is traced."
  (let ((type (desig:desig-prop-value designator :type)))
    (if (and (symbolp type)
             (intersection (%types-named type) %*traced-types* :test #'string=))
        (%traced-call (format nil "(PERFORM ~A)" (%description designator))
                      (symbol-name type)
                      (lambda () (%perform designator)))
        (%perform designator))))

(defun %description (designator)
  "A designator on one line, as it is written."
  (let ((text (%on-one-line (princ-to-string designator))))
    (format nil "(~A)" (subseq text (length "#<") (1- (length text))))))

(defun %trace-fluent (name)
  "Shows each change of the fluent that a variable holds, if it holds one."
  (let ((fluent (and (symbolp name) (boundp name) (symbol-value name)))
        (callback (make-symbol "TRACE")))
    (when (typep fluent 'cpl:fluent)
      (cpl:register-update-callback
       fluent callback
       (lambda (value) (%tell-trace %*trace-depth* "~S is ~S" name value)))
      (values (lambda () (and (boundp name) (eq (symbol-value name) fluent)))
              (lambda () (cpl:remove-update-callback fluent callback))))))
