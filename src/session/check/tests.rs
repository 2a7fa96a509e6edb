//! Wrong inputs and what is said about them.

use crate::dialogue::Evaluate;
use crate::session::{Session, SessionOptions};

fn found(text: &str) -> Vec<String> {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    session
        .check("a.plan", text)
        .into_iter()
        .map(|f| match f.place {
            Some(p) => format!("{}:{}: {}", p.line, p.column, f.message),
            None => f.message,
        })
        .collect()
}

#[test]
fn mistakes_are_told_with_their_places() {
    let mut wrong = Vec::new();
    for (text, expected) in TABLE {
        let found = found(text).join("\n");
        if found != *expected {
            wrong.push(format!("{text}\n  expected {expected}\n  found    {found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const TABLE: &[(&str, &str)] = &[
    ("(print b)", "1:8: The variable B is unbound."),
    (
        "(in-package :pp-tut)\n(a motion (type goiing) (pose nil))",
        "2:17: There is no motion of type GOIING; did you mean GOING?",
    ),
];
