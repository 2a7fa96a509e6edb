//! Types as programs see them.

use crate::object::testing::{assert_value, error_class, image};

#[test]
fn type_specifiers_may_be_defined_with_arguments() {
    let mut image = image();
    assert_value(
        &mut image,
        "(deftype within (low &optional high) `(integer ,low ,high))
         (deftype near () '(or (within 0 3) (member :here)))
         (list (typep 5 '(within 1)) (typep 5 '(within 1 4)) (typep :here 'near) (typep 3 'near) (typep 4 'near))",
        "(t nil t t nil)",
    );
}

#[test]
fn subtypep_answers_with_certainty_where_it_can() {
    let mut image = image();
    assert_value(
        &mut image,
        "(mapcar (lambda (pair) (multiple-value-list (subtypep (first pair) (second pair))))
           '(((integer 0 5) (integer 0 10)) ((integer 0 10) (or (integer 0 4) (integer 5 20)))
             ((member a b) symbol) ((satisfies foo) integer) (cons list) ((not list) atom)
             (string vector) ((and integer (not fixnum)) bignum) ((or null cons) list) (list (or null cons))
             ((vector t 3) (vector t)) (single-float real) (fixnum (integer 0))))",
        "((t t) (t t) (t t) (nil nil) (t t) (t t) (t t) (t t) (t t) (t t) (t t) (t t) (nil t))",
    );
}

#[test]
fn coercion_goes_between_numbers_sequences_and_characters() {
    let mut image = image();
    assert_value(
        &mut image,
        "(list (coerce 1/2 'double-float) (coerce '(1 2) 'vector) (coerce #(1 2) 'list)
           (coerce '(#\\a #\\b) 'string) (coerce \"a\" 'character) (funcall (coerce 'car 'function) '(7)))",
        "(0.5d0 #(1 2) (1 2) \"ab\" #\\a 7)",
    );
    let text = "(coerce \"abc\" 'integer)";
    assert_eq!(error_class(&mut image, text), "SIMPLE-TYPE-ERROR");
}

#[test]
fn subtypep_knows_nothing_of_undefined_types() {
    let mut image = image();
    let text = "(multiple-value-list (subtypep 'no-such-type 'integer))";
    assert_value(&mut image, text, "(nil nil)");
    assert_eq!(
        error_class(&mut image, "(typep 1 'no-such-type)"),
        "SIMPLE-ERROR"
    );
}

#[test]
fn usual_questions_of_subtypep_have_certain_answers() {
    let mut image = image();
    assert_value(
        &mut image,
        "(remove-if (lambda (pair) (equal (multiple-value-list (subtypep (first pair) (second pair))) '(t t)))
           '((cons list) (string sequence) ((member 1 2) integer) (bit fixnum) (standard-char character)
             (symbol atom) (simple-vector vector) (base-char character) (function atom) (hash-table t)
             ((not integer) (not fixnum)) (boolean symbol) (ratio rational) (error condition) (nil nil)
             (integer (or integer string)) ((integer 1 5) fixnum) (null list) (t t) (float real)
             (simple-string string) ((string 3) string) ((eql 5) (integer 0 10)) (keyword (not list))))",
        "()",
    );
    assert_value(
        &mut image,
        "(remove-if (lambda (pair) (equal (multiple-value-list (subtypep (first pair) (second pair))) '(nil t)))
           '((list cons) (float integer) (character string) (t integer) (integer fixnum) (symbol keyword)
             (number real) (list (or cons string)) ((integer 0 10) (integer 0 5)) (atom list)))",
        "()",
    );
}

#[test]
fn type_of_is_as_specific_as_in_sbcl() {
    let mut image = image();
    assert_value(
        &mut image,
        "(mapcar #'type-of (list 1 5 -5 1.5 1/2 nil t 'a :a #\\a '(1) #(1 2) \"abc\" #*101 (expt 2 70)))",
        "(bit (integer 0 4611686018427387903) fixnum single-float ratio null boolean symbol keyword
          standard-char cons (simple-vector 2) (simple-array character (3)) (simple-bit-vector 3)
          (integer 4611686018427387904))",
    );
}
