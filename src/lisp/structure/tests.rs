//! Structures as programs see them.

use crate::object::testing::{assert_value, error_class, eval_values, image};

#[test]
fn structures_may_include_others() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defstruct animal name (legs 4))
         (defstruct (bird (:include animal (legs 2)) (:conc-name b-)) (song \"tweet\"))
         (let ((b (make-bird :name 1)))
           (list (animal-legs b) (b-legs b) (b-song b) (animal-p b) (bird-p (make-animal))))",
        "(2 2 \"tweet\" t nil)",
    );
}

#[test]
fn structure_slots_keep_their_types_and_may_be_read_only() {
    let mut image = image();
    eval_values(
        &mut image,
        "(defstruct spot (x 0 :type integer) (y 0 :read-only t))",
    )
    .expect("defined");
    assert_eq!(
        error_class(&mut image, "(make-spot :x \"a\")"),
        "TYPE-ERROR"
    );
    let text = "(setf (spot-x (make-spot)) 1.5)";
    assert_eq!(error_class(&mut image, text), "TYPE-ERROR");
    let text = "(setf (spot-y (make-spot)) 1)";
    assert_eq!(error_class(&mut image, text), "UNDEFINED-FUNCTION");
}

#[test]
fn constructors_by_order_take_defaults_of_slots() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defstruct (box (:constructor box (a &optional b (c 3) &rest more &key (d 4) &aux e))) a (b 2) c more d e)
         (let ((x (box 1))) (list (box-a x) (box-b x) (box-c x) (box-d x)))",
        "(1 2 3 4)",
    );
}

#[test]
fn structures_may_be_vectors_with_gaps() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defstruct (v (:type vector) :named (:initial-offset 1)) a (b 2))
         (defstruct (w (:type vector) (:include v (b 3))) c)
         (let ((x (make-v :a 1)) (y (make-w :c 9)))
           (setf (v-a x) 5)
           (list x (v-p x) (v-p 1) y (w-c y)))",
        "(#(nil v 5 2) t nil #(nil v nil 3 9) 9)",
    );
}
