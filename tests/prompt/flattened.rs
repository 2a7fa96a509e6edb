//! Text whose comments have swallowed code, since it has lost its line breaks.

use super::talk::Talk;
use crate::prompt::pasted::Inputs;
use crate::transcript::{Transcript, replay};
use session::dialogue::Evaluate;

/// A form that has lost its line breaks: alone it is incomplete.
const FLAT: &str = "(let ((sum 0)) ;; Add the first. (incf sum 1) ;; Add the others, too: (dolist (n '(2 3)) (incf sum n)) sum)";
/// Two forms that have lost their line breaks: alone the first is complete.
const TWO: &str =
    "(defparameter *a* 4) ;; This is what the next form ;; takes the square of. (* *a* *a*)";

/// The last value that is shown.
fn value(shown: &str) -> &str {
    shown.lines().last().unwrap_or_default()
}

#[test]
fn an_input_whose_comment_has_swallowed_code_is_evaluated_as_it_was() {
    let mut talk = Talk::new();
    let shown = talk.say(FLAT);
    assert_eq!(value(&shown), "6");
    assert!(
        shown.starts_with("; Line breaks were lost, so that a comment had swallowed code."),
        "{shown}"
    );
    assert!(shown.contains(";   (incf sum 1) …\n"), "{shown}");
    let shown = talk.say(TWO);
    assert_eq!(value(&shown), "16", "{shown}");
}

#[test]
fn a_pasted_input_that_has_swallowed_code_ends_where_it_is_balanced_then() {
    let text = format!("PP-TUT> {FLAT} PP-TUT> {TWO}\nPP-TUT> (list 1)");
    let found = Inputs::of(&text);
    assert_eq!(found.inputs.len(), 3);
    assert!(found.are_whole());
    assert_eq!(found.inputs[0], FLAT);
}

#[test]
fn a_form_behind_a_sentence_stays_a_comment_which_is_said() {
    let mut talk = Talk::new();
    let shown = talk.say("(list 1) ;; Now the other one. (list 2)");
    assert_eq!(
        shown,
        "; Not evaluated, since it is in a comment: (list 2)\n(1)\n"
    );
    assert_eq!(talk.say("(list 1) ;; like (list 2)"), "(1)\n");
    assert_eq!(talk.say("(list 1) ; (list 2)."), "(1)\n");
}

#[test]
fn while_an_evaluation_stands_still_line_breaks_are_restored_too() {
    let mut talk = Talk::new();
    talk.say("(car 1)");
    assert_eq!(value(&talk.say(FLAT)), "6");
}

#[test]
fn a_file_is_never_changed_but_the_error_names_the_comment() {
    let mut talk = Talk::new();
    let folder = std::env::temp_dir().join(format!("planwright-flat-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let path = folder.join("flat.plan");
    std::fs::write(&path, format!("(list 1)\n{FLAT}\n")).expect("a file");
    let shown = talk.say(&format!("(load {:?})", path.display().to_string()));
    std::fs::remove_dir_all(&folder).expect("it is there");
    let expected =
        "The comment \";; Add the first.\" at line 2, column 16 has swallowed \"(incf sum 1) …\"";
    assert!(
        shown.contains("end of file in a list that starts on line 2"),
        "{shown}"
    );
    assert!(shown.contains(expected), "{shown}");
}

#[test]
fn an_unmatched_parenthesis_names_the_comment_that_has_swallowed_the_other_one() {
    let mut talk = Talk::new();
    let findings = talk
        .session
        .check("a.plan", "(list 1 ;; the rest (list 2\n 3))\n");
    let messages: Vec<&str> = findings.iter().map(|f| f.message.as_str()).collect();
    assert_eq!(messages.len(), 1);
    assert!(
        messages[0].contains(
            "unmatched close parenthesis. The comment \";; the rest\" at line 1, column 9"
        ),
        "{messages:?}"
    );
}

#[test]
fn a_check_names_forms_that_a_comment_hides() {
    let mut talk = Talk::new();
    let findings = talk.session.check("a.plan", TWO);
    let messages: Vec<&str> = findings.iter().map(|f| f.message.as_str()).collect();
    assert_eq!(
        messages,
        [
            "The comment has swallowed \"(* *a* *a*)\"; break the line before that if it is no comment."
        ]
    );
    let place = findings[0].place.as_ref().expect("a place");
    assert_eq!((place.line, place.column), (1, 22));
    for meant in [
        "(list 1) ;; as (list 2) ;; or (list 3)",
        ";; for ;; example (list 1)",
        "(list 1) ; (list 2) ; (list 3)",
        "(list 1 ; one (or two\n 2)",
    ] {
        let other = talk.session.check("b.plan", meant);
        assert!(other.len() < 2, "{meant}: {other:?}");
    }
}

#[test]
fn a_replayed_input_goes_on_after_a_flattened_one() {
    let mut talk = Talk::new();
    let text = format!("A> {FLAT}\n6\nA> (list 1)\n(1)\n");
    let transcript = Transcript::parse("a.transcript", &text);
    assert_eq!(transcript.entries.len(), 2);
    let verdicts = replay(&transcript, &mut talk.session);
    // It is said that line breaks were lost, which the transcript does not expect.
    assert!(!verdicts[0].passed());
    assert!(verdicts[1].passed());
}
