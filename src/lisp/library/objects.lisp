;;; Types and objects: chapters 4 and 7 of the standard.

(in-package :common-lisp)

(defmacro deftype (name lambda-list &body body)
  "Defines a type by what its specifiers stand for.
  Examples:
  (deftype small () '(integer 0 9)) => SMALL"
  (let ((arguments (gensym "ARGS"))
        (expander (gensym "EXPANDER"))
        (stands-alone (or (null lambda-list)
                          (member (first lambda-list) '(&optional &key &rest &aux)))))
    (multiple-value-bind (declarations forms text) (%body-parts body)
      `(let ((,expander (lambda (,arguments)
                          ,@(and text (list text))
                          (destructuring-bind ,(%star-defaults lambda-list nil) ,arguments
                            ,@declarations
                            (block ,name ,@forms)))))
         (%define-type ',name ,expander
                       ,(and stands-alone
                             `(ignore-errors (list (funcall ,expander '())))))
         ',name))))

(defun upgraded-complex-part-type (type &optional environment)
  "The type that the parts of a complex number have that is made for parts of a type: that type itself.
  Examples:
  (upgraded-complex-part-type '(single-float 0 1)) => (SINGLE-FLOAT 0 1)
  (upgraded-complex-part-type 'bit) => BIT"
  (declare (ignore environment))
  (unless (subtypep type 'real)
    (error "~s is no type of parts of complex numbers, which are real." type))
  type)

(defun %star-defaults (lambda-list is-optional)
  "The lambda list with '* as the default of optional parameters that have none."
  (if (atom lambda-list)
      lambda-list
      (let ((item (car lambda-list)))
        (if (member item '(&optional &key &rest &body &aux &allow-other-keys))
            (setq is-optional (member item '(&optional &key)))
            (if is-optional
                (if (or (atom item) (null (cdr item)))
                    (setq item (list (if (atom item) item (car item)) ''*)))))
        (cons item (%star-defaults (cdr lambda-list) is-optional)))))

(defmacro with-slots ((&rest slots) instance &body body)
  "Evaluates the body with the slots as variables; a slot is a name or (variable name).
  Examples:
  (progn (defclass cup () ((size :initform 2))) (with-slots (size) (make-instance 'cup) (incf size))) => 3"
  (let ((object (gensym "INSTANCE")))
    `(let ((,object ,instance))
       (symbol-macrolet
           ,(mapcar (lambda (entry)
                      (destructuring-bind (variable &optional (slot variable))
                          (if (consp entry) entry (list entry))
                        `(,variable (slot-value ,object ',slot))))
                    slots)
         ,@body))))

(defmacro with-accessors ((&rest entries) instance &body body)
  "Evaluates the body with variables that stand for calls of accessors, each written (variable accessor).
  Examples:
  (with-accessors ((head car)) (list 1 2) (incf head)) => 2"
  (let ((object (gensym "INSTANCE")))
    `(let ((,object ,instance))
       (symbol-macrolet
           ,(mapcar (lambda (entry)
                      (destructuring-bind (variable accessor) entry
                        `(,variable (,accessor ,object))))
                    entries)
         ,@body))))

(defun ensure-generic-function (name &key (lambda-list '() lambda-list-p) documentation
                                       generic-function-class method-class
                                       argument-precedence-order declare environment
                                       method-combination)
  "The generic function of a name, which is made if there is none.
  Examples:
  (progn (ensure-generic-function 'ensured :lambda-list '(x)) (typep #'ensured 'generic-function)) => T"
  (declare (ignore generic-function-class method-class declare environment method-combination))
  (let ((function (and (fboundp name) (fdefinition name))))
    (unless (typep function '(or null generic-function))
      (error "~s is no generic function." name))
    (cond ((or (null function) lambda-list-p)
           (%ensure-generic name lambda-list '(standard) documentation argument-precedence-order t))
          (documentation
           (setf (documentation function t) documentation)
           function)
          (t function))))

(defun make-load-form (object &optional environment)
  "Forms that make an object like this one and initialize it. Programs add methods.
  Examples:
  (make-load-form (find-class 'integer)) => (FIND-CLASS 'INTEGER)"
  (declare (ignore environment))
  (typecase object
    (class (list 'find-class (list 'quote (class-name object))))
    (t (error "There is no MAKE-LOAD-FORM method for ~s." object))))

(defun make-load-form-saving-slots (object &key (slot-names nil slot-names-p) environment)
  "Forms that make an object of the same class and set its slots.
  Examples:
  (progn (defstruct spot x) (spot-x (let ((spot (make-spot :x 3))) (multiple-value-bind (make set) (make-load-form-saving-slots spot) (let ((made (eval make))) (eval (subst made spot set)) made))))) => 3"
  (declare (ignore environment))
  (values `(allocate-instance (find-class ',(class-name (class-of object))))
          `(progn
             ,@(loop for name in (if slot-names-p slot-names (%slot-names (class-of object)))
                     collect (if (slot-boundp object name)
                                 `(setf (slot-value ,object ',name) ',(slot-value object name))
                                 `(slot-makunbound ,object ',name))))))
