//! Generic functions and the protocol that makes and changes instances.

use super::standard::check;

#[test]
fn methods_of_make_instance_are_for_classes_that_are_named_too() {
    check(&[
        (
            "(progn (defclass lamp () ((watts :initarg :watts)))
                    (defmethod make-instance :around ((class (eql (find-class 'lamp))) &rest initargs)
                      (list :made initargs (type-of (call-next-method))))
                    (list (make-instance 'lamp :watts 5) (make-instance (find-class 'lamp))))",
            "((:MADE (:WATTS 5) LAMP) (:MADE NIL LAMP))",
        ),
        ("(type-of (make-condition 'simple-error))", "SIMPLE-ERROR"),
    ]);
}

#[test]
fn initialization_arguments_of_a_changed_class_are_checked() {
    check(&[
        (
            "(progn (defclass cup () ((size :initarg :size))) (defclass mug (cup) ((ear :initarg :ear)))
                    (slot-value (change-class (make-instance 'cup) 'mug :ear :left) 'ear))",
            ":LEFT",
        ),
        (
            "(change-class (make-instance 'cup) 'mug :eer :left)",
            "!! Invalid initialization argument: :EER in call for class #<STANDARD-CLASS COMMON-LISP-USER::MUG>.",
        ),
        (
            "(change-class (make-instance 'cup) 'mug '(ear) :left)",
            "!! The name of an initialization argument is a symbol, not (EAR).",
        ),
        (
            "(shared-initialize (make-instance 'cup) nil '(size) 1)",
            "!! The name of an initialization argument is a symbol, not (SIZE).",
        ),
        (
            "(progn (defmethod update-instance-for-different-class :after ((old cup) (new mug) &key paint)
                      (setf (slot-value new 'ear) paint))
                    (slot-value (change-class (make-instance 'cup) 'mug :paint :blue) 'ear))",
            ":BLUE",
        ),
    ]);
}

#[test]
fn a_method_belongs_to_one_generic_function() {
    check(&[
        (
            "(progn (defgeneric lifted (x)) (defgeneric pushed (x)) (defmethod lifted ((x integer)) x)
                    (add-method #'pushed (find-method #'lifted '() '(integer))))",
            "!! #<STANDARD-METHOD COMMON-LISP-USER::LIFTED (INTEGER)> belongs to LIFTED; a method can have one generic function only.",
        ),
        (
            "(let ((method (find-method #'lifted '() '(integer))))
               (remove-method #'lifted method) (add-method #'pushed method) (pushed 3))",
            "3",
        ),
        (
            "(let ((method (find-method #'pushed '() '(integer))))
               (list (documentation method t) (setf (documentation method t) \"Pushes.\") (documentation method t)))",
            "(NIL \"Pushes.\" \"Pushes.\")",
        ),
        (
            "(function-keywords (defmethod kept (x &key in (on x) &allow-other-keys) (list x in on)))",
            "(:IN :ON) ; T",
        ),
    ]);
}

#[test]
fn ensure_generic_function_changes_one_that_is_there() {
    check(&[
        (
            "(progn (defgeneric told (a b) (:method ((a integer) b) :first) (:method (a (b integer)) :second))
                    (list (told 1 2)
                          (eq (ensure-generic-function 'told :lambda-list '(a b) :argument-precedence-order '(b a)) #'told)
                          (told 1 2)))",
            "(:FIRST T :SECOND)",
        ),
        (
            "(progn (ensure-generic-function 'told :documentation \"Tells.\") (documentation 'told 'function))",
            "\"Tells.\"",
        ),
        (
            "(ensure-generic-function 'told :lambda-list '(a))",
            "!! The lambda list (A) does not agree with the methods of #<STANDARD-GENERIC-FUNCTION COMMON-LISP-USER::TOLD (2)>.",
        ),
        ("(told 1 2)", ":SECOND"),
        (
            "(ensure-generic-function 'car)",
            "!! CAR is no generic function.",
        ),
    ]);
}

#[test]
fn methods_are_added_to_a_generic_function_that_is_traced() {
    check(&[
        (
            "(progn (defgeneric shape (x)) (defmethod shape ((x integer)) :int) (trace shape)
                    (defmethod shape ((x string)) :text)
                    (list (with-output-to-string (*trace-output*) (shape \"a\")) (progn (untrace shape) (shape \"a\"))))",
            "(\" 0: (SHAPE \\\"a\\\") 0: SHAPE returned :TEXT \" :TEXT)",
        ),
    ]);
}

#[test]
fn the_methods_of_a_generic_function_that_is_traced_are_found() {
    check(&[
        (
            "(progn (defgeneric hue (x)) (defmethod hue ((x integer)) :int) (defmethod hue (x) :any) (trace hue)
                    (list (length (compute-applicable-methods #'hue '(1)))
                          (length (closer-mop:generic-function-methods #'hue))
                          (closer-mop:generic-function-name #'hue)
                          (null (remove-method #'hue (find-method #'hue '() (list (find-class 'integer)))))
                          (progn (untrace hue) (hue 1))))",
            "(2 2 HUE NIL :ANY)",
        ),
    ]);
}
