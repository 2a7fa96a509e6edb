;;; Method combinations of programs: section 7.6.6 of the standard.
;;;
;;; The long form of DEFINE-METHOD-COMBINATION keeps a function from methods to the form that calls
;;; them, on the property list of the combination's name. The form is compiled when a list of
;;; methods is first called.

(in-package :common-lisp)

(defmacro %define-long-combination (name lambda-list groups &body body)
  "The long form of DEFINE-METHOD-COMBINATION: keeps the function that makes the effective method of a list of methods."
  (if lambda-list
      (error 'simple-program-error
             :format-control "The method combination ~s has parameters; only those without are supported."
             :format-arguments (list name)))
  (let ((methods (gensym "METHODS")))
    (if (and (consp (car body)) (member (caar body) '(:arguments :generic-function)))
        (error 'simple-program-error
               :format-control "The method combination ~s has the option ~s, which is not supported."
               :format-arguments (list name (caar body))))
    `(progn
       (%define-combination
        ',name '%call-combined
        (cons (make-hash-table :test 'equal)
              #'(lambda (,methods)
                  (let* ((,methods (%grouped-methods ',(mapcar #'%group-test groups) ,methods))
                         ,@(mapcar (lambda (group) `(,(first group) (pop ,methods))) groups))
                    (declare (ignorable ,@(mapcar #'first groups)))
                    ,@(mapcan (lambda (group)
                                (if (getf (%group-options group) :required)
                                    (list `(or ,(first group)
                                               (error "The method combination ~s needs methods of the group ~s."
                                                      ',name ',(first group))))))
                              groups)
                    (block ,name ,@body)))))
       ',name)))

(defun %group-options (group)
  "The options of a group of methods, after its patterns."
  (member-if #'keywordp (cdr group)))

(defun %group-test (group)
  "Of a group of methods, (order pattern…), where a pattern is a list of qualifiers, * or a predicate."
  (let ((options (%group-options group)))
    (cons (if (and (getf options :order) (equal (getf options :order) :most-specific-last))
              :most-specific-last
              :most-specific-first)
          (ldiff (cdr group) options))))

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
  "Calls the effective method that a combination makes of the methods. It is made once for each list of methods."
  (let* ((kept (cdr (get name 'method-combination)))
         (table (car kept))
         (effective (gethash methods table)))
    (unless effective
      (setq effective
            (eval `(lambda (%arguments)
                     (declare (ignorable %arguments))
                     (macrolet ((call-method (method &optional next-methods)
                                  `(%call-method ,(%method-form method)
                                                 %arguments
                                                 (list ,@(mapcar #'%method-form next-methods)))))
                       ,(funcall (cdr kept) methods)))))
      (setf (gethash methods table) effective))
    (funcall effective arguments)))

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
