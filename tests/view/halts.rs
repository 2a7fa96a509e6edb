//! What viewers learn when an evaluation does not go on.

use serde_json::{Value, json};

use super::viewed::{Viewed, viewed};
use session::dialogue::{Evaluate, Outcome, Repeat};

fn stopped_viewed() -> Viewed {
    let mut viewed = viewed();
    viewed.session.set_interactive(true);
    viewed
}

fn outcome(viewed: &mut Viewed, text: &str) -> Outcome {
    viewed.session.evaluate("test.plan", text, &mut |_| {})
}

/// The last state of each task, by its name.
fn states(events: &[(String, Value)]) -> Vec<(String, String)> {
    let mut states: Vec<(String, String)> = Vec::new();
    let news = events.iter().filter(|(name, _)| name == "news");
    for task in news.flat_map(|(_, list)| list.as_array().unwrap()) {
        let (Some(name), Some(state)) = (task["name"].as_str(), task["state"].as_str()) else {
            continue;
        };
        let name = name.split("]-").next().unwrap_or_default().to_owned();
        states.retain(|(known, _)| *known != name);
        states.push((name, state.to_owned()));
    }
    states.sort();
    states
}

fn pairs(states: &[(&str, &str)]) -> Vec<(String, String)> {
    let pair = |(a, b): &(&str, &str)| ((*a).to_owned(), (*b).to_owned());
    states.iter().map(pair).collect()
}

fn is_halt(name: &str, data: &Value) -> bool {
    name == "halt" && !data.is_null()
}

fn is_resumed(name: &str, data: &Value) -> bool {
    name == "halt" && data.is_null()
}

const FAILING: &str = "(cpl:top-level (cpl:par (cpl:sleep 1000)
  (restart-case (error \"no ~a\" :way) (wait-a-little () :report \"Wait.\" (cpl:sleep 2)))))";

#[test]
fn a_stop_is_told_with_its_condition_its_choices_and_the_path_to_it() {
    let mut viewed = stopped_viewed();
    let mut events = viewed.events();
    assert_eq!(outcome(&mut viewed, FAILING), Outcome::Stopped);
    let told = events.until(is_halt);
    let halt = &told.last().unwrap().1;
    assert_eq!(halt["kind"], "stopped");
    assert_eq!(halt["class"], "SIMPLE-ERROR");
    assert_eq!(halt["report"], "no WAY");
    assert_eq!(halt["place"], "test.plan:2:17");
    assert_eq!(halt["level"], 1);
    assert_eq!(halt["choices"][0], "[WAIT-A-LITTLE] Wait.");
    let last = halt["choices"].as_array().unwrap().last().unwrap();
    assert_eq!(last, "[ABORT] Return to the top level.");
    assert_eq!(
        states(&told),
        pairs(&[
            ("[PAR-CHILD-#1/2", "running"),
            ("[PAR-CHILD-#2/2", "stopped"),
            ("[TOP-LEVEL", "stopped"),
        ])
    );
    // Who comes later learns it, too.
    let later = viewed.events().until(is_halt);
    assert_eq!(&later.last().unwrap().1, halt);
}

#[test]
fn a_stop_is_over_when_the_user_leaves_it() {
    let mut viewed = stopped_viewed();
    let mut events = viewed.events();
    assert_eq!(outcome(&mut viewed, FAILING), Outcome::Stopped);
    let mut told = events.until(is_halt);
    // A stop on top of it.
    assert_eq!(outcome(&mut viewed, "(error \"again\")"), Outcome::Stopped);
    told.extend(events.until(|name, data| is_halt(name, data) && data["level"] == 2));
    outcome(&mut viewed, "a");
    told.extend(events.until(|name, data| is_halt(name, data) && data["level"] == 1));
    outcome(&mut viewed, "q");
    told.extend(events.until(is_resumed));
    let states = states(&told);
    assert!(
        states.iter().all(|(_, state)| state == "evaporated"),
        "{states:?}"
    );
}

#[test]
fn a_choice_that_goes_on_is_told_while_it_does() {
    let mut viewed = stopped_viewed();
    assert_eq!(viewed.ask("speed max"), "204");
    let mut events = viewed.events();
    let text = FAILING.replace("(cpl:sleep 1000)", "(cpl:sleep 1)");
    assert_eq!(outcome(&mut viewed, &text), Outcome::Stopped);
    events.until(is_halt);
    assert_eq!(outcome(&mut viewed, "0"), Outcome::Finished);
    // The end is shown, and then nothing more happens.
    let mut told = events.until(|name, data| name == "frame" && data["t"] == 2.0);
    told.extend(events.until(|name, _| name == "alive"));
    assert!(told.iter().any(|(name, data)| is_resumed(name, data)));
    let after = states(&told);
    assert!(
        after.iter().all(|(_, state)| state == "succeeded"),
        "{after:?}"
    );
}

#[test]
fn an_interrupt_is_told() {
    let mut viewed = stopped_viewed();
    let mut events = viewed.events();
    viewed.session.interrupt_next_at(40);
    assert_eq!(outcome(&mut viewed, "(loop)"), Outcome::Stopped);
    let told = events.until(is_halt);
    let halt = &told.last().unwrap().1;
    assert_eq!(halt["kind"], "interrupted");
    let choices = json!(["Continue.", "Abort.", "Abort, and park the arms."]);
    assert_eq!(halt["choices"], choices);
    outcome(&mut viewed, "1");
    events.until(is_resumed);
}

#[test]
fn what_nobody_can_decide_about_ends_until_the_next_form() {
    let mut viewed = viewed();
    let mut events = viewed.events();
    for (text, class) in [
        ("(car 1)", "TYPE-ERROR"),
        (
            "(cpl:top-level (cpl:par (cpl:fail \"no\")))",
            "SIMPLE-PLAN-FAILURE",
        ),
        (")", "READER-ERROR"),
    ] {
        assert_eq!(outcome(&mut viewed, text), Outcome::Aborted);
        let told = events.until(is_halt);
        let halt = &told.last().unwrap().1;
        assert_eq!(
            (&halt["kind"], &halt["class"]),
            (&json!("aborted"), &json!(class))
        );
        assert_eq!(halt["choices"], json!([]));
        let states = states(&told);
        assert!(
            states.iter().all(|(_, state)| state == "failed"),
            "{states:?}"
        );
        assert_eq!(outcome(&mut viewed, "(+ 1 1)"), Outcome::Finished);
        events.until(is_resumed);
    }
}
