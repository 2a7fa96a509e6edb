//! Transcripts replayed in an evaluator made for these tests: each line of its input is
//! an instruction.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::transcript::{Transcript, Verdict, replay, replay_all};
use session::dialogue::{Abort, Evaluate, Event, Finding, Outcome, Repeat, Stop};

/// `print X` prints X without ending the line, `fail X` ends the input, `quit` the
/// session, `count` gives the number of inputs so far; else a word is its own value.
#[derive(Default)]
struct Words {
    inputs: usize,
    is_interactive: bool,
    interrupt_at: Option<u64>,
}

impl Evaluate for Words {
    fn evaluate(&mut self, _: &str, text: &str, sink: &mut dyn FnMut(Event)) -> Outcome {
        self.inputs += 1;
        for instruction in text.split(';').map(str::trim) {
            match instruction.split_once(' ').unwrap_or((instruction, "")) {
                ("print", what) => sink(Event::Output(what.to_owned())),
                ("fail", _) if self.is_interactive => {
                    sink(Event::Stopped(Box::new(Stop {
                        choices: vec!["Leave.".to_owned()],
                        ..Stop::default()
                    })));
                    return Outcome::Stopped;
                }
                ("wait", _) => {
                    let at = self.interrupt_at.take().unwrap_or_default();
                    sink(Event::Values(vec![at.to_string()]));
                }
                ("fail", what) => {
                    sink(Event::Aborted(Box::new(Abort {
                        report: format!("There is no {what}."),
                        condition: format!("#<NO-{}>", what.to_uppercase()),
                        ..Abort::default()
                    })));
                    return Outcome::Aborted;
                }
                ("quit", _) => return Outcome::Quit(0),
                ("none", _) => sink(Event::Values(Vec::new())),
                ("count", _) => sink(Event::Values(vec![self.inputs.to_string()])),
                (word, _) => sink(Event::Values(vec![word.to_owned()])),
            }
        }
        Outcome::Finished
    }

    fn check(&mut self, _: &str, _: &str) -> Vec<Finding> {
        Vec::new()
    }

    fn prompt(&self) -> String {
        "WORDS".to_owned()
    }

    fn interrupt_handle(&self) -> Arc<AtomicBool> {
        Arc::default()
    }
}

impl Repeat for Words {
    fn set_interactive(&mut self, is_interactive: bool) {
        self.is_interactive = is_interactive;
    }

    fn interrupted_at(&self) -> Option<u64> {
        None
    }

    fn interrupt_next_at(&mut self, at: u64) {
        self.interrupt_at = Some(at);
    }
}

/// The lines at which a transcript differs.
fn differing(name: &str, text: &str) -> Vec<usize> {
    lines(&replay(
        &Transcript::parse(name, text),
        &mut Words::default(),
    ))
}

fn lines(verdicts: &[Verdict]) -> Vec<usize> {
    verdicts
        .iter()
        .filter_map(|verdict| match verdict {
            Verdict::Passed => None,
            Verdict::Failed(difference) => Some(difference.line),
        })
        .collect()
}

#[test]
fn state_carries_over_within_a_file() {
    assert_eq!(differing("a", "A> count\n1\n\nA> count\n2\n"), [0usize; 0]);
}

#[test]
fn values_stand_below_output() {
    assert_eq!(
        differing("a", "A> print x; print y; a; b\nxy\na\nb\n"),
        [0usize; 0]
    );
    assert_eq!(differing("a", "A> print x\nx\n"), [0usize; 0]);
}

#[test]
fn a_failure_ends_its_input_only() {
    let text = "A> a; fail bottle; b\na\n...\n; Evaluation aborted on #<[..]BOTTLE>.\n\nA> c\nc\n";
    assert_eq!(differing("a", text), [0usize; 0]);
}

#[test]
fn an_evaluation_stops_where_the_next_prompt_shows_that_it_did() {
    let text = "A> fail x\n0: Leave.\n\nA 1]> count\n2\n\nA> fail y\n...\n; Evaluation aborted on #<NO-Y>.\n\nA> fail z\n 0: Leave.\n\nA 1]>\n";
    assert_eq!(differing("a", &text.replace("\n0:", "\n 0:")), [0usize; 0]);
}

#[test]
fn an_interrupt_is_repeated_where_it_came() {
    assert_eq!(
        differing("a", "A> wait ; Ctrl-C at poll 7\n7\n"),
        [0usize; 0]
    );
}

#[test]
fn that_a_form_has_no_value_may_be_told_before_the_end() {
    assert_eq!(differing("a", "A> none; b\n; No value\nb\n"), [0usize; 0]);
    assert_eq!(differing("a", "A> none; b\nb\n"), [0usize; 0]);
}

#[test]
fn after_leaving_nothing_is_put_out() {
    assert_eq!(differing("a", "A> quit\n\nA> b\nb\n\nA> c\n"), [4]);
}

#[test]
fn the_first_line_that_differs_is_told() {
    assert_eq!(differing("a", "A> a; b\na\nc\n\nA> d\nd\n\nA> e\n"), [3, 9]);
}

#[test]
fn markdown_keeps_its_state_from_block_to_block() {
    let text = "# Title\n\n```session\nA> count\n1\n```\n\nThen:\n\n```session\nA> count\n2\n```\n";
    assert_eq!(differing("docs/a.md", text), [0usize; 0]);
}

#[test]
fn results_come_in_the_order_of_the_files_whatever_the_number_of_threads() {
    let transcripts: Vec<Transcript> = (0..40)
        .map(|n| Transcript::parse(&n.to_string(), &"A> count\n1\n".repeat(1 + n % 7)))
        .collect();
    let told = |jobs| {
        let mut told = Vec::new();
        replay_all(
            &transcripts,
            NonZeroUsize::new(jobs).unwrap(),
            || Ok::<_, ()>(Words::default()),
            |transcript, verdicts| {
                told.push((transcript.name.clone(), lines(&verdicts.unwrap())));
                true
            },
        );
        told
    };
    let alone = told(1);
    assert_eq!(alone.len(), 40);
    assert_eq!(alone[2], ("2".to_owned(), vec![4, 6]));
    assert_eq!(told(8), alone);
}
