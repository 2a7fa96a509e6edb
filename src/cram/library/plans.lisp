;;;; Functions that are plans: each call is a task at a node of the task tree. Tags: names
;;;; for the tasks of parts of a plan.

(in-package :cram-language-implementation)

(defun %expand-tag (name forms)
  "The expansion of (:TAG NAME FORM…)."
  `(progn
     (setq ,name (plan-system:fresh-tag ,name ',name))
     (plan-system:run-tag ,name (lambda () ,@forms))))

(defun %with-tags (body)
  "A body in which (:TAG NAME FORM…) runs forms in a task."
  (let ((names (plan-system:find-tags body)))
    (if names
        `(let* ,(mapcar (lambda (name) `(,name (plan-system:make-tag ',name))) names)
           (macrolet ((:tag (name &body forms) (%expand-tag name forms)))
             ,@body))
        `(progn ,@body))))

(defmacro with-tags (&body body)
  "Runs the body, in which (:TAG NAME FORM…) runs forms in a task of that name; the names are
  bound to the tasks.
  Examples:
  (cpl:top-level (cpl:with-tags (:tag a 1) (list (cpl:value (cpl:status a)) (cpl:result a)))) => (:SUCCEEDED 1)"
  `(progn
     (plan-system:check-plan "WITH-TAGS")
     ,(%with-tags body)))

(defmacro keyword:tag (name &body body)
  "Inside WITH-TAGS, runs forms in a task of that name.
  Examples:
  (cpl:top-level (cpl:with-tags (:tag a 1))) => 1"
  (declare (ignore body))
  `(plan-system:tag-outside ',name))

(defun %define-plan (name lambda-list body path-part &optional is-top-level)
  "The definition of a function whose body runs at a node of the task tree."
  (unless (and name (symbolp name))
    (%malformed "~s is not the name of a plan." name))
  (multiple-value-bind (forms declarations documentation)
      (alexandria:parse-body body :documentation t)
    (let ((call `(plan-system:call-in-node
                  ',path-part ,(symbol-name name)
                  (lambda () (block ,name ,(%with-tags forms))))))
      `(defun ,name ,lambda-list
         ,@(when documentation (list documentation))
         ,@declarations
         ,(if is-top-level
              `(plan-system:start ',name (lambda () ,call))
              call)))))

(defmacro def-cram-function (name lambda-list &body body)
  "Defines a function for plans: a call is a task with a path of its own.
  Examples:
  (cpl:def-cram-function pick (x) (list :picked x)) => PICK"
  (%define-plan name lambda-list body (list name)))

(defmacro def-plan (name lambda-list &body body)
  "The old name of DEF-CRAM-FUNCTION.
  Examples:
  (cpl:def-plan place (x) (list :placed x)) => PLACE"
  (%define-plan name lambda-list body (list name)))

(defmacro def-top-level-cram-function (name lambda-list &body body)
  "Defines a function that is a whole plan.
  Examples:
  (cpl:def-top-level-cram-function main () :done) => MAIN"
  (%define-plan name lambda-list body (list 'top-level name) t))

(defmacro def-top-level-plan (name lambda-list &body body)
  "The old name of DEF-TOP-LEVEL-CRAM-FUNCTION.
  Examples:
  (cpl:def-top-level-plan main-plan () :done) => MAIN-PLAN"
  (%define-plan name lambda-list body (list 'top-level name) t))

(defmacro with-task-tree-node
    ((&key path-part (name "WITH-TASK-TREE-NODE") lambda-list parameters &allow-other-keys)
     &body body)
  "Runs the body in a task whose path begins with a part.
  Examples:
  (cpl:top-level (cpl:with-task-tree-node (:path-part '(x 1)) cpl-impl:*current-path*)) => ((X 1))"
  (unless path-part
    (error "Path parameter is required."))
  `(plan-system:call-in-node
    ,path-part ,name
    ,(if lambda-list
         `(lambda () (apply (lambda ,lambda-list ,@body) ,parameters))
         `(lambda () ,@body))))

;;; Variables

(defmacro def-cpl-parameter (name value &optional doc)
  "Defines a variable that all tasks share.
  Examples:
  (cpl:def-cpl-parameter *speed* 10) => *SPEED*"
  `(defparameter ,name ,value ,@(when doc (list doc))))

(defmacro define-task-variable (name &optional (value nil has-value) doc
                                &key type init-function)
  "Defines a variable that each task binds anew: to the value in the task that starts it, or
  to what a function of the task, its parent and that value returns.
  Examples:
  (progn (cpl:define-task-variable *my-depth* 0) (cpl:top-level (setf *my-depth* 1)) *my-depth*) => 0"
  (declare (ignore type))
  `(progn
     (defvar ,name ,@(when has-value (list value)) ,@(when doc (list doc)))
     (plan-system:define-task-variable ',name ,init-function)))
