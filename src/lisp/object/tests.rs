//! The object system as programs see it.

use super::testing::{assert_value, error_class, eval_values, image};

#[test]
fn initargs_come_before_default_initargs_and_those_before_initforms() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :initarg :x :initform 1) (y :initarg :y :initform 2) (z :initform 3))
           (:default-initargs :y 20))
         (defun all (a) (with-slots (x y z) a (list x y z)))
         (list (all (make-instance 'a)) (all (make-instance 'a :x 10 :y 30)))",
        "((1 20 3) (10 30 3))",
    );
}

#[test]
fn initforms_are_evaluated_for_each_instance() {
    let mut image = image();
    assert_value(
        &mut image,
        "(let ((n 0)) (defclass counted () ((id :initform (incf n) :reader id)))
           (list (id (make-instance 'counted)) (id (make-instance 'counted))))",
        "(1 2)",
    );
}

#[test]
fn class_slots_are_shared() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((n :allocation :class :initform 0 :accessor n)))
         (let ((x (make-instance 'a)) (y (make-instance 'a))) (setf (n x) 5) (list (n x) (n y)))",
        "(5 5)",
    );
}

#[test]
fn a_redefined_class_updates_its_instances_when_they_are_used() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :initform 1) (y :initform 2)))
         (defparameter *a* (make-instance 'a))
         (setf (slot-value *a* 'y) 20)
         (defclass a () ((z :initform (list 3)) (y :initform 0)))
         (list (slot-value *a* 'z) (slot-value *a* 'y) (slot-exists-p *a* 'x))",
        "((3) 20 nil)",
    );
}

#[test]
fn redefining_a_superclass_updates_instances_of_its_subclasses() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ()) (defclass b (a) ((y :initform 1)))
         (defparameter *b* (make-instance 'b))
         (defclass a () ((x :initform 7 :reader x)))
         (list (x *b*) (slot-value *b* 'y))",
        "(7 1)",
    );
}

#[test]
fn update_instance_for_redefined_class_gets_what_was_lost() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :initform 4)))
         (defparameter *a* (make-instance 'a))
         (defclass a () ((y :accessor y)))
         (defmethod update-instance-for-redefined-class :after ((a a) added lost plist &key)
           (setf (y a) (list added lost (getf plist 'x))))
         (y *a*)",
        "((y) (x) 4)",
    );
}

#[test]
fn a_class_may_be_named_as_superclass_before_it_is_defined() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass b (a) ())
         (defclass a () ((x :initform 1)))
         (slot-value (make-instance 'b) 'x)",
        "1",
    );
    let early = "(defclass d (c) ()) (make-instance 'd)";
    assert_eq!(error_class(&mut image, early), "SIMPLE-ERROR");
}

#[test]
fn contradicting_superclass_orders_are_an_error() {
    let mut image = image();
    let text = "(defclass a () ()) (defclass b () ()) (defclass ab (a b) ()) (defclass ba (b a) ())
                (defclass abba (ab ba) ())";
    assert_eq!(error_class(&mut image, text), "SIMPLE-ERROR");
}

#[test]
fn a_class_cannot_be_its_own_superclass() {
    let mut image = image();
    let text = "(defclass a () ()) (defclass b (a) ()) (defclass a (b) ())";
    assert_eq!(error_class(&mut image, text), "SIMPLE-ERROR");
}

#[test]
fn methods_run_around_before_primary_after() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ()) (defclass b (a) ())
         (defparameter *log* nil)
         (defun note (x) (push x *log*) x)
         (defgeneric f (x))
         (defmethod f ((x a)) (note :a))
         (defmethod f ((x b)) (note :b) (call-next-method))
         (defmethod f :before ((x a)) (note :before-a))
         (defmethod f :before ((x b)) (note :before-b))
         (defmethod f :after ((x a)) (note :after-a))
         (defmethod f :after ((x b)) (note :after-b))
         (defmethod f :around ((x a)) (note :around) (call-next-method))
         (list (f (make-instance 'b)) (reverse *log*))",
        "(:a (:around :before-b :before-a :b :a :after-a :after-b))",
    );
}

#[test]
fn call_next_method_without_arguments_passes_the_original_ones() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric f (x y) (:method (x y) (list x y))
           (:method ((x integer) y) (setq y 0) (list (call-next-method) (call-next-method 7 8))))
         (f 1 2)",
        "((1 2) (7 8))",
    );
}

#[test]
fn call_next_method_can_be_passed_on_as_a_function() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric f (x) (:method (x) (list :any x))
           (:method ((x integer)) (mapcar #'call-next-method (list x 5))))
         (f 1)",
        "((:any 1) (:any 5))",
    );
}

#[test]
fn call_next_method_is_found_behind_macros() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defmacro next () '(call-next-method))
         (defgeneric f (x) (:method (x) :any) (:method ((x integer)) (list (next))))
         (f 1)",
        "(:any)",
    );
}

#[test]
fn there_may_be_no_next_method() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defmethod f ((x integer)) (next-method-p)) (f 1)",
        "nil",
    );
    let text = "(defmethod g ((x integer)) (call-next-method)) (g 1)";
    assert_eq!(error_class(&mut image, text), "NO-NEXT-METHOD-ERROR");
}

#[test]
fn eql_specializers_come_before_classes() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric f (x y)
           (:method ((x symbol) (y (eql :cup))) (list :cup (call-next-method)))
           (:method ((x (eql :left)) y) (list :left (call-next-method)))
           (:method (x y) :any))
         (list (f :left :cup) (f :right :cup) (f :left 1) (f 1 1))",
        "((:left (:cup :any)) (:cup :any) (:left :any) :any)",
    );
}

#[test]
fn methods_may_be_added_and_replaced_after_calls() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric f (x)) (defmethod f (x) 1)
         (list (f 5) (progn (defmethod f ((x integer)) 2) (f 5)) (progn (defmethod f ((x integer)) 3) (f 5)))",
        "(1 2 3)",
    );
}

#[test]
fn methods_may_be_removed() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric f (x) (:method (x) 1) (:method ((x integer)) 2))
         (f 1)
         (remove-method #'f (find-method #'f '() (list (find-class 'integer))))
         (f 1)",
        "1",
    );
}

#[test]
fn setf_functions_may_be_generic() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :accessor x)))
         (defmethod (setf doubled) (value (a a)) (setf (x a) (* 2 value)))
         (let ((a (make-instance 'a))) (list (setf (doubled a) 4) (x a)))",
        "(8 8)",
    );
}

#[test]
fn operators_combine_the_values_of_all_methods() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ()) (defclass b (a) ())
         (defgeneric all (x) (:method-combination list)
           (:method list ((x a)) :a) (:method list ((x b)) :b))
         (defgeneric last-first (x) (:method-combination list :most-specific-last)
           (:method list ((x a)) :a) (:method list ((x b)) :b))
         (defgeneric any (x) (:method-combination or)
           (:method or ((x a)) :a) (:method or ((x b)) nil))
         (let ((b (make-instance 'b))) (list (all b) (last-first b) (any b)))",
        "((:b :a) (:a :b) :a)",
    );
}

#[test]
fn generic_functions_check_keywords_against_all_applicable_methods() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric f (x &key) (:method (x &key a) (list a))
           (:method ((x integer) &key b) (list b (call-next-method))))
         (f 1 :a 2 :b 3)",
        "(3 (2))",
    );
    assert_eq!(
        error_class(&mut image, "(f 1 :c 2)"),
        "SIMPLE-PROGRAM-ERROR"
    );
    assert_eq!(
        error_class(&mut image, "(f \"s\" :b 2)"),
        "SIMPLE-PROGRAM-ERROR"
    );
}

#[test]
fn wrong_numbers_of_arguments_are_program_errors() {
    let mut image = image();
    eval_values(&mut image, "(defgeneric f (x) (:method (x) x))").expect("defined");
    assert_eq!(error_class(&mut image, "(f)"), "SIMPLE-PROGRAM-ERROR");
    assert_eq!(error_class(&mut image, "(f 1 2)"), "SIMPLE-PROGRAM-ERROR");
}

#[test]
fn methods_must_agree_with_their_generic_function() {
    let mut image = image();
    eval_values(&mut image, "(defgeneric f (x &optional y))").expect("defined");
    for wrong in [
        "(defmethod f (x) x)",
        "(defmethod f (x z &optional y) x)",
        "(defmethod f (x &optional y &key k) x)",
    ] {
        assert_eq!(
            error_class(&mut image, wrong),
            "SIMPLE-PROGRAM-ERROR",
            "{wrong}"
        );
    }
}

#[test]
fn a_function_does_not_become_generic_by_itself() {
    let mut image = image();
    let text = "(defun f (x) x) (defmethod f ((x integer)) x)";
    assert_eq!(error_class(&mut image, text), "SIMPLE-PROGRAM-ERROR");
}

#[test]
fn initialization_may_be_extended() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :initarg :x :accessor x)))
         (defclass b (a) ())
         (defmethod initialize-instance :around ((a a) &rest args &key (extra 0) &allow-other-keys)
           (apply #'call-next-method a :x extra args))
         (defmethod shared-initialize :after ((b b) slots &key) (setf (x b) (list (x b) slots)))
         (list (x (make-instance 'a :extra 3)) (x (make-instance 'b)))",
        "(3 (0 t))",
    );
}

#[test]
fn make_instance_rejects_unknown_initargs() {
    let mut image = image();
    eval_values(&mut image, "(defclass a () ())").expect("defined");
    assert_eq!(
        error_class(&mut image, "(make-instance 'a :x 1)"),
        "SIMPLE-PROGRAM-ERROR"
    );
    assert_value(
        &mut image,
        "(class-name (class-of (make-instance 'a :x 1 :allow-other-keys t)))",
        "a",
    );
}

#[test]
fn change_class_keeps_slots_of_the_same_name() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :initform 1) (y :initform 2)))
         (defclass b () ((y :initform 0) (z :initarg :z :initform 3)))
         (let ((a (make-instance 'a)))
           (change-class a 'b :z 9)
           (list (class-name (class-of a)) (slot-value a 'y) (slot-value a 'z) (slot-exists-p a 'x)))",
        "(b 2 9 nil)",
    );
}

#[test]
fn unbound_and_missing_slots_may_be_provided_for() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defclass a () ((x :reader x)))
         (defmethod slot-unbound (class (a a) name) (list :unbound name))
         (defmethod slot-missing (class (a a) name operation &optional new) (list :missing name operation))
         (let ((a (make-instance 'a))) (list (x a) (slot-value a 'x) (slot-value a 'q)))",
        "((:unbound x) (:unbound x) (:missing q slot-value))",
    );
}

#[test]
fn classes_of_builtin_values_specialize_methods() {
    let mut image = image();
    assert_value(
        &mut image,
        "(defgeneric kind (x)
           (:method ((x integer)) :integer) (:method ((x float)) :float) (:method ((x string)) :string)
           (:method ((x null)) :null) (:method ((x keyword)) :keyword) (:method ((x symbol)) :symbol)
           (:method ((x cons)) :cons) (:method ((x vector)) :vector) (:method ((x function)) :function)
           (:method ((x character)) :character) (:method ((x condition)) :condition) (:method (x) :other))
         (mapcar #'kind (list 1 1.5 \"s\" nil :k 'a '(1) #(1) #'car #\\a (make-condition 'error)))",
        "(:integer :float :string :null :keyword :symbol :cons :vector :function :character :condition)",
    );
}

#[test]
fn conditions_have_slots_readers_and_defaults() {
    let mut image = image();
    assert_value(
        &mut image,
        "(define-condition lost (error) ((what :initarg :what :initform (list :cup) :reader what)
                                         (where :initarg :where :reader where))
           (:default-initargs :where (+ 1 1)))
         (handler-case (error 'lost) (lost (c) (list (what c) (where c))))",
        "((:cup) 2)",
    );
}

#[test]
fn programs_define_method_combinations_of_their_own() {
    let mut image = image();
    assert_value(
        &mut image,
        "(define-method-combination join :operator append :identity-with-one-argument t)
         (defgeneric parts (x) (:method-combination join)
           (:method join ((x integer)) (list :integer)) (:method join (x) (list :any)))
         (list (parts 1) (parts 'a))",
        "((:integer :any) (:any))",
    );
}

#[test]
fn accessors_of_slots_that_are_gone_are_removed() {
    let mut image = image();
    let text = "(defclass a () ((x :initform 1 :reader x)))
                (defparameter *a* (make-instance 'a))
                (defclass a () ((y :initform 1 :reader y)))";
    eval_values(&mut image, text).expect("defined");
    assert_value(&mut image, "(y *a*)", "1");
    assert_eq!(
        error_class(&mut image, "(x *a*)"),
        "NO-APPLICABLE-METHOD-ERROR"
    );
}
