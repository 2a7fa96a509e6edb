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
