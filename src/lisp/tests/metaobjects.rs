//! What classes and generic functions consist of.

use super::standard::check;

#[test]
fn classes_tell_their_slots_and_relatives() {
    check(&[
        (
            "(defclass cup () ((size :initarg :size :initform 3 :type integer :reader cup-size)))
             (defclass mug (cup) ((handle :accessor mug-handle)) (:default-initargs :size 5))
             (list (mapcar #'c2mop:slot-definition-name (c2mop:class-slots (find-class 'mug)))
                   (mapcar #'c2mop:slot-definition-name (c2mop:class-direct-slots (find-class 'mug)))
                   (mapcar #'class-name (c2mop:class-direct-superclasses (find-class 'mug)))
                   (mapcar #'class-name (c2mop:class-direct-subclasses (find-class 'cup))))",
            "((SIZE HANDLE) (HANDLE) (CUP) (MUG))",
        ),
        (
            "(defclass cup () ((size :initarg :size :initform 3 :type integer :reader cup-size)))
             (let ((slot (first (c2mop:class-direct-slots (find-class 'cup)))))
               (list (c2mop:slot-definition-initargs slot) (c2mop:slot-definition-type slot)
                     (c2mop:slot-definition-readers slot)
                     (funcall (c2mop:slot-definition-initfunction slot))))",
            "((:SIZE) INTEGER (CUP-SIZE) 3)",
        ),
        (
            "(defgeneric grip (x y))
             (defmethod grip ((x integer) (y (eql 7))) nil)
             (let ((method (first (c2mop:generic-function-methods #'grip))))
               (list (c2mop:generic-function-name #'grip)
                     (class-name (first (c2mop:method-specializers method)))
                     (c2mop:eql-specializer-object (second (c2mop:method-specializers method)))))",
            "(GRIP INTEGER 7)",
        ),
    ]);
}

#[test]
fn methods_have_as_many_specializers_as_their_function() {
    check(&[
        (
            "(progn (defgeneric of-two (a b)) (defmethod of-two ((a integer) b) a) (find-method #'of-two '() (list (find-class 't)) nil))",
            "!! Methods of #<STANDARD-GENERIC-FUNCTION COMMON-LISP-USER::OF-TWO (1)> have 2 specializers, not 1.",
        ),
        (
            "(progn (defgeneric of-one (a)) (defmethod of-one (a) a) (add-method #'of-two (find-method #'of-one '() (list (find-class 't)))))",
            "!! Methods of #<STANDARD-GENERIC-FUNCTION COMMON-LISP-USER::OF-TWO (1)> have 2 specializers, not 1.",
        ),
    ]);
}
