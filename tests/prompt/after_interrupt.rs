//! Looking around after an interrupt.

use super::talk::{BOTTLE, Talk};
use session::dialogue::{Converse, Evaluate, Outcome, Repeat};

const DRIVE: &str = "(with-simulated-robot
  (let ((?there (make-pose \"map\" '((0.7 0 0) (0 0 0 1)))) (count 1))
    (perform (an action (type going) (target (a location (pose ?there)))))
    (list :there count)))";

/// A session in which a plan has been interrupted at that poll.
fn interrupted(plan: &str, at: u64) -> Talk {
    let mut talk = Talk::new();
    talk.session.interrupt_next_at(at);
    let (shown, outcome) = talk.take(plan);
    assert_eq!(outcome, Outcome::Stopped, "{shown}");
    assert!(shown.starts_with("Interrupted."), "{shown}");
    talk
}

#[test]
fn frames_and_variables_of_an_interrupted_plan_are_seen() {
    let mut talk = interrupted(DRIVE, 300);
    assert_eq!(talk.session.prompt(), "PP-TUT stopped");
    let frames = talk.say(":bt");
    assert!(
        frames.contains("(PERFORM (A ACTION (TYPE GOING)"),
        "{frames}"
    );
    let body = frames
        .lines()
        .map(|line| line.contains("LAMBDA"))
        .collect::<Vec<_>>();
    let body = body.iter().rposition(|is_lambda| *is_lambda);
    let number = body.expect("the frame of the plan's body");
    talk.say(&format!(":frame {number}"));
    let locals = talk.say(":locals");
    assert!(locals.contains("COUNT = 1"), "{locals}");
    let is_there = "(< (abs (- (cl-tf:x (cl-tf:origin ?there)) 0.7)) 1e-6)";
    assert_eq!(talk.say(is_there), "T\n");
    assert!(talk.say("(inspect ?there)").starts_with("#<"));
    talk.say("q");
    assert_eq!(talk.say("(setf count 5)"), "5\n");
    assert_eq!(talk.session.prompt(), "PP-TUT stopped");
    assert_eq!(talk.say("0"), "(:THERE 5)\n");
}

#[test]
fn a_look_around_does_not_change_how_a_plan_goes_on() {
    let ends = [
        "",
        "(+ 1 1)",
        ":bt",
        "(get-robot-pose)",
        "(car 5)",
        "(loop for i below 9 collect i)",
    ]
    .map(|input| {
        let mut talk = interrupted(DRIVE, 300);
        talk.say(input);
        assert_eq!(talk.say("0"), "(:THERE 1)\n", "{input}");
        (talk.hash(), talk.session.simulation().now())
    });
    assert!(ends.iter().all(|end| *end == ends[0]), "{ends:?}");
}

#[test]
fn what_would_let_time_pass_is_refused_while_a_plan_stands_still() {
    let mut talk = interrupted(DRIVE, 300);
    let now = talk.session.simulation().now();
    for input in [
        "(cpl:sleep 1)",
        "(perform (a motion (type moving-torso) (joint-angle 0.2)))",
        "(cpl:par (cpl:sleep 1) 2)",
        "(cpl:wait-for (cpl:make-fluent :value nil))",
    ] {
        let shown = talk.say(input);
        assert!(shown.contains("Time stands still"), "{input}\n{shown}");
        assert_eq!(talk.session.prompt(), "PP-TUT stopped");
    }
    let shown = talk.say("(with-simulated-robot 1)");
    assert!(
        shown.contains("top-level calls cannot be nested"),
        "{shown}"
    );
    assert_eq!(talk.session.simulation().now(), now);
    assert_eq!(talk.say("0"), "(:THERE 1)\n");
}

#[test]
fn the_world_can_be_changed_while_a_plan_stands_still() {
    let mut talk = interrupted(DRIVE, 300);
    talk.say(BOTTLE);
    assert!(
        talk.say("(get-current-pose-of-object 'bottle-1)")
            .starts_with("#<")
    );
    assert_eq!(talk.say("0"), "(:THERE 1)\n");
}

#[test]
fn special_variables_have_the_values_of_the_interrupted_plan() {
    let mut talk = interrupted(
        "(progn (defvar *depth* 0) (let ((*depth* 7)) (loop while (= *depth* 7)) *depth*))",
        500,
    );
    assert_eq!(talk.say("*depth*"), "7\n");
    talk.say("(setf *depth* 8)");
    assert_eq!(talk.say("0"), "8\n");
    assert_eq!(talk.say("*depth*"), "0\n");
}

#[test]
fn an_evaluation_beside_a_plan_is_interrupted_by_itself() {
    let mut talk = interrupted("(let ((x 1)) (loop while (= x 1) do (setq x 1)) x)", 300);
    talk.session.interrupt_next_at(200);
    let (shown, outcome) = talk.take("(loop)");
    assert!(shown.contains("Interrupted."), "{shown}");
    assert_eq!(outcome, Outcome::Aborted);
    assert_eq!(talk.session.prompt(), "PP-TUT stopped");
    assert_eq!(talk.say(":locals"), "  X = 1\n");
    assert_eq!(talk.say("(setf x 2)"), "2\n");
    assert_eq!(talk.say(":locals"), "  X = 2\n");
    talk.session.interrupt_next_at(1000);
    assert_eq!(talk.say("0"), "2\n");
}

#[test]
fn an_interrupted_form_can_be_edited_or_retried() {
    let mut talk = interrupted("(loop while t)", 100);
    talk.say(":edit");
    assert_eq!(talk.session.take_draft().as_deref(), Some("(loop while t)"));
    assert_eq!(talk.say("(loop while nil)"), "NIL\n");
    assert_eq!(talk.session.prompt(), "PP-TUT");
    let mut talk = interrupted("(loop while t)", 100);
    talk.session.interrupt_next_at(50);
    assert!(talk.say(":retry").starts_with("Interrupted."));
    assert!(talk.say(":return 5").contains("no value can be returned"));
    assert!(talk.say("7").contains("Type 0 to continue"));
    assert!(talk.say("q").contains("; Evaluation aborted"));
}

/// A class of streams whose methods take long.
const SLOW_STREAM: &str = "(progn
  (defclass slow-stream (gray-streams:fundamental-character-output-stream
                         gray-streams:fundamental-character-input-stream)
    ((text :initform '()) (rest :initform (coerce \"ab\" 'list))))
  (defun wait-a-little () (let ((n 0)) (dotimes (i 3000 n) (incf n i))))
  (defmethod gray-streams:stream-write-char ((s slow-stream) c)
    (wait-a-little)
    (push c (slot-value s 'text))
    c)
  (defmethod gray-streams:stream-read-char ((s slow-stream))
    (wait-a-little)
    (or (pop (slot-value s 'rest)) :eof))
  t)";

const USE_OF_SLOW_STREAM: &str = "(let ((s (make-instance 'slow-stream)))
  (format s \"~a-~s\" 12 :cup)
  (write '(1 2) :stream s)
  (list (read-line s) (coerce (reverse (slot-value s 'text)) 'string)))";

#[test]
fn an_interrupt_in_a_method_of_a_stream_leaves_the_session_whole() {
    let mut talk = Talk::new();
    talk.say(SLOW_STREAM);
    let whole = talk.say(USE_OF_SLOW_STREAM);
    assert_eq!(whole, "(\"ab\" \"12-:CUP(1 2)\")\n");
    let mut stopped = 0;
    for at in (1..60).step_by(3) {
        talk.session.interrupt_next_at(at);
        let (shown, outcome) = talk.take(USE_OF_SLOW_STREAM);
        if outcome != Outcome::Stopped {
            assert_eq!(shown, whole);
            continue;
        }
        stopped += 1;
        // Other streams, this class and the printer work meanwhile.
        assert_eq!(talk.say("(format nil \"~a\" '(1 2))"), "\"(1 2)\"\n");
        assert_eq!(talk.say(USE_OF_SLOW_STREAM), whole);
        if at % 2 == 0 {
            assert_eq!(talk.say("0"), whole, "at {at}");
        } else {
            talk.say("q");
            assert_eq!(talk.say(USE_OF_SLOW_STREAM), whole, "at {at}");
        }
    }
    assert!(stopped > 5, "{stopped} interrupts");
}

#[test]
fn a_name_with_a_question_mark_is_the_local_variable_first() {
    let form = "(let ((?x 1)) (loop while (= ?x 1) do (setq ?x 1)) ?x)";
    let mut talk = interrupted(form, 300);
    assert_eq!(talk.say("?x"), "?X = 1\n; in frame 0\n");
    let known = talk.say("?car");
    assert!(known.contains("The car of a list"), "{known}");
}

#[test]
fn an_interrupt_while_macros_are_expanded_stops_the_form_that_they_are_part_of() {
    let mut talk = Talk::new();
    talk.say("(defmacro counted (n) (loop for i below n sum i into s finally (return s)))");
    let form = "(loop repeat 9 for x = (counted 500) then (counted 2000) sum
                  (loop for i from 1 upto 2000 count (evenp i)))";
    let whole = talk.say(form);
    assert_eq!(whole, "9000\n");
    let mut stopped = 0;
    for at in 1..80 {
        talk.session.interrupt_next_at(at);
        let (shown, outcome) = talk.take(form);
        if outcome == Outcome::Stopped {
            stopped += 1;
            assert!(shown.contains("\n 0: Continue.\n"), "at {at}: {shown}");
            assert_eq!(talk.say("0"), whole, "at {at}");
        } else {
            assert_eq!(shown, whole, "at {at}");
        }
    }
    assert!(stopped > 30, "{stopped} interrupts");
}

#[test]
fn an_interrupt_ends_a_macro_that_never_returns() {
    let mut talk = Talk::new();
    talk.say("(defmacro endless () (loop))");
    for form in [
        "(endless)",
        "(list (endless))",
        "(macroexpand-1 '(endless))",
    ] {
        talk.session.interrupt_next_at(10);
        let (shown, _) = talk.take(form);
        assert!(shown.starts_with("Interrupted."), "{form}: {shown}");
        talk.say("q");
    }
}
