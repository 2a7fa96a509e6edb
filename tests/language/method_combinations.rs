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
            "(define-method-combination with-options (a) ((primary ())) a)",
            "!! The method combination WITH-OPTIONS has parameters; only those without are supported.",
        ),
        (
            "(defgeneric drop (x) (:method-combination picky 1))",
            "!! The method combination PICKY takes no options.",
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
