//! What fuzzing has found, as tests.

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// The values of the last form of a text.
fn values(text: &str) -> Vec<String> {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut last = Vec::new();
    session.evaluate("test", text, &mut |event| match event {
        Event::Values(values) => last = values,
        Event::Aborted(abort) => panic!("{}", abort.report),
        _ => {}
    });
    last
}

/// A list of bindings or parameters that is a backquoted form was printed as a list.
#[test]
fn a_backquote_prints_as_such_wherever_code_has_a_list() {
    for text in [
        "(LET `(A ,B)\n  C)",
        "(DEFMACRO M `',X\n  Y)",
        "(FLET `((F (X) ,@Y))\n  1)",
        "(DOLIST `,X\n  Y)",
    ] {
        let form = format!("(let ((*print-pretty* t)) (prin1-to-string (quote {text})))");
        let read = format!("(equal (quote {text}) (read-from-string {form}))");
        assert_eq!(values(&read), ["T"], "{text}");
    }
}

/// A backquoted form was taken for the row of an array, which then did not read back.
#[test]
fn a_backquote_is_no_row_of_an_array() {
    for text in ["#2A(`(a ,b))", "#1A`(a ,b)", "#2A((1 2) ,x)"] {
        let form = format!("(handler-case (read-from-string {text:?}) (reader-error () :refused))");
        assert_eq!(values(&form), [":REFUSED"], "{text}");
    }
}
