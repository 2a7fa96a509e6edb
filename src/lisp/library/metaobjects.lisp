;;;; What programs can find out about classes, slots, generic functions and methods: the part of the
;;;; metaobject protocol that looks, under the names of closer-mop.

(in-package :closer-mop)

;;; Classes

(defun classp (object)
  "Is the object a class?
  Examples:
  (closer-mop:classp (find-class 'integer)) => T"
  (typep object 'class))

(defun subclassp (class superclass)
  "Is a class, or the class of a name, a subclass of another one?
  Examples:
  (closer-mop:subclassp 'integer 'number) => T"
  (flet ((class-named (designator)
           (if (classp designator) designator (find-class designator))))
    (and (member (class-named superclass) (class-precedence-list (class-named class))) t)))

(defun class-direct-superclasses (class)
  "The superclasses that a class was defined with.
  Examples:
  (mapcar 'class-name (closer-mop:class-direct-superclasses (find-class 'integer))) => (RATIONAL)"
  (%related-classes class :superclasses))

(defun class-direct-subclasses (class)
  "The classes that were defined with a class as their superclass.
  Examples:
  (mapcar 'class-name (closer-mop:class-direct-subclasses (find-class 'integer))) => (FIXNUM BIGNUM)"
  (%related-classes class :subclasses))

(defun class-precedence-list (class)
  "A class and all its superclasses, the most specific first.
  Examples:
  (mapcar 'class-name (closer-mop:class-precedence-list (find-class 'integer))) => (INTEGER RATIONAL REAL NUMBER T)"
  (finalize-inheritance class)
  (%related-classes class :precedence))

(defun compute-class-precedence-list (class)
  "A class and all its superclasses, the most specific first.
  Examples:
  (length (closer-mop:compute-class-precedence-list (find-class 't))) => 1"
  (class-precedence-list class))

(defun class-finalized-p (class)
  "Are all superclasses of a class defined?
  Examples:
  (progn (defclass unfinished (not-yet-defined) ()) (closer-mop:class-finalized-p (find-class 'unfinished))) => NIL"
  (and (%related-classes class :precedence) t))

(defun finalize-inheritance (class)
  "Signals an error unless all superclasses of a class are defined; what it inherits is always known then.
  Examples:
  (closer-mop:finalize-inheritance (find-class 'integer)) => NIL"
  (unless (class-finalized-p class)
    (error "The class ~s cannot be finalized: not all its superclasses are defined."
           (class-name class))))

(defun ensure-finalized (class &optional (error-p t))
  "The class, once all its superclasses are defined; until then an error or NIL.
  Examples:
  (class-name (closer-mop:ensure-finalized (find-class 'integer))) => INTEGER"
  (cond ((class-finalized-p class) class)
        (error-p (finalize-inheritance class))))

(defun class-prototype (class)
  "An instance of a class whose slots have no values.
  Examples:
  (progn (defclass cup () (size)) (type-of (closer-mop:class-prototype (find-class 'cup)))) => CUP"
  (finalize-inheritance class)
  (allocate-instance class))

(defun class-slots (class)
  "Descriptions of all slots that the instances of a class have.
  Examples:
  (progn (defclass cup () (size)) (defclass mug (cup) (handle)) (mapcar 'closer-mop:slot-definition-name (closer-mop:class-slots (find-class 'mug)))) => (SIZE HANDLE)"
  (finalize-inheritance class)
  (loop for description in (%slots class nil)
        for location from 0
        collect (apply #'make-instance 'standard-effective-slot-definition
                       :location location
                       description)))

(defun class-direct-slots (class)
  "Descriptions of the slots that a class itself was defined with.
  Examples:
  (progn (defclass cup () (size)) (defclass mug (cup) ((handle :accessor handle))) (mapcar 'closer-mop:slot-definition-readers (closer-mop:class-direct-slots (find-class 'mug)))) => ((HANDLE))"
  (loop for description in (%slots class t)
        collect (apply #'make-instance 'standard-direct-slot-definition description)))

(defun class-default-initargs (class)
  "The default initargs of a class, inherited ones included: lists of key, NIL and function.
  Examples:
  (progn (defclass cup () ((size :initarg :size)) (:default-initargs :size 3)) (mapcar 'first (closer-mop:class-default-initargs (find-class 'cup)))) => (:SIZE)"
  (finalize-inheritance class)
  (%default-initargs class nil))

(defun class-direct-default-initargs (class)
  "The default initargs that a class itself was defined with: lists of key, NIL and function.
  Examples:
  (closer-mop:class-direct-default-initargs (find-class 'integer)) => NIL"
  (%default-initargs class t))

(defun ensure-class (name &key direct-superclasses direct-slots direct-default-initargs documentation
                            (metaclass 'standard-class))
  "Defines a class, or defines it anew, as DEFCLASS does with a form. A slot is a list of :NAME,
  :INITARGS, :INITFORM, :INITFUNCTION, :READERS, :WRITERS, :TYPE, :ALLOCATION and :DOCUMENTATION.
  Examples:
  (progn (closer-mop:ensure-class 'jug :direct-slots '((:name size :initargs (:size) :readers (jug-size)))) (jug-size (make-instance 'jug :size 2))) => 2"
  (flet ((named (class)
           (if (symbolp class) class (class-name class))))
    (unless (eq (named metaclass) 'standard-class)
      (error "There are no classes of classes but STANDARD-CLASS, so ~s cannot be one." (named metaclass)))
    (eval `(defclass ,name ,(mapcar #'named direct-superclasses)
             ,(mapcar #'%slot-specification direct-slots)
             ,@(and direct-default-initargs
                    `((:default-initargs
                       ,@(loop for (key form function) in direct-default-initargs
                               append (list key (if function `(funcall ,function) form))))))
             ,@(and documentation `((:documentation ,documentation)))))))

(defun %slot-specification (description)
  "The slot of a DEFCLASS form for a list of properties."
  (destructuring-bind (&key name initargs (initform nil initform-p) initfunction readers writers
                         (type t) (allocation :instance) documentation)
      description
    `(,name
      ,@(loop for key in initargs append `(:initarg ,key))
      ,@(cond (initfunction `(:initform (funcall ,initfunction)))
              (initform-p `(:initform ,initform)))
      ,@(loop for reader in readers append `(:reader ,reader))
      ,@(loop for writer in writers append `(:writer ,writer))
      :type ,type
      :allocation ,allocation
      ,@(and documentation `(:documentation ,documentation)))))

;;; Slots

(defun slot-definition-name (slot)
  "The name of a slot."
  (slot-value slot 'name))

(defun slot-definition-initargs (slot)
  "The keywords that give a slot its value.
  Examples:
  (progn (defclass cup () ((size :initarg :size))) (closer-mop:slot-definition-initargs (first (closer-mop:class-slots (find-class 'cup))))) => (:SIZE)"
  (slot-value slot 'initargs))

(defun slot-definition-initfunction (slot)
  "A function without arguments that computes the initial value of a slot, or NIL.
  Examples:
  (progn (defclass cup () ((size :initform (+ 1 2)))) (funcall (closer-mop:slot-definition-initfunction (first (closer-mop:class-slots (find-class 'cup)))))) => 3"
  (slot-value slot 'initfunction))

(defun slot-definition-type (slot)
  "The type that a slot was declared with."
  (slot-value slot 'type))

(defun slot-definition-allocation (slot)
  "Where the value of a slot is: `:instance` or `:class`.
  Examples:
  (progn (defclass cup () ((count :allocation :class))) (closer-mop:slot-definition-allocation (first (closer-mop:class-slots (find-class 'cup))))) => :CLASS"
  (slot-value slot 'allocation))

(defun slot-definition-readers (slot)
  "The functions that read a slot, of those that its class was defined with."
  (slot-value slot 'readers))

(defun slot-definition-writers (slot)
  "The functions that set a slot, of those that its class was defined with."
  (slot-value slot 'writers))

(defun slot-definition-location (slot)
  "The place of a slot among those of its class."
  (slot-value slot 'location))

(defun slot-value-using-class (class object slot)
  "The value of a slot that is described by an object."
  (declare (ignore class))
  (slot-value object (%name-of-slot slot)))

(defun (setf slot-value-using-class) (value class object slot)
  "Sets a slot that is described by an object."
  (declare (ignore class))
  (setf (slot-value object (%name-of-slot slot)) value))

(defun slot-boundp-using-class (class object slot)
  "Has a slot that is described by an object a value?"
  (declare (ignore class))
  (slot-boundp object (%name-of-slot slot)))

(defun slot-makunbound-using-class (class object slot)
  "Takes the value of a slot away that is described by an object."
  (declare (ignore class))
  (slot-makunbound object (%name-of-slot slot)))

(defun %name-of-slot (slot)
  "The name of a slot that is given by its name or its description."
  (if (symbolp slot) slot (slot-definition-name slot)))

;;; Generic functions and methods

(defun generic-function-name (function)
  "The name of a generic function.
  Examples:
  (progn (defgeneric weigh (x)) (closer-mop:generic-function-name #'weigh)) => WEIGH"
  (%generic-function-name function))

(defun generic-function-methods (function)
  "The methods of a generic function.
  Examples:
  (progn (defgeneric weigh (x) (:method ((x integer)) x) (:method ((x string)) 0)) (length (closer-mop:generic-function-methods #'weigh))) => 2"
  (%generic-function-methods function))

(defun method-specializers (method)
  "What the required arguments of a method have to be: classes, and objects that stand for (EQL value).
  Examples:
  (progn (defgeneric weigh (x)) (mapcar 'class-name (closer-mop:method-specializers (defmethod weigh ((x integer)) x)))) => (INTEGER)"
  (loop for specializer in (%method-specializers method)
        collect (if (consp specializer)
                    (intern-eql-specializer (second specializer))
                    specializer)))

(defun method-generic-function (method)
  "The generic function of a method, or NIL if it has none.
  Examples:
  (progn (defgeneric weigh (x)) (eq #'weigh (closer-mop:method-generic-function (defmethod weigh (x) x)))) => T"
  (let* ((name (%method-name method))
         (function (and (fboundp name) (fdefinition name))))
    (and (typep function 'generic-function)
         (member method (generic-function-methods function))
         function)))

(defun method-function (method)
  "A function of a list of arguments and a list of next methods that does what a method does.
  Examples:
  (progn (defgeneric weigh (x)) (funcall (closer-mop:method-function (defmethod weigh ((x integer)) (* 2 x))) '(21) '())) => 42"
  (lambda (arguments next-methods)
    (%invoke-method method arguments
                    (labels ((following (methods)
                               (and methods
                                    (lambda (&rest arguments)
                                      (%invoke-method (first methods) arguments
                                                      (following (rest methods)))))))
                      (following next-methods)))))

(defun intern-eql-specializer (object)
  "What stands for (EQL object) among the specializers of a method.
  Examples:
  (closer-mop:eql-specializer-object (closer-mop:intern-eql-specializer 3)) => 3"
  (make-instance 'eql-specializer :object object))

(defun eql-specializer-object (specializer)
  "The object that an argument has to be."
  (slot-value specializer 'object))

(defun compute-applicable-methods-using-classes (function classes)
  "The methods that apply to arguments of these classes, the most specific first; and whether the classes
  decide that, which they do not where an argument has to be a certain object.
  Examples:
  (progn (defgeneric weigh-float (x) (:method ((x number)) x) (:method ((x integer)) 0)) (length (closer-mop:compute-applicable-methods-using-classes #'weigh-float (list (find-class 'float))))) => 1"
  (let ((methods (%generic-function-methods function)))
    (if (loop for method in methods
                thereis (some #'consp (%method-specializers method)))
        (values nil nil)
        (values
         (stable-sort
          (loop for method in methods
                when (every #'subclassp classes (%method-specializers method))
                  collect method)
          (lambda (a b)
            (loop for class in classes
                  for order = (class-precedence-list class)
                  for first in (%method-specializers a)
                  for second in (%method-specializers b)
                  unless (eq first second)
                    return (< (position first order) (position second order)))))
         t))))
