//! Forms and what the prompt of a session shows for them.

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// What the prompt prints for the values of the last form, or the report of the condition.
fn shown(session: &mut Session, form: &str) -> String {
    let mut last = String::new();
    session.evaluate("test", form, &mut |event| match event {
        Event::Values(values) => last = values.join(" ; "),
        Event::Aborted(abort) => last = format!("!! {}", abort.report),
        _ => {}
    });
    last.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Checks pairs of forms and what they show.
pub(super) fn check(cases: &[(&str, &str)]) {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut wrong = Vec::new();
    for (form, expected) in cases {
        let got = shown(&mut session, form);
        if got != *expected {
            wrong.push(format!("{form}\n  gives {got}\n  not   {expected}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
