//! Printing values that the reader has read.

use super::test_image;
use super::*;
use crate::reader::{ReadError, Reader};
use crate::value::known;

fn read(image: &mut Image, text: &str) -> Result<Value, ReadError> {
    let mut reader = Reader::of_text(text);
    Ok(reader
        .next_form(image)?
        .map_or(Value::NIL, |(value, _)| value))
}

fn printed(image: &mut Image, text: &str, escape: bool) -> String {
    match read(image, text) {
        Ok(value) => to_string(image, &value, escape),
        Err(error) => error.to_string(),
    }
}

/// Texts that print unchanged.
#[test]
fn the_reader_s_notation_prints_back() {
    let mut image = test_image::image();
    for text in [
        "NIL",
        "T",
        "FOO",
        ":KEY",
        "|foo Bar|",
        "|a\\|b|",
        "||",
        "#:G",
        "1+",
        "-",
        "//",
        "+1+",
        "|1|",
        "|1E|",
        "|1.2.3|",
        "|1/2/3|",
        "|.5.|",
        "...A",
        "|...|",
        "|.|",
        "|a;b|",
        "|#A|",
        "A#",
        "1",
        "-7",
        "12345678901234567890",
        "-3/2",
        "1.5",
        "-0.15",
        "1.0e10",
        "0.001",
        "1.0e-4",
        "1234567.0",
        "1.2345678e7",
        "0.33333334",
        "1.0d0",
        "-1.447d0",
        "1.0d10",
        "1.0d-5",
        "-0.0",
        "0.7071067811865475d0",
        "4.940656458412465d-324",
        "1.4012985e-45",
        "\"a\\\"b\\\\c\"",
        "#\\a",
        "#\\ ",
        "#\\Newline",
        "#\\(",
        "(A B . C)",
        "((A . 1) (B . 2))",
        "'X",
        "#'CAR",
        "''A",
        "`(A ,B ,@C)",
        "`(A . ,B)",
        "`(A `(B ,,C))",
        "#(1 #(2) \"x\")",
        "#()",
        "#2A((1 2) (3 4))",
        "#0A7",
        "#*1011",
        "(QUOTE)",
        "(QUOTE A B)",
        "(NIL . NIL)",
        "#3A(((1) (2)))",
        "`(A ,'B)",
        "`#(1 ,X)",
    ] {
        let expected = if text == "(NIL . NIL)" { "(NIL)" } else { text };
        assert_eq!(printed(&mut image, text, true), expected);
    }
}

#[test]
fn princ_prints_for_people() {
    let mut image = test_image::image();
    assert_eq!(
        printed(&mut image, "(a \"b\" #\\c :d |e f| #:g cl-user::x)", false),
        "(A b c D e f G X)"
    );
}

#[test]
fn symbols_of_other_packages_have_a_prefix() {
    let mut image = test_image::image();
    image.packages.make("MY-PKG", &[]);
    assert_eq!(printed(&mut image, "my-pkg::x", true), "MY-PKG::X");
    assert_eq!(printed(&mut image, "system:report", true), "SYSTEM:REPORT");
    image.set_special(
        known::V_PACKAGE,
        Value::Package(image.packages.find("MY-PKG").unwrap()),
    );
    assert_eq!(
        printed(&mut image, "cl-user::x", true),
        "COMMON-LISP-USER::X"
    );
    assert_eq!(printed(&mut image, "cl:car", true), "COMMON-LISP:CAR");
}

#[test]
fn printer_variables_are_honoured() {
    let mut image = test_image::image();
    let forms = [
        (known::V_PRINT_BASE, Value::Int(16), "255", "FF"),
        (known::V_PRINT_RADIX, Value::T, "5", "5."),
        (
            known::V_PRINT_LENGTH,
            Value::Int(2),
            "(1 2 3 4)",
            "(1 2 ...)",
        ),
        (known::V_PRINT_LENGTH, Value::Int(0), "(1 2 3 4)", "(...)"),
        (
            known::V_PRINT_LENGTH,
            Value::Int(4),
            "(1 2 3 4)",
            "(1 2 3 4)",
        ),
        (
            known::V_PRINT_LEVEL,
            Value::Int(1),
            "(1 (2) #(3))",
            "(1 # #)",
        ),
        (known::V_PRINT_LEVEL, Value::Int(0), "(1)", "#"),
        (
            known::V_PRINT_LEVEL,
            Value::Int(2),
            "(1 (2 (3)))",
            "(1 (2 #))",
        ),
        (known::V_PRINT_PRETTY, Value::NIL, "'a", "(QUOTE A)"),
        (known::V_PRINT_GENSYM, Value::NIL, "#:foo", "FOO"),
        (
            known::V_PRINT_CIRCLE,
            Value::T,
            "#1=(1 2 . #1#)",
            "#1=(1 2 . #1#)",
        ),
        (
            known::V_PRINT_CIRCLE,
            Value::T,
            "(#1=(1) #1#)",
            "(#1=(1) #1#)",
        ),
        (
            known::V_READ_DEFAULT_FLOAT_FORMAT,
            known::DOUBLE_FLOAT.into(),
            "(1.5 1.5f0 1f10)",
            "(1.5 1.5f0 1.0f10)",
        ),
    ];
    for (variable, value, text, expected) in forms {
        let before = image.special(variable).clone();
        image.set_special(variable, value);
        assert_eq!(printed(&mut image, text, true), expected);
        image.set_special(variable, before);
    }
    image.set_special(known::V_PRINT_CASE, known::K_DOWNCASE.into());
    assert_eq!(
        printed(&mut image, "(foo :bar |X y|)", true),
        "(foo :bar |X y|)"
    );
    image.set_special(known::V_PRINT_CASE, known::K_CAPITALIZE.into());
    assert_eq!(printed(&mut image, "foo-bar", true), "Foo-Bar");
}

#[test]
fn circles_are_safe_even_without_print_circle() {
    let mut image = test_image::image();
    assert_eq!(printed(&mut image, "#1=(a #1# b)", true), "#1=(A #1# B)");
    assert_eq!(printed(&mut image, "(#1=(a) #1#)", true), "((A) (A))");
}

#[test]
fn deep_structures_need_no_stack() {
    let mut image = test_image::image();
    let depth = 100_000;
    let text = format!("{}A{}", "(".repeat(depth), ")".repeat(depth));
    let value = read(&mut image, &text).unwrap();
    assert_eq!(to_string(&image, &value, true), text);
}

#[test]
fn long_lists_are_filled() {
    let mut image = test_image::image();
    let numbers: Vec<String> = (100..=120).map(|i| i.to_string()).collect();
    assert_eq!(
        printed(&mut image, &format!("({})", numbers.join(" ")), true),
        "(100 101 102 103 104 105 106 107 108 109 110 111 112 113 114 115 116 117 118\n 119 120)"
    );
    let pose = "(:FRAME \"map\" :POSITION (0.1 0.2 0.3) :ORIENTATION (0.0 0.0 -0.7071 0.7071)\n :STAMP 0.0)";
    assert_eq!(printed(&mut image, pose, true), pose);
}

#[test]
fn code_is_indented() {
    let mut image = test_image::image();
    for code in [
        "(DEFUN FOO (X Y)\n  (LET ((Z (+ X Y)))\n    (IF (> Z 10)\n        (PRINT \"big\")\n        (PRINT \"small\"))\n    Z))",
        "(LET ((A 1) (B 2))\n  (PRINT A)\n  B)",
        "(DEFUN FOO (X Y) (+ X Y))",
        "(IF A\n    B\n    NIL)",
        "(LOOP REPEAT 3\n      COLLECT 3)",
        "(SETF A 1)",
        "(SETF A 1\n      B 2)",
        "(PROGN A B)",
        "(FLET ((F (X)\n         (+ X 1)))\n  (F 2))",
        "(LAMBDA (X) (* X X))",
        "(DOLIST (X '(1 2)) (PRINT X))",
    ] {
        assert_eq!(printed(&mut image, code, true), code);
    }
}
