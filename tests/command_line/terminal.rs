//! The prompt in a pseudo-terminal, driven as a person would: typing, Tab, arrow keys,
//! Ctrl-C, pasting.

use std::process::Command;
use std::time::Duration;

use super::pseudo_terminal::{
    CTRL_C, CTRL_D, CTRL_J, CTRL_R, DOWN, ENTER, LEFT, State, TAB, Terminal, UP,
};

const DRIVE: &str = "(with-simulated-robot (let ((?p (make-pose \"map\" '((0.5 0 0) (0 0 0 1))))) (perform (an action (type going) (target (a location (pose ?p)))))))";

fn in_tutorial(state: &State, arguments: &[&str]) -> Terminal {
    let terminal = Terminal::start(state, arguments);
    terminal.evaluate("(in-package :pp-tut)");
    terminal
}

/// The world's hash as the prompt tells it.
fn hash_of(terminal: &Terminal) -> String {
    let text = terminal.evaluate("(world-hash)");
    let line = text.lines().rev().find(|line| line.starts_with('"'));
    line.expect("a hash").trim_matches('"').to_owned()
}

#[test]
fn enter_goes_on_until_the_form_is_whole_and_indents() {
    let state = State::new("enter");
    let terminal = Terminal::start(&state, &[]);
    terminal.line("(defun f (x) ; not here: (");
    terminal.line("(list x \"(\"");
    terminal.line("x))");
    terminal.wait_for("\nF\nCL-USER>");
    let text = terminal.text();
    let expected =
        "CL-USER> (defun f (x) ; not here: (\n           (list x \"(\"\n                 x))\nF\n";
    assert!(text.contains(expected), "{text}");
    terminal.evaluate("(f 1)");
    assert!(terminal.text().contains("(1 \"(\" 1)"));
}

#[test]
fn ctrl_j_begins_a_line_where_enter_would_evaluate() {
    let state = State::new("ctrl-j");
    let terminal = Terminal::start(&state, &[]);
    // What comes as soon as the prompt is there counts as typed ahead.
    std::thread::sleep(Duration::from_millis(300));
    terminal.keys("(list 1)");
    terminal.keys(CTRL_J);
    terminal.keys("(list 2)");
    terminal.line("");
    terminal.wait_for("(1)\n(2)\nCL-USER>");
}

#[test]
fn the_matching_parenthesis_and_the_kinds_of_names_have_colours() {
    let state = State::new("colours");
    let terminal = in_tutorial(&state, &["--color", "always"]);
    terminal.keys("(an action (type going) :k ?v \"s\"");
    terminal.wait_for("\"s\"");
    terminal.keys(")");
    terminal.wait_until("the closing parenthesis", |text| text.contains("\"s\")"));
    let shown = terminal.formatted();
    for piece in ["going", ":k", "?v", "\"s\""] {
        let at = shown
            .find(piece)
            .unwrap_or_else(|| panic!("{piece} in {shown:?}"));
        assert!(shown[..at].ends_with('m'), "{piece} in {shown:?}");
    }
    terminal.keys(CTRL_C);
}

#[test]
fn tab_completes_and_lists_with_a_line_about_each() {
    let state = State::new("tab");
    let terminal = in_tutorial(&state, &[]);
    terminal.keys("(spaw");
    terminal.keys(TAB);
    terminal.wait_for("(spawn-object");
    terminal.keys(" ");
    terminal.wait_for("; (spawn-object *pose* &optional type name color)");
    terminal.keys("\x15(perform (an action (type picking-up) (");
    terminal.keys(TAB);
    terminal.wait_for("object       an object that was detected (needed)");
    terminal.keys("gr");
    terminal.keys(TAB);
    terminal.keys(" ");
    terminal.keys(TAB);
    terminal.wait_for("left-side");
    terminal.keys(CTRL_C);
}

#[test]
fn up_looks_for_what_begins_so_also_in_later_sessions() {
    let state = State::new("history");
    let mut first = Terminal::start(&state, &[]);
    first.evaluate("(list :first)");
    first.evaluate("(+ 1 1)");
    first.evaluate("(list :second)");
    first.keys(CTRL_D);
    assert_eq!(first.exit_status(), Some(0));
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(list");
    terminal.keys(UP);
    terminal.wait_for_last_line("CL-USER> (list :second)");
    terminal.keys(UP);
    terminal.wait_for_last_line("CL-USER> (list :first)");
    terminal.keys(DOWN);
    terminal.wait_for_last_line("CL-USER> (list :second)");
    terminal.keys(CTRL_C);
    terminal.wait_for_last_line("CL-USER>");
    terminal.keys(UP);
    terminal.wait_for_last_line("CL-USER> (list :second)");
    terminal.keys(UP);
    terminal.wait_for_last_line("CL-USER> (+ 1 1)");
    terminal.keys(CTRL_C);
    terminal.wait_for_last_line("CL-USER>");
    terminal.keys(CTRL_R);
    terminal.keys("fir");
    terminal.wait_for("(list :first)");
    terminal.keys(ENTER);
    terminal.wait_for("(:FIRST)");
}

#[test]
fn a_pasted_session_runs_without_its_prompts_and_output() {
    let state = State::new("paste");
    let terminal = Terminal::start(&state, &[]);
    terminal.paste(
        "CL-USER> (in-package :pp-tut)\n#<PACKAGE \"OLD\">\nPP-TUT> (car 5)\nold report\n\
         PP-TUT> (list 1\n  2)\n(1 2)\n",
    );
    terminal.keys(ENTER);
    terminal.wait_for(
        "; Not evaluated, since it looks like output; :pasted brings it back:\n\
         ;   #<PACKAGE \"OLD\">\n;   old report\n;   (1 2)\n",
    );
    terminal.wait_for("; Evaluation aborted on #<TYPE-ERROR");
    terminal.wait_for("(1 2)\nPP-TUT>");
    terminal.keys(":pasted\r");
    terminal.wait_for("PP-TUT> #<PACKAGE \"OLD\">");
}

#[test]
fn forms_after_a_comment_and_prompts_in_a_line_are_evaluated() {
    let state = State::new("tutorial");
    let terminal = Terminal::start(&state, &[]);
    terminal.paste("CL-USER> (list 1)\n;; A comment.\n\n(list\n  2)\n");
    terminal.keys(ENTER);
    terminal.wait_for("(1)\n(2)\nCL-USER>");
    terminal.paste("CL-USER> (list 3) CL-USER> (in-package :pp-tut)");
    terminal.keys(ENTER);
    terminal.wait_for(
        "(3)\nCL-USER> (in-package :pp-tut)\n#<PACKAGE \"CRAM-PICK-PLACE-TUTORIAL\">\nPP-TUT>",
    );
}

#[test]
fn what_is_pasted_where_an_evaluation_stands_still_leaves_it_there() {
    let state = State::new("nested");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(list nothing-yet)\r");
    terminal.wait_for("CL-USER 1]>");
    terminal.paste("CL-USER> (list 1)\nCL-USER> (car 2)\nCL-USER> (list 3)");
    terminal.keys(ENTER);
    terminal.wait_for(
        "; Not evaluated, since an input before it failed; :pasted brings it back:\n;   (list 3)\nCL-USER 2]>",
    );
    terminal.keys("a\r");
    terminal.wait_for("CL-USER 1]>");
    terminal.keys("1 5\r");
    terminal.wait_for("(5)\nCL-USER>");
}

#[test]
fn a_paste_of_several_forms_evaluates_each_in_order() {
    let state = State::new("forms");
    let terminal = Terminal::start(&state, &[]);
    terminal.paste("(list 1)\n(list 2)\n(list 3)");
    terminal.keys(ENTER);
    terminal.wait_for("(1)\n(2)\n(3)\nCL-USER>");
}

#[test]
fn what_is_typed_ahead_or_pasted_without_brackets_is_evaluated_in_order() {
    let state = State::new("ahead");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(list 1)\r(list 2)\r(dotimes (i 3000000) i)\r");
    terminal.wait_for("(1)");
    terminal.keys("(list 3)\r");
    terminal.keys("(list 4)\r");
    terminal.wait_for("(2)");
    terminal.wait_for("(3)");
    terminal.wait_for("(4)\nCL-USER>");
}

#[test]
fn a_condition_opens_a_level_with_numbered_restarts() {
    let state = State::new("debugger");
    let terminal = in_tutorial(&state, &[]);
    terminal.evaluate("(defun f (x) (let ((y (* 2 x))) (list y zork)))");
    terminal.line("(f 4)");
    terminal.wait_for("1: [USE-VALUE] Use specified value.");
    terminal.wait_for_last_line("PP-TUT 1]>");
    terminal.line(":bt");
    terminal.wait_for("*  0: (F 4)");
    terminal.line(":locals");
    terminal.wait_for("Y = 8");
    terminal.line("(+ x y)");
    terminal.wait_for("\n12\n");
    terminal.line("1 (list x)");
    terminal.wait_for("(8 (4))\nPP-TUT>");
    terminal.line("(f 5)");
    terminal.wait_for_last_line("PP-TUT 1]>");
    terminal.line("q");
    terminal.wait_for("; Evaluation aborted on #<UNBOUND-VARIABLE");
    terminal.wait_for_last_line("PP-TUT>");
}

#[test]
fn a_form_is_changed_and_retried() {
    let state = State::new("edit");
    let terminal = Terminal::start(&state, &[]);
    terminal.line("(list (car 5))");
    terminal.wait_for_last_line("CL-USER 1]>");
    terminal.line(":edit");
    terminal.wait_for_last_line("CL-USER 1] form> (list (car 5))");
    terminal.keys(LEFT);
    terminal.keys(LEFT);
    terminal.keys("\x7f'(5)");
    terminal.keys(ENTER);
    terminal.wait_for("\n(5)\nCL-USER>");
}

#[test]
fn ctrl_c_stops_and_asks() {
    let state = State::new("interrupt");
    let terminal = in_tutorial(&state, &[]);
    terminal.line("(progn (print :begun) (loop))");
    terminal.wait_for("\n:BEGUN");
    terminal.keys(CTRL_C);
    terminal.wait_for("0: Continue.");
    // A second one aborts.
    terminal.wait_for_last_line("PP-TUT stopped>");
    terminal.keys(CTRL_C);
    terminal.wait_for("; Evaluation aborted on #<INTERACTIVE-INTERRUPT>.");
    terminal.wait_for_last_line("PP-TUT>");
    // It clears an input, and never ends the session.
    terminal.keys("(half a form");
    terminal.wait_for_last_line("PP-TUT> (half a form");
    terminal.keys(CTRL_C);
    terminal.wait_for_last_line("PP-TUT>");
    terminal.evaluate("(list :alive)");
    assert!(terminal.text().contains("(:ALIVE)"));
}

#[test]
fn a_motion_that_was_interrupted_goes_on_to_the_same_end() {
    let state = State::new("motion");
    let undisturbed = in_tutorial(&state, &[]);
    undisturbed.evaluate(DRIVE);
    let expected = hash_of(&undisturbed);
    let terminal = in_tutorial(&state, &["--realtime=2"]);
    terminal.line(DRIVE);
    terminal.wait_for("… driving");
    terminal.keys(CTRL_C);
    terminal.wait_for("0: Continue.");
    terminal.line("0");
    terminal.wait_for("\nNIL\nPP-TUT>");
    assert_eq!(hash_of(&terminal), expected);
    assert!(
        !terminal.text().contains("… driving"),
        "{}",
        terminal.text()
    );
}

#[test]
fn an_interrupted_plan_can_be_aborted_and_the_arms_parked() {
    let state = State::new("park");
    let terminal = in_tutorial(&state, &["--realtime=4"]);
    terminal.line(DRIVE);
    terminal.wait_for("… driving");
    terminal.keys(CTRL_C);
    terminal.wait_for("2: Abort, and park the arms.");
    terminal.line("2");
    terminal.wait_for("; Evaluation aborted on #<INTERACTIVE-INTERRUPT>.");
    terminal.wait_for("\nNIL\nPP-TUT>");
}

#[test]
fn ctrl_d_leaves_and_asks_first_when_a_plan_stands_still() {
    let state = State::new("leave");
    let mut terminal = Terminal::start(&state, &[]);
    terminal.line("(car 5)");
    terminal.wait_for_last_line("CL-USER 1]>");
    terminal.keys(CTRL_D);
    terminal.wait_for("Leave anyway? (y or n)");
    terminal.line("n");
    terminal.wait_for_last_line("CL-USER 1]>");
    terminal.line("q");
    terminal.wait_for_last_line("CL-USER>");
    terminal.keys(CTRL_D);
    assert_eq!(terminal.exit_status(), Some(0));
}

#[test]
fn after_kill_9_the_session_goes_on_with_the_same_world() {
    let state = State::new("resume");
    let spawn = "(spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))";
    let mut undisturbed = in_tutorial(&state, &[]);
    undisturbed.evaluate(spawn);
    undisturbed.evaluate("(defparameter *here* :kept)");
    undisturbed.evaluate(DRIVE);
    let expected = hash_of(&undisturbed);
    undisturbed.kill();

    let mut killed = in_tutorial(&state, &["--realtime=1"]);
    killed.evaluate(spawn);
    killed.evaluate("(defparameter *here* :kept)");
    killed.line(DRIVE);
    killed.wait_for("… driving");
    killed.kill();

    let mut terminal = Terminal::start_resumed(&state);
    terminal.wait_for("; Input 4 began, but nothing says that it ended:");
    terminal.wait_for("Evaluate it again? If not, it is left out. (y or n)");
    terminal.line("y");
    terminal.wait_for("; Resumed 4 inputs; the world's hash is");
    assert!(terminal.text().contains(&expected), "{}", terminal.text());
    terminal.wait_for_last_line("PP-TUT>");
    assert_eq!(hash_of(&terminal), expected);
    terminal.evaluate("*here*");
    assert!(terminal.text().contains(":KEPT"));
    terminal.keys(CTRL_D);
    assert_eq!(terminal.exit_status(), Some(0));
}

#[test]
fn an_input_that_ended_the_program_is_left_out_and_not_asked_about_again() {
    let state = State::new("poison");
    let mut terminal = Terminal::start(&state, &[]);
    terminal.evaluate("(defvar *precious* 42)");
    let sign = state.path().join("begun");
    let name = sign.to_str().expect("a path");
    terminal.line(&format!(
        "(progn (open {name:?} :direction :output) (loop))"
    ));
    terminal.wait_until("the evaluation", |_| sign.exists());
    terminal.kill();
    let mut resumed = Terminal::start_resumed(&state);
    resumed.wait_for(";   (progn (open ");
    resumed.wait_for("Evaluate it again?");
    resumed.line("n");
    resumed.wait_for("; Resumed 1 input;");
    resumed.wait_for_last_line("CL-USER>");
    resumed.evaluate("(defvar *later* (1+ *precious*))");
    resumed.kill();
    let again = Terminal::start_resumed(&state);
    again.wait_for("; Resumed 2 inputs;");
    again.wait_for_last_line("CL-USER>");
    again.evaluate("(list *precious* *later*)");
    assert!(again.text().contains("(42 43)"), "{}", again.text());
}

#[test]
fn two_sessions_never_write_to_one_journal() {
    let state = State::new("two-sessions");
    let file = state.path().join("shared.journal");
    let file = file.to_str().expect("a path");
    let resume = format!("--resume={file}");
    let mut first = Terminal::start(&state, &["--journal", file]);
    first.evaluate("(defvar *precious* 42)");
    let mut second = Terminal::start(&state, &[&resume]);
    second.wait_for("belongs to a running session.");
    second.evaluate("(defvar *second* (list 1 2 3))");
    first.evaluate("(defvar *third* 3)");
    first.kill();
    second.evaluate("(defvar *fourth* 4)");
    second.kill();
    let mut first = Terminal::start(&state, &[&resume]);
    first.wait_for("; Resumed 2 inputs;");
    first.evaluate("(list *precious* *third*)");
    assert!(first.text().contains("(42 3)"), "{}", first.text());
    // The copy was written last, and nobody has it now.
    let second = Terminal::start(&state, &["--resume"]);
    second.wait_for("; Resumed 3 inputs;");
    second.evaluate("(list *precious* *second* *fourth*)");
    assert!(
        second.text().contains("(42 (1 2 3) 4)"),
        "{}",
        second.text()
    );
    first.kill();
}

#[test]
fn what_is_typed_after_an_interrupt_of_resuming_is_kept() {
    let state = State::new("resume-interrupted");
    let mut terminal = Terminal::start(&state, &[]);
    terminal.evaluate("(defvar *a* 1)");
    terminal.evaluate("(defvar *slow* nil)");
    let file = state.path().join("slow");
    let again = state.path().join("again");
    let slow = format!(
        "(setf *slow* (if (probe-file {0:?}) (progn (open {1:?} :direction :output :if-exists :supersede) (loop)) (open {0:?} :direction :output)))",
        file.to_str().expect("a path"),
        again.to_str().expect("a path")
    );
    terminal.evaluate(&slow);
    terminal.evaluate("(defvar *lost* 1)");
    terminal.kill();
    let mut resumed = Terminal::start_resumed(&state);
    resumed.wait_until("the loop", |_| again.exists());
    resumed.keys(CTRL_C);
    resumed.wait_for("; Interrupted at input 3 of 4.");
    resumed.wait_for("this session is kept in");
    resumed.wait_for_last_line("CL-USER stopped>");
    resumed.line("1");
    resumed.wait_for_last_line("CL-USER>");
    resumed.evaluate("(defvar *new* (1+ *a*))");
    resumed.kill();
    let again = Terminal::start_resumed(&state);
    again.wait_for("; Resumed 5 inputs;");
    again.wait_for_last_line("CL-USER>");
    again.evaluate("(list *a* *new* (boundp '*lost*))");
    assert!(again.text().contains("(1 2 NIL)"), "{}", again.text());
}

#[test]
fn an_interrupt_of_resuming_in_the_middle_of_a_builtin_is_heard() {
    let state = State::new("resume-builtin");
    let mut terminal = Terminal::start(&state, &[]);
    terminal.evaluate("(defvar *slow* nil)");
    let file = state.path().join("slow");
    terminal.evaluate(&format!(
        "(setf *slow* (prog1 (integer-length (expt 3 (if (probe-file {0:?}) 40000000 2))) (open {0:?} :direction :output)))",
        file.to_str().expect("a path")
    ));
    terminal.kill();
    let resumed = Terminal::start_resumed(&state);
    resumed.wait_for("; Input 2 of 2");
    // It is in the middle soon; if this comes before, the same is to happen.
    std::thread::sleep(Duration::from_millis(100));
    resumed.keys(CTRL_C);
    resumed.wait_for("; Interrupted at input 2 of 2.");
    resumed.wait_for_last_line("CL-USER 1]>");
}

#[test]
fn an_interrupt_of_resuming_is_heard_although_cleaning_up_follows() {
    let state = State::new("resume-cleaning");
    let mut terminal = Terminal::start(&state, &[]);
    let file = state.path().join("slow");
    let slow = format!(
        "(setf *slow* (if (probe-file {0:?}) (unwind-protect (loop) (world-hash)) (open {0:?} :direction :output)))",
        file.to_str().expect("a path")
    );
    terminal.paste(&format!(
        "CL-USER> (defvar *slow* nil)\nCL-USER> {slow}\nCL-USER> (defvar *lost* 1)"
    ));
    terminal.line("");
    terminal.wait_for("*LOST*\nCL-USER>");
    terminal.kill();
    let resumed = Terminal::start_resumed(&state);
    resumed.wait_for("; Input 2 of 3");
    resumed.keys(CTRL_C);
    resumed.wait_for("; Interrupted at input 2 of 3.");
    resumed.wait_for_last_line("CL-USER>");
    resumed.evaluate("(list *slow* (boundp '*lost*))");
    assert!(resumed.text().contains("(NIL NIL)"), "{}", resumed.text());
}

#[test]
fn a_session_that_stood_still_is_resumed_where_it_stood() {
    let state = State::new("resume-level");
    let mut terminal = in_tutorial(&state, &[]);
    terminal.evaluate("(defun f (x) (list x (car 5)))");
    terminal.line("(f :here)");
    terminal.wait_for_last_line("PP-TUT 1]>");
    terminal.kill();
    let resumed = Terminal::start_resumed(&state);
    resumed.wait_for("; Resumed 3 inputs");
    resumed.wait_for("2: [ABORT] Return to the top level.");
    resumed.wait_for_last_line("PP-TUT 1]>");
    resumed.line(":locals");
    resumed.wait_for("X = :HERE");
}

#[test]
fn an_interrupted_session_is_resumed_to_where_it_was_interrupted() {
    let state = State::new("resume-interrupt");
    let mut terminal = in_tutorial(&state, &["--realtime=2"]);
    terminal.line(DRIVE);
    terminal.wait_for("… driving");
    terminal.keys(CTRL_C);
    terminal.wait_for("1: Abort.");
    terminal.line("1");
    terminal.wait_for_last_line("PP-TUT>");
    let expected = hash_of(&terminal);
    terminal.kill();
    let resumed = Terminal::start_resumed(&state);
    resumed.wait_for_last_line("PP-TUT>");
    assert_eq!(hash_of(&resumed), expected);
}

#[test]
fn the_state_after_an_entry_of_a_transcript_is_looked_at() {
    let state = State::new("stop-at");
    let path = state.path().join("a.transcript");
    let text = "CL-USER> (defparameter *a* 1)\n*A*\n\nCL-USER> (setf *a* 2)\n2\n\nCL-USER> (setf *a* 3)\n3\n";
    std::fs::write(&path, text).expect("it is written");
    let file = path.to_str().expect("a path");
    let terminal = Terminal::start(&state, &["replay", "--stop-at", "2", file]);
    terminal.wait_for("; The state after entry 2 of 3");
    terminal.evaluate("(list *a* :there)");
    assert!(terminal.text().contains("(2 :THERE)"));
}

#[test]
fn without_a_terminal_there_is_no_debugger() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    let mut input = child.stdin.take().expect("a pipe");
    std::io::Write::write_all(&mut input, b"(car 5)\n(list 2)\n").expect("it listens");
    drop(input);
    let output = child.wait_with_output().expect("it ends");
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(
        text.contains("; Evaluation aborted on #<TYPE-ERROR"),
        "{text}"
    );
    assert!(text.ends_with("(2)\n"), "{text}");
    assert!(!text.contains("[ABORT]"), "{text}");
}

#[test]
fn a_form_of_500_lines_can_be_pasted_and_typed_on() {
    let state = State::new("long");
    let terminal = Terminal::start(&state, &[]);
    let mut form = "(list\n".to_owned();
    for number in 0..500 {
        form.push_str(&format!(
            "  (list :line {number} \"text\" ?variable) ; {number}\n"
        ));
    }
    terminal.paste(&form);
    terminal.wait_for("; 499");
    let mut typed = String::new();
    for key in ["a", "b", "c"] {
        typed.push_str(key);
        terminal.keys(key);
        terminal.wait_until("the key", |text| text.ends_with(&typed));
    }
    terminal.keys(CTRL_C);
}
