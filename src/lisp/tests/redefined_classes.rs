//! What stays and what changes when a class is defined anew.

use super::standard::check;

#[test]
fn methods_for_an_instance_see_its_class_defined_anew() {
    check(&[(
        "(defclass left () ())
         (defclass right () ())
         (defclass both (left right) ())
         (defvar *both* (make-instance 'both))
         (defgeneric side (x))
         (defmethod side ((x left)) :left)
         (defmethod side ((x right)) :right)
         (defmethod side ((x (eql *both*))) (list (call-next-method)))
         (list (side *both*) (progn (defclass both (right left) ()) (side *both*)))",
        "((:LEFT) (:RIGHT))",
    )]);
}

#[test]
fn shared_slots_keep_their_values() {
    check(&[
        (
            "(defclass shelf () ((load :initform 1 :allocation :class)))
             (defvar *shelf* (make-instance 'shelf))
             (defclass shelf () ((load :initform 2 :allocation :class) (depth :initform 7)))
             (list (slot-value *shelf* 'load) (slot-value *shelf* 'depth))",
            "(1 7)",
        ),
        (
            "(defclass shelf () ((load :initform 3)))
             (slot-value *shelf* 'load)",
            "1",
        ),
        (
            "(defclass shelf () ((load :initform 5 :allocation :class)))
             (slot-value *shelf* 'load)",
            "5",
        ),
    ]);
}

#[test]
fn instances_that_were_made_obsolete_are_updated_once() {
    check(&[
        (
            "(defclass urn () ((size :initform 2))) (defclass vase (urn) ()) (defvar *updated* nil) (defmethod update-instance-for-redefined-class :after ((u urn) added lost plist &key) (declare (ignore plist)) (push (list (type-of u) added lost) *updated*)) (defvar *urn* (make-instance 'urn)) (defvar *vase* (make-instance 'vase)) (make-instances-obsolete 'urn)",
            "URN",
        ),
        (
            "(list (slot-value *urn* 'size) (slot-value *urn* 'size) (slot-value *vase* 'size) *updated*)",
            "(2 2 2 ((VASE NIL NIL) (URN NIL NIL)))",
        ),
        (
            "(handler-case (make-instances-obsolete 7) (type-error (e) (type-error-datum e)))",
            "7",
        ),
    ]);
}

#[test]
fn describe_calls_methods_for_instances() {
    check(&[
        (
            "(defclass jar () ()) (defclass lid () ()) (defmethod describe-object ((j jar) stream) (format stream \"a jar~%\")) (with-output-to-string (*standard-output*) (describe (make-instance 'jar)))",
            "\"a jar \"",
        ),
        (
            "(let ((told (with-output-to-string (s) (describe (make-instance 'lid) s)))) (list (not (search \"jar\" told)) (and (search \"of type LID\" told) t)))",
            "(T T)",
        ),
        (
            "(multiple-value-list (let ((*standard-output* (make-broadcast-stream))) (describe (make-instance 'jar))))",
            "NIL",
        ),
    ]);
}
