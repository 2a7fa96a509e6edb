//! A panic in the middle of an input: the session goes on, and nothing is lost.

use session::dialogue::{Converse, Evaluate, Event, Outcome, Repeat};
use session::{Session, SessionOptions};

/// What is told of an unhandled condition, or of the values.
fn say(session: &mut Session, text: &str) -> (Outcome, String) {
    let mut told = String::new();
    let outcome = session.evaluate("test", text, &mut |event| match event {
        Event::Values(values) => told.push_str(&values.join(" ")),
        Event::Aborted(abort) => told.push_str(&abort.report),
        _ => {}
    });
    (outcome, told)
}

const LIFT: &str = "(let ((*depth* 2))
     (with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.3)))))";

#[test]
fn a_panic_takes_the_world_back_and_the_session_goes_on() {
    for is_interactive in [false, true] {
        let mut session = Session::new(&SessionOptions::default()).expect("the session starts");
        session.set_interactive(is_interactive);
        for text in [
            "(in-package :pp-tut)",
            "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))",
            "(defvar *depth* 1)",
        ] {
            assert_eq!(say(&mut session, text).0, Outcome::Finished, "{text}");
        }
        let before = session.world_hash();
        let mut steps = 0;
        session.set_observer(Box::new(move |_| {
            steps += 1;
            assert!(steps < 20, "the engine cannot calculate that");
        }));
        let (outcome, told) = say(&mut session, LIFT);
        assert_eq!(outcome, Outcome::Aborted);
        assert!(told.contains("the engine cannot calculate that"), "{told}");
        assert!(told.contains("a defect of planwright"), "{told}");
        assert_eq!(session.world_hash(), before);
        assert_eq!(session.level(), 0);

        session.set_observer(Box::new(|_| {}));
        assert_eq!(say(&mut session, "*depth*").1, "1");
        let (outcome, told) = say(&mut session, LIFT);
        assert_eq!(outcome, Outcome::Finished, "{told}");
        assert_ne!(session.world_hash(), before);
    }
}
