;;;; Goals: plans that are chosen by matching the arguments of a call against patterns. The goals
;;;; with one name are lists of pattern, variables, function and documentation.

(in-package :cram-language-implementation)

(defun %is-variable (object)
  "Is this a ?variable?"
  (and (symbolp object)
       (values (alexandria:starts-with-subseq "?" (symbol-name object)))))

(defun %match (pattern object bindings)
  "The bindings of the variables under which a pattern is an object, and whether it is."
  (cond ((not (%is-variable pattern))
         (if (and (consp pattern) (consp object))
             (multiple-value-bind (bindings matches)
                 (%match (car pattern) (car object) bindings)
               (if matches
                   (%match (cdr pattern) (cdr object) bindings)
                   (values nil nil)))
             (values bindings (equal pattern object))))
        ((string= pattern "?_")
         (values bindings t))
        ((assoc pattern bindings)
         (values bindings (equal (cdr (assoc pattern bindings)) object)))
        (t
         (values (acons pattern object bindings) t))))

(defun %pattern-variables (pattern)
  "The variables of a pattern, in order."
  (remove-duplicates
   (remove "?_" (remove-if-not #'%is-variable (alexandria:flatten pattern)) :test #'string=)
   :from-end t))

(defun %call-goal (name arguments)
  "Calls the first goal whose pattern matches."
  (loop for (pattern variables function) in (get name '%goals)
        do (multiple-value-bind (bindings matches) (%match pattern arguments '())
             (when matches
               (return-from %call-goal
                 (apply function
                        (loop for variable in variables
                              collect (cdr (assoc variable bindings))))))))
  (error "No goal found that matches arguments: ~a ~a" name arguments))

(defun %register-goal (name pattern variables function documentation)
  "Adds a goal; one with the same pattern is replaced."
  (let ((goal (list pattern variables function documentation))
        (place (member pattern (get name '%goals) :test #'equal :key #'first)))
    (if place
        (setf (first place) goal)
        (setf (get name '%goals) (append (get name '%goals) (list goal))))
    name))

(defmacro declare-goal (name lambda-list &body body)
  "Declares goals of a name: a call runs the body, which may RETURN, and then the first goal
  whose pattern matches the arguments.
  Examples:
  (cpl:declare-goal achieve (what)) => ACHIEVE"
  (multiple-value-bind (forms declarations documentation)
      (alexandria:parse-body body :documentation t)
    (let ((arguments (gensym "ARGUMENTS")))
      `(progn
         (setf (get ',name '%goals) '())
         (defun ,name (&rest ,arguments)
           ,@(when documentation (list documentation))
           (block nil
             (apply (lambda ,lambda-list ,@declarations ,@forms) ,arguments)
             (%call-goal ',name ,arguments)))))))

(defmacro def-goal ((name &rest pattern) &body body)
  "Defines a goal; symbols that begin with ? in the pattern are variables of the body.
  (SUCCEED value…) leaves it.
  Examples:
  (progn (cpl:declare-goal reach (what)) (cpl:def-goal (reach (loc ?x)) (list :at ?x)) (cpl:top-level (reach '(loc table)))) => (:AT TABLE)"
  (multiple-value-bind (forms declarations documentation)
      (alexandria:parse-body body :documentation t)
    (let ((variables (%pattern-variables pattern))
          (goal (gensym "GOAL"))
          (results (gensym "RESULTS")))
      `(%register-goal
        ',name ',pattern ',variables
        (lambda ,variables
          (declare (ignorable ,@variables))
          ,@declarations
          (plan-system:call-in-node
           '(goal (,name ,@pattern)) ,(format nil "GOAL-~a" name)
           (lambda ()
             (block ,goal
               (flet ((succeed (&rest ,results)
                        (return-from ,goal (values-list ,results))))
                 ,(%with-tags forms))))))
        ,documentation))))

(defun describe-goal (goal)
  "The documentation of the goal with a pattern, or NIL."
  (fourth (assoc (rest goal) (get (first goal) '%goals) :test #'equal)))
