;;; Method combinations of programs: section 7.6.6 of the standard.
;;;
;;; The long form of DEFINE-METHOD-COMBINATION keeps a function from methods to the form that calls
;;; them, on the property list of the combination's name. A generic function has a combination of its own,
;;; made of that one and of the options that it gives. The form is compiled when a list of methods is
;;; first called.

(in-package :common-lisp)

(defmacro %define-long-combination (name lambda-list groups &body body)
  "The long form of DEFINE-METHOD-COMBINATION: keeps the function that makes the effective method of a list of methods."
  (let ((methods (gensym "METHODS"))
        (options (gensym "OPTIONS"))
        (generic (gensym "GENERIC"))
        (arguments nil)
        (generic-variable nil))
    (loop while (and (consp (car body)) (member (caar body) '(:arguments :generic-function)))
          do (let ((option (pop body)))
               (if (eq (first option) :arguments)
                   (setq arguments (rest option))
                   (setq generic-variable (second option)))))
    (if (stringp (car body)) (pop body))
    (multiple-value-bind (declarations forms) (%split-body body)
      `(progn
         (%define-combination
          ',name '%call-combined
          (list* (make-hash-table :test 'equal)
                 #'(lambda (,options ,methods ,generic)
                     (declare (ignorable ,generic))
                     (destructuring-bind ,lambda-list ,options
                       (let* ((,methods (%grouped-methods
                                         (list ,@(mapcar #'%group-test groups)) ,methods))
                              ,@(mapcar (lambda (group) `(,(first group) (pop ,methods))) groups)
                              ,@(mapcar (lambda (variable) `(,variable ',variable))
                                        (%argument-variables arguments))
                              ,@(if generic-variable `((,generic-variable ,generic))))
                         (declare (ignorable ,@(mapcar #'first groups)
                                             ,@(%argument-variables arguments)))
                         ,@declarations
                         ,@(mapcan (lambda (group)
                                     (if (getf (%group-options group) :required)
                                         (list `(or ,(first group)
                                                    (error "The method combination ~s needs methods of the group ~s."
                                                           ',name ',(first group))))))
                                   groups)
                         (block ,name ,@forms))))
                 ',arguments))
         ',name))))

(defun %combination-for (combination generic lambda-list)
  "The method combination that an option (name option…) of DEFGENERIC means: one of a program with the
  options and the lambda list of that generic function, else the same."
  (let ((kept (get (first combination) 'method-combination)))
    (if (and (consp kept) (eq (car kept) '%call-combined))
        (let ((name (intern (let ((*package* (find-package :keyword)))
                              (format nil "~s of ~s" (first combination) generic))
                            :system))
              (required (position-if (lambda (item) (member item lambda-list-keywords)) lambda-list))
              (optional (member '&optional lambda-list)))
          (setf (get name 'method-combination)
                (list '%call-combined
                      combination
                      generic
                      (or required (length lambda-list))
                      (or (position-if (lambda (item) (member item lambda-list-keywords))
                                       (rest optional))
                          (length (rest optional)))))
          (list name))
        combination)))

(defun %argument-variables (lambda-list)
  "The variables of an option :ARGUMENTS."
  (mapcan (lambda (item)
            (cond ((member item lambda-list-keywords) '())
                  ((atom item) (list item))
                  (t (cons (if (consp (first item)) (second (first item)) (first item))
                           (if (third item) (list (third item)))))))
          lambda-list))

(defun %argument-bindings (lambda-list required optional)
  "Bindings of the variables of an option :ARGUMENTS to arguments of the generic function, which has so many
  required and optional parameters. Each kind of parameter is matched for itself; what is missing is NIL
  or the default."
  (let ((section :required)
        (index 0)
        (rest `(nthcdr ,(+ required optional) %arguments))
        (bindings '()))
    (flet ((bind (item given value)
             (let ((item (if (consp item) item (list item))))
               (if (third item)
                   (push `(,(third item) (and ,given t)) bindings))
               (push `(,(if (consp (first item)) (second (first item)) (first item))
                       (if ,given ,value ,(second item)))
                     bindings))))
      (dolist (item lambda-list (reverse bindings))
        (cond ((eq item '&allow-other-keys))
              ((member item lambda-list-keywords) (setq section item index 0))
              (t (case section
                   (:required (bind item (< index required) `(nth ,index %arguments)))
                   (&optional (bind item
                                    `(and ,(< index optional)
                                          (nthcdr ,(+ required index) %arguments))
                                    `(nth ,(+ required index) %arguments)))
                   ((&rest &body) (push `(,item ,rest) bindings))
                   (&whole (push `(,item %arguments) bindings)
                    (setq section :required index -1))
                   (&key (let* ((name (if (consp item) (first item) item))
                                (key (if (consp name)
                                         (first name)
                                         (intern (symbol-name name) :keyword))))
                           (bind item
                                 `(nth-value 2 (get-properties ,rest '(,key)))
                                 `(getf ,rest ',key))))
                   (t (bind item nil nil)))
                 (incf index)))))))

(defun %group-options (group)
  "The options of a group of methods, after its patterns."
  (member-if #'keywordp (cdr group)))

(defun %group-test (group)
  "A form for the order and the patterns of a group of methods, (order pattern…), where a pattern is a list
  of qualifiers, * or a predicate."
  (let ((options (%group-options group)))
    `(cons ,(getf options :order :most-specific-first) ',(ldiff (cdr group) options))))

(defun %grouped-methods (groups methods)
  "For each group, its methods; a method belongs to the first group that it fits."
  (let ((lists (make-list (length groups) :initial-element '())))
    (dolist (method methods)
      (let ((position (position-if (lambda (group) (%fits-group-p (method-qualifiers method) (cdr group)))
                                   groups)))
        (if position
            (push method (nth position lists))
            (error 'simple-program-error
                   :format-control "The method ~s belongs to no group of its method combination."
                   :format-arguments (list method)))))
    (mapcar (lambda (group list) (if (eq (first group) :most-specific-last) list (reverse list)))
            groups lists)))

(defun %fits-group-p (qualifiers patterns)
  "Do the qualifiers match one of the patterns?"
  (some (lambda (pattern)
          (cond ((eq pattern '*) t)
                ((and pattern (symbolp pattern)) (funcall pattern qualifiers))
                (t (loop
                     (cond ((eq pattern '*) (return t))
                           ((atom pattern) (return (and (null pattern) (null qualifiers))))
                           ((null qualifiers) (return nil))
                           ((or (eq (car pattern) '*) (eq (car pattern) (car qualifiers)))
                            (pop pattern) (pop qualifiers))
                           (t (return nil)))))))
        patterns))

(defun %call-combined (name methods arguments)
  "Calls the effective method that a combination makes of the methods. It is made once for each list of
  methods, and anew when the combination is redefined, which has another table then."
  (destructuring-bind (combination generic required optional) (cdr (get name 'method-combination))
    (let* ((table (second (get (first combination) 'method-combination)))
           (key (cons name methods))
           (effective (gethash key table)))
      (unless effective
        (setq effective (%effective-function combination methods generic required optional))
        (setf (gethash key table) effective))
      (funcall effective arguments))))

(defun %effective-function (combination methods generic required optional)
  "The function of a list of arguments that calls methods as a combination says."
  (destructuring-bind (table function &rest parameters)
      (cdr (get (first combination) 'method-combination))
    (declare (ignore table))
    (let ((form (funcall function (rest combination) methods
                         (and (fboundp generic) (fdefinition generic)))))
      (eval `(lambda (%arguments)
               (declare (ignorable %arguments))
               (macrolet ((call-method (method &optional next-methods)
                            `(%call-method ,(%method-form method)
                                           %arguments
                                           (list ,@(mapcar #'%method-form next-methods)))))
                 (let* ,(%argument-bindings parameters required optional)
                   (declare (ignorable ,@(%argument-variables parameters)))
                   ,form)))))))

(defun %method-form (method)
  "A form for an argument of CALL-METHOD: a method, or (make-method form)."
  (if (and (consp method) (eq (car method) 'make-method))
      `#'(lambda (%arguments) (declare (ignorable %arguments)) ,(second method))
      `',method))

(defun %call-method (method arguments next-methods)
  "Calls a method, or a form made into one, with the methods that CALL-NEXT-METHOD calls."
  (if (functionp method)
      (funcall method arguments)
      (%invoke-method method arguments
                      (if next-methods
                          (lambda (&rest given)
                            (%call-method (car next-methods) (or given arguments) (cdr next-methods)))))))

(defun method-combination-error (control &rest arguments)
  "Signals that a method combination cannot combine methods.
  Examples:
  (handler-case (method-combination-error \"no ~a\" :methods) (error (e) (princ-to-string e))) => \"no METHODS\""
  (error 'simple-error :format-control control :format-arguments arguments))

(defun invalid-method-error (method control &rest arguments)
  "Signals that a method combination cannot use a method.
  Examples:
  (progn (defgeneric weighed (x)) (handler-case (invalid-method-error (defmethod weighed (x) x) \"no ~a\" 1) (error (e) (princ-to-string e)))) => \"no 1\""
  (check-type method method)
  (error 'simple-error :format-control control :format-arguments arguments))
