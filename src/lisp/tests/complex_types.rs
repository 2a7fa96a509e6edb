//! Types of complex numbers, zeros with signs, and characters.

use super::standard::check;

#[test]
fn the_parts_of_complex_numbers_have_the_type_that_a_specifier_says() {
    check(&[
        ("(typep #c(1.0 2.0) '(complex integer))", "NIL"),
        ("(typep #c(1 2) '(complex integer))", "T"),
        ("(typep #c(1/2 2) '(complex integer))", "NIL"),
        (
            "(typep #c(1d0 2d0) '(or (complex single-float) (complex rational)))",
            "NIL",
        ),
        ("(type-of #c(2 1))", "(COMPLEX (INTEGER 1 2))"),
        ("(type-of #c(1/2 2))", "(COMPLEX (RATIONAL 1/2 2))"),
        (
            "(type-of #c(1.0 -0.0))",
            "(COMPLEX (SINGLE-FLOAT -0.0 1.0))",
        ),
        (
            "(subtypep '(complex bit) '(complex (integer 5 6)))",
            "NIL ; T",
        ),
        (
            "(subtypep '(complex rational) '(complex integer))",
            "NIL ; T",
        ),
        (
            "(subtypep 'complex '(or (complex rational) (complex float)))",
            "T ; T",
        ),
        ("(subtypep '(complex (integer 0 0)) nil)", "T ; T"),
        (
            "(nth-value 1 (subtypep '(complex (or (integer 1 2) (integer 5 6))) '(or (complex (integer 1 2)) (complex (integer 5 6)))))",
            "NIL",
        ),
        (
            "(typep 1 '(complex string))",
            "!! STRING is no type of parts of complex numbers, which are real.",
        ),
    ]);
}

#[test]
fn complex_numbers_of_floats_keep_signs_and_digits() {
    check(&[
        ("(complex -1.0)", "#C(-1.0 0.0)"),
        ("(signum #c(0.0 -0.0))", "#C(0.0 -0.0)"),
        ("(sqrt -4)", "#C(0.0 2.0)"),
        ("(sqrt #c(-4.0 -0.0))", "#C(0.0 -2.0)"),
        ("(sqrt #c(1d0 1d-10))", "#C(1.0d0 5.0d-11)"),
        ("(realpart (sqrt most-negative-double-float))", "0.0d0"),
        (
            "(= (imagpart (sqrt most-negative-double-float)) (sqrt most-positive-double-float))",
            "T",
        ),
        ("(imagpart (log #c(-1.0 -0.0)))", "-3.1415927"),
        ("(imagpart (log -1.0))", "3.1415927"),
    ]);
}

#[test]
fn a_range_that_ends_at_zero_has_both_zeros() {
    check(&[
        (
            "(subtypep '(single-float 0.0) '(or (single-float (0.0)) (member 0.0)))",
            "NIL ; T",
        ),
        (
            "(subtypep '(single-float 0.0) '(or (single-float (0.0)) (member 0.0 -0.0)))",
            "T ; T",
        ),
        ("(subtypep '(double-float 0d0 0d0) '(eql 0d0))", "NIL ; T"),
        ("(subtypep '(eql -0.0) '(single-float 0.0))", "T ; T"),
    ]);
}

#[test]
fn all_characters_are_base_characters() {
    check(&[
        ("(subtypep 'character 'base-char)", "T ; T"),
        ("(subtypep 'extended-char nil)", "T ; T"),
        ("(typep (code-char 228) 'base-char)", "T"),
        (
            "(list (upgraded-array-element-type 'base-char) (array-element-type (make-string 1 :element-type 'base-char)))",
            "(CHARACTER CHARACTER)",
        ),
        (
            "(mapcar #'upgraded-array-element-type '((eql 1) (member 1 3) (member #\\a) (or bit (integer 5 9)) symbol (integer 0)))",
            "(BIT (UNSIGNED-BYTE 2) CHARACTER (UNSIGNED-BYTE 4) T T)",
        ),
    ]);
}

#[test]
fn errors_of_sequence_types_tell_what_was_wrong() {
    let wrong = |form: &str| {
        format!(
            "(handler-case {form} (type-error (e) (list (type-error-datum e) (type-error-expected-type e))))"
        )
    };
    check(&[
        (
            &wrong("(map '(or (vector t 5) (vector t 10)) #'identity '(1))"),
            "((OR (VECTOR T 5) (VECTOR T 10)) (MEMBER LIST VECTOR STRING))",
        ),
        (&wrong("(map '(vector t 3) #'identity '(1))"), "(1 (EQL 3))"),
        (&wrong("(map 'list #'identity 5)"), "(5 SEQUENCE)"),
    ]);
}

#[test]
fn the_type_of_an_array_is_a_plain_specifier() {
    check(&[
        ("(type-of (make-array 3 :adjustable t))", "(VECTOR T 3)"),
        (
            "(type-of (make-array '(2 2) :adjustable t))",
            "(ARRAY T (2 2))",
        ),
    ]);
}
