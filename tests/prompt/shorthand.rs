//! What newcomers type: words from other systems, names without their package, mistakes.

use super::talk::{BOTTLE, NOWHERE, Talk};
use session::dialogue::{Converse, Evaluate, Outcome};

#[test]
fn words_from_other_systems_do_what_they_mean() {
    let mut talk = Talk::new();
    let help = talk.say("(help)");
    for word in ["help", "HELP", ":help", "help()", "?"] {
        assert_eq!(talk.say(word), help, "{word}");
    }
    assert_eq!(
        talk.say("q"),
        "; Nothing has stopped; (quit) or Ctrl-D leaves.\n; No value\n"
    );
    talk.say("(list 1 2)");
    assert_eq!(talk.say("_"), "(1 2)\n");
    for word in ["quit", "exit", ":quit", "exit()"] {
        let (_, outcome) = Talk::new().take(word);
        assert_eq!(outcome, Outcome::Quit(0), "{word}");
    }
}

#[test]
fn a_variable_with_a_value_is_meant_as_such() {
    let mut talk = Talk::new();
    talk.say("(defvar help 5)");
    assert_eq!(talk.say("help"), "5\n");
}

#[test]
fn words_have_their_meaning_where_an_evaluation_stands_still_too() {
    let mut talk = Talk::new();
    talk.say("(car 1)");
    let commands = talk.say(":help");
    assert!(commands.contains(":locals"), "{commands}");
    assert_eq!(talk.say("help"), commands);
    assert!(talk.say("?going").contains("going"));
    assert!(talk.say("(apropos \"park-arms\")").contains("PARK-ARMS"));
    let (left, outcome) = talk.take("exit");
    assert!(left.starts_with("; Evaluation aborted"), "{left}");
    assert_eq!(outcome, Outcome::Aborted);
}

#[test]
fn a_plan_that_stands_still_is_named_to_who_begins_another() {
    let mut talk = Talk::new();
    talk.say("(with-simulated-robot (car 1))");
    let shown = talk.say("(with-simulated-robot 3)");
    assert!(
        shown.contains(
            "; (WITH-SIMULATED-ROBOT (CAR 1)) stands still: q abandons it, a restart goes on with it."
        ),
        "{shown}"
    );
}

#[test]
fn a_level_shows_its_own_restarts_and_folds_the_others() {
    let mut talk = Talk::new();
    let first = talk.say("(list nothing-yet)");
    assert!(first.contains("   [Condition of type UNBOUND-VARIABLE]\n"));
    let second = talk.say("(list nothing-else)");
    assert!(second.contains("Retry using NOTHING-ELSE."), "{second}");
    assert!(!second.contains("Retry using NOTHING-YET."), "{second}");
    assert!(
        second.contains(" 3 to 5: as at level 1; :r shows them."),
        "{second}"
    );
    let all = talk.say(":r");
    assert!(
        all.contains(" 3: [CONTINUE] Retry using NOTHING-YET."),
        "{all}"
    );
    assert_eq!(
        talk.say("4 :here"),
        "(:HERE)\n",
        "folded ones can be chosen"
    );
}

#[test]
fn the_form_typed_last_can_be_changed() {
    let mut talk = Talk::new();
    talk.say("(with-simulated-robot (car 1))");
    let at_plan = talk.session.prompt();
    talk.say("(spwan-object 1)");
    talk.say(":edit");
    assert_eq!(
        talk.session.take_draft().as_deref(),
        Some("(spwan-object 1)")
    );
    assert_eq!(talk.session.prompt(), at_plan);
    talk.say("(list :mended)");
    talk.say(":edit");
    let plan = "(with-simulated-robot (car 1))";
    assert_eq!(talk.session.take_draft().as_deref(), Some(plan));
}

#[test]
fn a_wrong_number_of_arguments_tells_the_right_one() {
    let mut talk = Talk::new();
    let shown = talk.say("(make-pose \"map\")");
    assert!(
        shown.contains("; A call of it: (make-pose frame pose)"),
        "{shown}"
    );
    talk.say("q");
    talk.say("(defun f (x y &optional z) (list x y z))");
    let shown = talk.say("(f 1)");
    assert!(
        shown.contains("; A call of it: (f x y &optional z)"),
        "{shown}"
    );
}

#[test]
fn values_of_designators_say_what_was_expected() {
    let mut talk = Talk::new();
    let shown = talk.say(&NOWHERE.replace("(pose ?place)", "(pose place)"));
    assert!(
        shown.contains("bind ?place and write (pose ?place)."),
        "{shown}"
    );
    talk.say("q");
    let torso =
        "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle \"high\"))))";
    let shown = talk.say(torso);
    assert!(
        shown.contains("Write a number without quotes, such as (joint-angle 0.3)."),
        "{shown}"
    );
}

#[test]
fn retry_outside_a_handler_says_where_it_belongs() {
    let mut talk = Talk::new();
    let shown = talk.say("(cpl:retry)");
    assert!(
        shown.contains("only in the handlers of with-failure-handling"),
        "{shown}"
    );
}

#[test]
fn actions_motions_and_types_of_objects_are_found_and_described() {
    let mut talk = Talk::new();
    let found = talk.say("(apropos \"picking\")");
    assert!(found.contains(":PICKING-UP (action)"), "{found}");
    let told = talk.say("(describe :bottle)");
    assert!(told.contains("A type of objects: "), "{told}");
    assert!(talk.say("(describe :going)").contains("(target …)"));
}

#[test]
fn variables_of_the_form_being_typed_are_completed_first() {
    let mut talk = Talk::new();
    assert_eq!(
        talk.completions("(let ((?navigation-goal 1)) (list ?na"),
        ["?navigation-goal"]
    );
    let found = talk.completions("(let ((navig 1)) (list nav");
    assert_eq!(found.first().map(String::as_str), Some("navig"));
    talk.say(BOTTLE);
    let found = talk.completions("(get-current-pose-of-object 'bo");
    assert_eq!(found.first().map(String::as_str), Some("bottle-1"));
    let found = talk.completions("(list 'kitchen-isl");
    assert!(
        found.contains(&"kitchen-island-surface".to_owned()),
        "{found:?}"
    );
}
