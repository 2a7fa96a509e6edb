//! Every example in the tables of builtins and operators is run: what the manual shows is
//! what happens.

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// What the prompt prints for the values of the last form, or the report of what went wrong.
fn shown(session: &mut Session, form: &str) -> String {
    let mut last = String::new();
    session.evaluate("example", form, &mut |event| match event {
        Event::Values(values) if values.is_empty() => last = "; No value".to_owned(),
        Event::Values(values) => last = values.join(" ; "),
        Event::Aborted(abort) => last = format!("!! {}", abort.report),
        _ => {}
    });
    last
}

/// The text without line breaks: tables show values on one line.
fn on_one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn every_example_gives_what_it_says() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let examples = session.examples();
    assert!(examples.len() > 500, "only {} examples", examples.len());
    let mut wrong = Vec::new();
    for (name, example) in &examples {
        let Some((form, expected)) = example.rsplit_once(" => ") else {
            wrong.push(format!("{name}: {example} shows no value"));
            continue;
        };
        let got = shown(&mut session, form);
        if on_one_line(&got) != on_one_line(expected) {
            wrong.push(format!(
                "{name}: {form}\n  gives    {got}\n  not      {expected}"
            ));
        }
        shown(&mut session, "(in-package :cl-user)");
    }
    assert!(
        wrong.is_empty(),
        "{} of {} examples differ:\n{}",
        wrong.len(),
        examples.len(),
        wrong.join("\n")
    );
}
