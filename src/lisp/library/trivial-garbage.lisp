;;;; What programs ask of a garbage collector, under the names of trivial-garbage. Memory is freed as
;;;; soon as nothing refers to an object, and that of circles when much has come together.

(in-package :trivial-garbage)

(defun gc (&key full verbose)
  "Frees objects that hold each other and that nothing else refers to. Others are freed at once.
  Examples:
  (tg:gc :full t) => NIL
  (let ((circle (list 1))) (setf (cdr circle) circle) (let ((pointer (tg:make-weak-pointer circle))) (setf circle nil) (tg:gc :full t) (tg:weak-pointer-value pointer))) => NIL"
  (declare (ignore full verbose))
  (system::%free-circles)
  nil)

(defun make-weak-pointer (object)
  "An object that refers to another one without keeping it.
  Examples:
  (let ((cup (list 1))) (tg:weak-pointer-value (tg:make-weak-pointer cup))) => (1)
  (tg:weak-pointer-value (tg:make-weak-pointer (list 1))) => NIL"
  (assert (not (null object)))
  (system::%make-weak-pointer object))

(defun weak-pointer-value (weak-pointer)
  "The object to which a weak pointer refers; NIL if it is gone.
  Examples:
  (tg:weak-pointer-value (tg:make-weak-pointer 'cup)) => CUP"
  (system::%weak-pointer-value weak-pointer))

(defun weak-pointer-p (object)
  "Is the object a weak pointer?
  Examples:
  (tg:weak-pointer-p 1) => NIL"
  (system::%weak-pointer-p object))

(defvar system::%*told-of-weakness* nil "Was said that hash tables keep what is in them?")

(defun make-weak-hash-table (&rest options &key weakness (weakness-matters t) &allow-other-keys)
  "A hash table that keeps its keys and values; says so, once, unless :WEAKNESS-MATTERS is NIL.
  Examples:
  (hash-table-p (tg:make-weak-hash-table :weakness :key :weakness-matters nil)) => T"
  (when (and weakness weakness-matters (not system::%*told-of-weakness*))
    (setf system::%*told-of-weakness* t)
    (warn "There are no weak hash tables: this one keeps what is in it."))
  (apply #'make-hash-table
         (loop for (key value) on options by #'cddr
               unless (member key '(:weakness :weakness-matters))
                 collect key and collect value)))

(defun hash-table-weakness (table)
  "Which references of a hash table are weak: NIL, none.
  Examples:
  (tg:hash-table-weakness (make-hash-table)) => NIL"
  (check-type table hash-table)
  nil)

(defun finalize (object function &key dont-save)
  "Signals that nothing can be called when an object is freed.
  Examples:
  (handler-case (tg:finalize (list 1) (lambda ())) (error () 'cannot)) => CANNOT"
  (declare (ignore function dont-save))
  (error "There are no finalizers: nothing is called when ~s is freed." object))

(defun cancel-finalization (object)
  "Does nothing: there are no finalizers.
  Examples:
  (tg:cancel-finalization (list 1)) => NIL"
  (declare (ignore object))
  nil)
