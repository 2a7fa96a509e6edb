//! Control strings with arguments as the reader reads them, and the text that comes out.

use super::super::test_image;
use super::*;
use crate::reader::Reader;

fn format(control: &str, args: &str) -> String {
    let mut image = test_image::image();
    let mut reader = Reader::of_text(args);
    let mut values = Vec::new();
    while let Ok(Some((value, _))) = reader.next_form(&mut image) {
        values.push(value);
    }
    match format_to_string(&image, control, &values) {
        Ok(text) => text,
        Err(raise) => match raise.as_ref() {
            Raise::Make {
                report: Some(report),
                ..
            } => report.clone(),
            Raise::Make { class, .. } => image.name(*class).to_owned(),
            Raise::Condition { .. } => "a condition".to_owned(),
        },
    }
}

/// Control, arguments, text.
const CASES: &[(&str, &str, &str)] = &[
    ("", "", ""),
    ("~a ~s", "#\\a #\\a", "a #\\a"),
    ("~10a|", "\"abc\"", "abc       |"),
    ("~10@a|", "\"abc\"", "       abc|"),
    ("~8,,,'*a|", "\"abc\"", "abc*****|"),
    ("~:s", "nil", "()"),
    ("~5,'0d", "42", "00042"),
    ("~@:d", "12345", "+12,345"),
    ("~,,'.:d", "1234567", "1.234.567"),
    ("~10,' ,',,3:d|", "1234567", " 1,234,567|"),
    ("~:x", "65535", "F,FFF"),
    ("~,,' ,4:b", "255", "1111 1111"),
    ("~36r", "35", "Z"),
    ("~r", "1234", "one thousand two hundred thirty-four"),
    ("~r", "-7", "negative seven"),
    ("~:r ~:r ~:r", "21 0 40", "twenty-first zeroth fortieth"),
    ("~@r ~:@r", "1999 4", "MCMXCIX IIII"),
    ("~f", "3", "3.0"),
    ("~f", "1/3", "0.33333334"),
    ("~f", "1e10", "10000000000.0"),
    ("~f", "1e-5", "0.00001"),
    ("~,2f", "1/3", "0.33"),
    ("~,0f", "3.7", "4."),
    ("~,1f", "0.05", "0.1"),
    ("~,2f", "0.005", "0.00"),
    ("~,2f", "1.005", "1.00"),
    ("~,4f", "0.65335d0", "0.6533"),
    ("~,5f", "0", "0.00000"),
    ("~,5f", "-0.7071067811865475d0", "-0.70711"),
    ("~8,2f|", "-3.14159", "   -3.14|"),
    ("~3,2f|", "3.14159", "3.14|"),
    ("~,2@f", "1.5", "+1.50"),
    ("~5f", "3.14159", "3.142"),
    ("~,2f", "x", "X"),
    ("~4,2,,'*f", "1234.5", "****"),
    ("~,2e", "12345.678", "1.23e+4"),
    ("~,3e", "0.00012", "1.200e-4"),
    ("~e ~e", "1d0 0.0", "1.0d+0 0.0e+0"),
    ("~12,3e|", "1234.5", "    1.235e+3|"),
    ("~e", "12345.0", "1.2345e+4"),
    ("~g|", "1e10", "10000000000.    |"),
    ("~g|", "1234.5", "1234.5    |"),
    ("~$ ~$", "3.14159 100", "3.14 100.00"),
    ("~2,4$", "3.14159", "0003.14"),
    ("a~2%b", "", "a\n\nb"),
    ("a~%~&b", "", "a\nb"),
    ("~2&x", "", "\nx"),
    ("one ~@\n     two", "", "one \ntwo"),
    ("one ~\n     two", "", "one two"),
    ("~{~a ~}", "(1 2 3)", "1 2 3 "),
    ("~{~s~^ ~}", "(\"a\" b #\\c)", "\"a\" B #\\c"),
    ("~:{~a-~a ~}", "((1 2) (3 4))", "1-2 3-4 "),
    ("~:@{<~a ~a>~}", "(1 2) (3 4)", "<1 2><3 4>"),
    ("~@{~a~^,~}", "1 2 3", "1,2,3"),
    ("~{~{~a~}~^|~}", "((1 2) (3))", "12|3"),
    ("~{~}", "\"~a-\" (1 2)", "1-2-"),
    ("~{x~:}", "()", "x"),
    ("~2{~a~}", "(1 2 3)", "12"),
    ("~:{~a~:^,~}", "((1) (2))", "1,2"),
    ("~[zero~;one~:;many~]", "5", "many"),
    ("~[zero~;one~]", "5", ""),
    ("~:[no~;yes~]", "nil", "no"),
    ("~@[x=~a ~]~a", "nil 7", "7"),
    ("~@[x=~a ~]~a", "1 7", "x=1 7"),
    ("~#[none~;~a~;~a and ~a~:;many~]", "1 2", "1 and 2"),
    ("~v[a~;b~;c~]", "2", "c"),
    ("~? ~a", "\"<~a>\" (1) 2", "<1> 2"),
    ("~@?", "\"~a+~a\" 1 2", "1+2"),
    ("~a ~a ~1@*~a", "1 2", "1 2 2"),
    ("~a ~:*~a ~*~a", "1 2 3", "1 1 3"),
    ("~d pupp~:@p", "1", "1 puppy"),
    ("~d item~:p", "3", "3 items"),
    ("~:c ~:c ~@c", "#\\Space #\\a #\\a", "Space a #\\a"),
    ("~(HELLO World~)", "", "hello world"),
    ("~@(hello WORLD~)", "", "Hello world"),
    ("~:(hello WORLD~)", "", "Hello World"),
    ("~:@(hello~)", "", "HELLO"),
    ("abcdefghijkl~10t|", "", "abcdefghijkl |"),
    ("abc~10,5t|", "", "abc       |"),
    ("abcdefghijkl~10,5t|", "", "abcdefghijkl   |"),
    ("ab~4@t|", "", "ab    |"),
    ("~10<abc~;def~>", "", "abc    def"),
    ("~20<left~;mid~;right~>|", "", "left    mid    right|"),
    ("~10@<abc~>|", "", "abc       |"),
    ("~10<abc~>|", "", "       abc|"),
    ("~:<~a ~a~:>", "(1 2)", "(1 2)"),
    ("~<[~;~a ~a~;]~:>", "(1 2)", "[1 2]"),
    ("~w", "\"x\"", "\"x\""),
    ("~va|", "6 \"ab\"", "ab    |"),
    ("~vd", "nil 5", "5"),
    ("~v,vf", "8 2 3.14159", "    3.14"),
    ("~^abc", "", ""),
    ("~{~a~#[~; and ~:;, ~]~}", "(1 2 3)", "1, 2 and 3"),
    ("~(~s~)", ":Foo", ":foo"),
    ("~a", "'x", "'X"),
    ("~a", "", "error in FORMAT: No more arguments\n  ~a\n   ^"),
    (
        "~q",
        "1",
        "error in FORMAT: Unknown format directive (character: Q)\n  ~q\n   ^",
    ),
    ("~'xa", "5", "TYPE-ERROR"),
    ("~{~a~}", "5", "TYPE-ERROR"),
    ("~c", "\"x\"", "TYPE-ERROR"),
    (
        "~[a",
        "1",
        "error in FORMAT: No corresponding close bracket.\n  ~[a\n   ^",
    ),
    (
        "~",
        "",
        "error in FORMAT: String ended before directive was found.\n  ~\n  ^",
    ),
    (
        "~a~}",
        "1",
        "error in FORMAT: No matching open brace.\n  ~a~}\n     ^",
    ),
];

#[test]
fn directives() {
    for (control, args, expected) in CASES {
        assert_eq!(
            format(control, args),
            *expected,
            "(format nil {control:?} {args})"
        );
    }
}

#[test]
fn blocks_break_at_the_right_margin() {
    let text = format(
        "~:<~a~^ ~:I~@{~a~^ ~_~}~:>",
        "(aaaaaaaaaaaaaaaaaaaa bbbbbbbbbbbbbbbbbbbbbbbbbbbbb cccccccccccccccccccccc dddddddddddddddddd)",
    );
    assert_eq!(
        text,
        "(AAAAAAAAAAAAAAAAAAAA BBBBBBBBBBBBBBBBBBBBBBBBBBBBB\n                      CCCCCCCCCCCCCCCCCCCCCC\n                      DDDDDDDDDDDDDDDDDD)"
    );
}
