//! Type specifiers: which are subtypes of which, and what they name.

use super::standard::check;

#[test]
fn subtypes_are_told_where_the_standard_tells_them() {
    let cases = [
        ("symbol", "(or null (and symbol (not null)))", "T T"),
        ("(integer 5 3)", "nil", "T T"),
        ("t", "(or integer (not integer))", "T T"),
        ("(and integer float)", "nil", "T T"),
        ("character", "(or base-char extended-char)", "T T"),
        ("character", "base-char", "T T"),
        ("integer", "(or fixnum bignum)", "T T"),
        ("integer", "fixnum", "NIL T"),
        ("(and rational (not integer))", "ratio", "T T"),
        ("(integer 0 3)", "(member 0 1 2 3 a)", "T T"),
        ("(integer 0 4)", "(member 0 1 2 3 a)", "NIL T"),
        (
            "(integer 0 10)",
            "(or (integer 0 4) (integer 6 10))",
            "NIL T",
        ),
        ("(cons integer t)", "(or (cons number t) null)", "T T"),
        ("(cons number t)", "(cons integer t)", "NIL T"),
        ("(and list (not null))", "cons", "T T"),
        ("(integer (9))", "(integer 10)", "T T"),
        ("(and integer (real -1/2 (3/2)))", "(integer 0 1)", "T T"),
        (
            "(and integer (not (eql 10)))",
            "(or (integer * 9) (integer 11))",
            "T T",
        ),
        ("(and ratio (rational 0 0))", "nil", "T T"),
        ("(not cons)", "atom", "T T"),
        ("(member a b)", "(or (eql a) (eql b))", "T T"),
        ("(satisfies evenp)", "integer", "NIL NIL"),
        ("(and integer (satisfies evenp))", "number", "T T"),
        ("(or string symbol)", "(or symbol vector)", "T T"),
        ("(or string cons)", "(or symbol vector)", "NIL T"),
        ("string", "number", "NIL T"),
        (
            "(array t (2 2))",
            "(or (array t (3 3)) cons symbol number)",
            "NIL T",
        ),
        ("function", "(or symbol number)", "NIL T"),
        ("hash-table", "(or package hash-table)", "T T"),
        ("hash-table", "(not (or package hash-table))", "NIL T"),
    ];
    let forms: Vec<(String, String)> = cases
        .iter()
        .map(|(a, b, expected)| {
            let form = format!("(multiple-value-list (subtypep '{a} '{b}))");
            (form, format!("({expected})"))
        })
        .collect();
    let pairs: Vec<(&str, &str)> = forms
        .iter()
        .map(|(form, expected)| (form.as_str(), expected.as_str()))
        .collect();
    check(&pairs);
}

#[test]
fn names_of_types_stand_for_sequences_and_elements() {
    check(&[
        (
            "(progn (deftype letter () 'character) (deftype word () '(vector letter *)) (list (map 'word #'char-upcase \"ab\") (concatenate 'word \"a\" '(#\\b)) (make-array 2 :element-type 'letter :initial-element #\\x)))",
            "(\"AB\" \"ab\" \"xx\")",
        ),
        (
            "(progn (deftype row (&optional (n '*)) `(vector bit ,n)) (make-sequence 'row 3))",
            "#*000",
        ),
        (
            "(progn (defstruct (ring (:constructor)) a) (ring-a (make-ring :a 1)))",
            "1",
        ),
        (
            "(progn (defconstant +nine+ 9 \"Nine.\") (documentation '+nine+ 'variable))",
            "\"Nine.\"",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (setf (readtable-case *readtable*) :invert) (list (symbol-name (read-from-string \"CupTray\")) (read-from-string \"cup\") (prin1-to-string 'cup) (prin1-to-string '|Cup|)))",
            "(\"CupTray\" CUP \"cup\" \"Cup\")",
        ),
        (
            "(let ((*readtable* (copy-readtable nil))) (setf (readtable-case *readtable*) :downcase) (list (symbol-name (read-from-string \"Cup\")) (let ((*print-case* :capitalize)) (prin1-to-string '|cup|))))",
            "(\"cup\" \"Cup\")",
        ),
        (
            "(typep #'car '(function (t) t))",
            "!! Nothing can be tested for being (FUNCTION (T) T): such a type is for declarations.",
        ),
        (
            "(typep 1 '(or string (values integer)))",
            "!! Nothing can be tested for being (VALUES INTEGER): such a type is for declarations.",
        ),
        (
            "(setf (readtable-case (copy-readtable nil)) :sideways)",
            "!! The value :SIDEWAYS is not of type (MEMBER :UPCASE :DOWNCASE :PRESERVE :INVERT)",
        ),
    ]);
}
