//! Text that reaches the prompt in other ways than keys and bracketed paste: without its line breaks,
//! without brackets, while a form runs; and keys at moments when nobody expects them.

use super::pseudo_terminal::{CTRL_C, CTRL_D, ENTER, State, TAB, Terminal};

#[test]
fn a_comment_that_has_swallowed_code_ends_and_says_so() {
    let state = State::new("flat");
    let terminal = Terminal::start(&state, &[]);
    terminal.paste("CL-USER> (list ;; The first. 1 (+ 1 1) ;; The last. '(3))");
    terminal.keys(ENTER);
    terminal.wait_for("; Line breaks were lost, so that a comment had swallowed code.");
    terminal.wait_for("(2 (3))\nCL-USER>");
}

#[test]
fn text_without_paste_brackets_is_indented_by_its_tabs() {
    let state = State::new("tabs");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(let ((velocity 3)\r\t(time 2))\r\t(* velocity time))\r");
    terminal.wait_for("\n6\nCL-USER>");
    let text = terminal.text();
    let shown =
        "CL-USER> (let ((velocity 3)\n               (time 2))\n           (* velocity time))\n";
    assert!(text.contains(shown), "{text}");
    // In a string a tab is a tab.
    terminal.keys("(length \"a\r\t\")\r");
    terminal.wait_for("\n3\nCL-USER>");
}

#[test]
fn what_is_pasted_while_a_form_runs_is_no_list_of_answers() {
    let state = State::new("running");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(defvar *drawer* 0)\r");
    terminal.wait_for("*DRAWER*\nCL-USER>");
    terminal.keys("(progn (print :begun) (dotimes (i 2000000) i) (car 5))\r");
    terminal.wait_for("\n:BEGUN");
    terminal.keys("CL-USER> (list (zerop *drawer*)\r  1)\r(T 1)\r\rCL-USER> (+ 1 2)\r3\r");
    terminal.wait_for("CL-USER 1]> (list (zerop *drawer*)");
    terminal.wait_for("\n(T 1)\n");
    terminal.wait_for("\n3\nCL-USER 1]>");
    let text = terminal.text();
    assert!(
        text.contains("; Not evaluated, since it looks like output"),
        "{text}"
    );
    assert!(!text.contains("CL-USER 2]>"), "{text}");
    terminal.keys("q\r");
    terminal.wait_for_last_line("CL-USER>");
}

#[test]
fn a_session_that_is_pasted_without_brackets_is_one_text() {
    let state = State::new("unbracketed");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("CL-USER> (list nil\r  1)\r(NIL 1)\r\rCL-USER> (+ 1 2)\r3\r");
    terminal.wait_for("CL-USER> (+ 1 2)\n3\nCL-USER>");
    let text = terminal.text();
    assert!(!text.contains("CL-USER 1]>"), "{text}");
}

#[test]
fn a_line_that_is_begun_while_a_form_runs_is_offered_for_editing() {
    let state = State::new("begun");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(progn (print :begun) (dotimes (i 2000000) i) (list 1))\r");
    terminal.wait_for("\n:BEGUN");
    terminal.keys("(list 2)\r(list 3");
    terminal.wait_for("\n(1)\n");
    terminal.wait_for("\n(2)\nCL-USER> (list 3");
    terminal.keys(" 4)\r");
    terminal.wait_for("\n(3 4)\nCL-USER>");
}

#[test]
fn ctrl_d_that_is_typed_ahead_leaves_when_its_turn_comes() {
    let state = State::new("leave");
    let mut terminal = Terminal::start(&state, &[]);
    terminal.keys("(list 1)\r(list 2)\r");
    terminal.keys(CTRL_D);
    terminal.wait_for("(1)");
    terminal.wait_for("(2)");
    assert_eq!(terminal.exit_status(), Some(0));
}

#[test]
fn ctrl_c_right_after_enter_is_heard() {
    let state = State::new("at-once");
    let terminal = Terminal::start(&state, &[]);
    for round in 0..20 {
        // In one piece: the line editor has read it before the form is evaluated.
        terminal.keys(&format!("(progn {round} (loop))\r{CTRL_C}"));
        terminal.wait_for_last_line("CL-USER stopped>");
        terminal.keys("1\r");
        terminal.wait_for_last_line("CL-USER>");
        terminal.keys(&format!("(progn {round} (loop))\r"));
        terminal.keys(CTRL_C);
        terminal.wait_for_last_line("CL-USER stopped>");
        terminal.keys("1\r");
        terminal.wait_for_last_line("CL-USER>");
    }
}

#[test]
fn ctrl_c_is_heard_while_the_session_waits_for_a_pipe() {
    let state = State::new("pipe");
    let pipe = state.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    let terminal = Terminal::start(&state, &[]);
    let pipe = pipe.display();
    for form in [
        format!("(with-open-file (in \"{pipe}\") (read-line in))"),
        format!("(with-open-file (to \"{pipe}\" :direction :output :if-exists :append) 1)"),
        "(with-open-file (in \"/dev/tty\") (read-line in))".to_owned(),
    ] {
        terminal.line(&format!("(progn (print :waits) {form})"));
        terminal.wait_until("the form to wait", |text| text.ends_with(":WAITS"));
        terminal.keys(CTRL_C);
        terminal.wait_for_last_line("CL-USER 1]>");
        terminal.keys("q\r");
        terminal.wait_for_last_line("CL-USER>");
        terminal.keys("\x0c");
        terminal.wait_until("an empty screen", |text| text == "CL-USER>");
    }
}

#[test]
fn a_question_about_completions_is_left_by_ctrl_c() {
    let state = State::new("menu");
    let terminal = Terminal::start(&state, &[]);
    // So many candidates that it asks whether to show them, and so many that it asks for each page.
    for (begun, question, rest, value) in [
        (
            "(c",
            "possibilities? (y or n)",
            "ar '(1))\r",
            "\n1\nCL-USER>",
        ),
        ("(d", "--More--", "igit-char-p #\\5)\r", "\n5\nCL-USER>"),
    ] {
        terminal.keys(begun);
        terminal.keys(TAB);
        terminal.wait_for(question);
        terminal.keys(CTRL_C);
        terminal.wait_for_last_line(&format!("CL-USER> {begun}"));
        terminal.keys(rest);
        terminal.wait_for(value);
    }
}

#[test]
fn the_keys_of_the_tutorial_work() {
    let state = State::new("keys");
    let terminal = Terminal::start(&state, &[]);
    terminal.evaluate("(list 1)");
    terminal.evaluate("(list 2)");
    terminal.keys("\x1b[1;5A");
    terminal.wait_for_last_line("CL-USER> (list 2)");
    terminal.keys("\x1b[1;5A");
    terminal.wait_for_last_line("CL-USER> (list 1)");
    terminal.keys("\x1b[1;5B");
    terminal.wait_for_last_line("CL-USER> (list 2)");
    terminal.keys("\x1b\x08");
    terminal.wait_for_last_line("CL-USER>");
    terminal.keys("(list\r 3");
    terminal.wait_for("3");
    terminal.keys("\x1b\x08");
    terminal.wait_for_last_line("CL-USER>");
}

#[test]
fn a_new_line_says_what_is_open() {
    let state = State::new("open");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(defun f (x)\r(list x\r");
    terminal.wait_for("; open: (defun (list");
    terminal.keys("\"a\r");
    terminal.wait_for("; open: a string");
    terminal.keys(CTRL_C);
}

#[test]
fn values_have_a_colour_only_if_colours_are_wanted() {
    let state = State::new("colour");
    let terminal = Terminal::start(&state, &[]);
    terminal.evaluate("(list 1 2)");
    assert!(terminal.formatted().contains("\x1b[31m(1 2)"));
    let state = State::new("no-colour");
    let terminal = Terminal::start(&state, &["--color", "never"]);
    terminal.evaluate("(list 1 2)");
    assert!(!terminal.formatted().contains("\x1b[31m"));
}

#[test]
fn the_windows_size_changes_all_the_time_and_keys_are_heard() {
    let state = State::new("sizes");
    let terminal = Terminal::start(&state, &[]);
    terminal.keys("(list 1 2");
    terminal.wait_for("(list 1 2");
    for round in 0..2000u16 {
        terminal.resize(24, 80 + round % 40);
    }
    terminal.resize(50, 110);
    terminal.keys(" 3)\r");
    terminal.wait_for("\n(1 2 3)\nCL-USER>");
}

#[test]
fn a_narrower_window_shows_a_long_line_once() {
    let state = State::new("narrow");
    // This terminal leaves lines as they are.
    let terminal = Terminal::start_with(&state, &[], &[("XTERM_VERSION", "XTerm(1)")]);
    terminal.evaluate("(list :before)");
    terminal.keys("(list \"日本語 \t tab\" 1234567890 1234567890 1234567890 1234567890 :end)");
    terminal.wait_for(":end)");
    // The next size comes when the program has drawn for the last one: a real terminal, too, would
    // show rows of one width in a window of another.
    for (columns, rows) in [(60, 2), (41, 2), (23, 4), (90, 1)] {
        terminal.resize(50, columns);
        terminal.wait_until("the line once, whole", |text| {
            text.matches("(list \"日本語").count() == 1
                && text.matches("1234567890").count() == 4
                && text.ends_with(":end)")
                && text.contains("(:BEFORE)")
                && terminal.rows_from("CL-USER> (list \"") == Some(rows)
        });
    }
    terminal.resize(50, 110);
    terminal.keys(ENTER);
    terminal.wait_for("CL-USER>");
    terminal.wait_until("a value", |text| text.matches("1234567890").count() == 8);
}

#[test]
fn built_in_files_are_loaded_wherever_the_program_is_started() {
    let state = State::new("elsewhere");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_planwright"))
        .current_dir(state.path())
        .args(["run", "--eval", "(load \"plans/tutorial/skills.plan\")"])
        .args(["--eval", "(fboundp 'pp-tut::go-to)"])
        .output()
        .expect("the program runs");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(text, "T\nT\n");
    // A file of that name comes first.
    std::fs::create_dir_all(state.path().join("plans/tutorial")).expect("a folder");
    std::fs::write(
        state.path().join("plans/tutorial/skills.plan"),
        "(print :own)",
    )
    .expect("a file");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_planwright"))
        .current_dir(state.path())
        .args(["run", "./plans/tutorial/skills.plan"])
        .output()
        .expect("the program runs");
    assert!(String::from_utf8_lossy(&output.stdout).contains(":OWN"));
}
