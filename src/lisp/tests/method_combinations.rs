//! Method combinations that programs define with the long form, and the order of arguments.

use super::standard::check;

#[test]
fn the_long_form_groups_methods_and_makes_the_form_that_calls_them() {
    check(&[
        (
            "(define-method-combination checked ()
               ((around (:around)) (checks (:check)) (primary () :required t))
               (let ((form `(progn ,@(mapcar (lambda (m) `(call-method ,m)) checks)
                                   (call-method ,(first primary) ,(rest primary)))))
                 (if around
                     `(call-method ,(first around) (,@(rest around) (make-method ,form)))
                     form)))",
            "CHECKED",
        ),
        (
            "(defvar *calls* '())
             (defgeneric grip (x) (:method-combination checked))
             (defmethod grip :check ((x integer)) (push :integer *calls*))
             (defmethod grip :check ((x number)) (push :number *calls*))
             (defmethod grip ((x number)) (list :number x))
             (defmethod grip ((x integer)) (list :integer (call-next-method)))
             (defmethod grip :around ((x integer)) (list :around (call-next-method)))
             (list (grip 1) *calls* (grip 2.0))",
            "((:AROUND (:INTEGER (:NUMBER 1))) (:NUMBER :INTEGER) (:NUMBER 2.0))",
        ),
        (
            "(defmethod grip ((x (eql 7))) (list :seven (call-next-method 8))) (grip 7)",
            "(:AROUND (:SEVEN (:INTEGER (:NUMBER 8))))",
        ),
    ]);
}

#[test]
fn groups_have_orders_patterns_and_predicates() {
    check(&[
        (
            "(defun starred (qualifiers) (member '* qualifiers))
             (define-method-combination ordered () ((stars starred) (twos (:two *)) (others * :order :most-specific-last))
               `(list ,@(mapcar (lambda (m) `(call-method ,m)) (append stars twos others))))
             (defgeneric parts (x) (:method-combination ordered))
             (defmethod parts ((x integer)) :integer)
             (defmethod parts (x) :t)
             (defmethod parts :two :three ((x integer)) :two)
             (defmethod parts * (x) :star)
             (parts 1)",
            "(:STAR :TWO :T :INTEGER)",
        ),
    ]);
}

#[test]
fn mistakes_in_method_combinations_are_errors() {
    check(&[
        (
            "(define-method-combination picky () ((primary () :required t)) `(call-method ,(first primary)))
             (defgeneric pick (x) (:method-combination picky))
             (defmethod pick :odd (x) x)
             (handler-case (pick 1) (error () :refused))",
            ":REFUSED",
        ),
        (
            "(defgeneric drop (x) (:method-combination picky 1) (:method (x) x))
             (handler-case (drop 1) (error () :refused))",
            ":REFUSED",
        ),
    ]);
}

#[test]
fn argument_precedence_order_decides_which_method_is_more_specific() {
    check(&[
        (
            "(defgeneric meet (a b) (:argument-precedence-order b a))
             (defmethod meet ((a integer) b) :first)
             (defmethod meet (a (b integer)) :second)
             (meet 1 1)",
            ":SECOND",
        ),
        (
            "(defgeneric miss (a b) (:argument-precedence-order b))",
            "!! The order (B) does not name each of the required parameters (A B) once.",
        ),
    ]);
}

#[test]
fn base_strings_are_strings() {
    check(&[
        ("(typep \"abc\" 'simple-base-string)", "T"),
        ("(coerce '(#\\a #\\b) 'base-string)", "\"ab\""),
    ]);
}

#[test]
fn combinations_have_parameters_and_see_arguments() {
    check(&[
        (
            "(define-method-combination announced (label &optional (order :most-specific-first))
               ((all () :order order))
               (:arguments item &optional (count 1 counted))
               (:generic-function function)
               `(list ,label ,item ,count ,counted ',(functionp function)
                      ,@(mapcar (lambda (m) `(call-method ,m)) all)))",
            "ANNOUNCED",
        ),
        (
            "(defgeneric pour (x &optional y z) (:method-combination announced \"pouring\")
               (:method ((x integer) &optional y z) (list :integer x y z))
               (:method ((x number) &optional y z) (declare (ignore y z)) :number))
             (list (pour 1) (pour 1 5))",
            "((\"pouring\" 1 1 NIL T (:INTEGER 1 NIL NIL) :NUMBER) (\"pouring\" 1 5 T T (:INTEGER 1 5 NIL) :NUMBER))",
        ),
        (
            "(defgeneric serve (x) (:method-combination announced :serving :most-specific-last)
               (:method ((x integer)) :integer)
               (:method ((x number)) :number))
             (serve 2)",
            "(:SERVING 2 1 NIL T :NUMBER :INTEGER)",
        ),
        (
            "(define-method-combination announced (label) ((all ())) `(list ,label ,(length all)))
             (list (pour 1) (handler-case (serve 2) (error () :refused)))",
            "((\"pouring\" 2) :REFUSED)",
        ),
    ]);
}
