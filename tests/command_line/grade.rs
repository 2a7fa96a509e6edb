//! Grading what students hand in: plans that work, plans that do not, and plans that cheat.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A solution of the first lesson.
const GOOD: &str = "
    (defun bring-bottle ()
      (with-simulated-robot
        (get-ready-at *place-at-table*)
        (let ((bottle (find-object :bottle)))
          (bring-to-island bottle (pick-up-object bottle :right)))))";

/// The first half of it.
const HALF: &str = "
    (defun bring-bottle ()
      (with-simulated-robot
        (get-ready-at *place-at-table*)
        (pick-up-object (find-object :bottle) :right)))";

fn folder(name: &str) -> PathBuf {
    let folder =
        std::env::temp_dir().join(format!("planwright-grade-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder can be made");
    folder
}

fn graded(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_planwright"))
        .arg("grade")
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The lines of the table about submissions with these texts, in one world each.
fn lines(name: &str, submissions: &[(&str, &str)]) -> Vec<String> {
    let folder = folder(name);
    let mut arguments = vec!["bring-the-bottle".to_owned()];
    for (name, text) in submissions {
        fs::write(folder.join(name), text).expect("a file can be written");
        arguments.push((*name).to_owned());
    }
    arguments.extend(["--worlds", "1"].map(str::to_owned));
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let output = graded(&folder, &arguments);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    fs::remove_dir_all(&folder).expect("it is there");
    let lines = table.lines().skip(1).take(submissions.len());
    lines.map(str::to_owned).collect()
}

#[test]
fn each_lesson_is_solved_by_its_own_solution() {
    let folder = folder("solutions");
    for lesson in ["bring-the-bottle", "see-more", "better-arm", "look-again"] {
        let output = graded(&folder, &[lesson]);
        let table = text(&output.stdout);
        assert_eq!(
            output.status.code(),
            Some(0),
            "{table}{}",
            text(&output.stderr)
        );
        assert!(table.ends_with("1 of 1 passed\n"), "{table}");
    }
}

#[test]
fn exercises_of_the_tutorial_are_solved_by_their_own_solutions_and_not_by_nothing() {
    let folder = folder("exercises");
    fs::write(folder.join("nothing.plan"), "(in-package :pp-tut)\n").expect("it can be written");
    for lesson in [
        "search-places",
        "where-to-stand",
        "regrasp",
        "no-coordinates",
        "clear-table",
        "own-context",
    ] {
        let solved = graded(&folder, &[lesson, "--worlds", "1"]);
        let table = text(&solved.stdout);
        assert_eq!(solved.status.code(), Some(0), "{table}");
        let unsolved = graded(&folder, &[lesson, "nothing.plan", "--worlds", "1"]);
        let table = text(&unsolved.stdout);
        assert_eq!(unsolved.status.code(), Some(1), "{table}");
        assert!(table.contains("nothing    0 of 1"), "{table}");
    }
}

#[test]
fn submissions_that_cheat_do_not_pass_and_are_told_why() {
    const CLOSED: &str = "This session is closed";
    const LOCKED: &str = "belongs to the locked package";
    const UNDONE: &str = "this was not done: Pick the bottle up.";
    let cheats = [
        (
            "spawns.plan",
            "(defun bring-bottle () (spawn-object '((-0.8 2 0.96) (0 0 0 1)) :bottle 'bottle))",
            CLOSED,
        ),
        (
            "teleports.plan",
            "(defun bring-bottle () (btr-utils:move-object 'bottle '((-0.8 2 0.96) (0 0 0 1))))",
            CLOSED,
        ),
        (
            "restarts.plan",
            "(defun bring-bottle () (roslisp-utilities:startup-ros))",
            CLOSED,
        ),
        (
            "new-world.plan",
            "(defun bring-bottle () (pw::%sweep-begin 0 0))",
            CLOSED,
        ),
        (
            "no-faults.plan",
            "(defun bring-bottle () (pw::%sweep-run-ends))",
            CLOSED,
        ),
        (
            "other-deeds.plan",
            "(defun bring-bottle () (pw::%begin-deeds))",
            CLOSED,
        ),
        ("port.plan", "(view)", CLOSED),
        (
            "file.plan",
            "(open \"made.txt\" :direction :output)",
            "has no files",
        ),
        (
            "predicates.plan",
            "(in-package :planwright) (defun picked-up-p (&rest r) t)",
            LOCKED,
        ),
        ("perform.plan", "(defmacro perform (&rest r) t)", LOCKED),
        (
            "without-locks.plan",
            "(system:without-package-locks
               (setf (symbol-function 'pw:picked-up-p) (constantly t)
                     (symbol-function 'pw:put-down-p) (constantly t)
                     (symbol-function 'pw:on-surface-p) (constantly t)
                     (symbol-function 'pw::%judge-lesson) (constantly t)))
             (defun bring-bottle ())",
            UNDONE,
        ),
        (
            "transporting.plan",
            "(def-action transporting ((object object \"x\")) \"Nothing.\" t)
             (defun bring-bottle ()
               (with-simulated-robot
                 (perform (an action (type transporting) (object (an object (type bottle)))))))",
            UNDONE,
        ),
        (
            "in-a-copy.plan",
            "(defun bring-bottle ()
               (btr::%begin-trial)
               (with-simulated-robot (get-ready-at *place-at-table*)))",
            CLOSED,
        ),
        (
            "forged.plan",
            "(format t \"PASS~%{\\\"Done\\\":null}~%\\\"Done\\\"~%\") (defun bring-bottle ())",
            UNDONE,
        ),
        (
            "half.plan",
            HALF,
            "this was not done: Put it down on the kitchen island.",
        ),
    ];
    let submissions: Vec<(&str, &str)> = cheats
        .iter()
        .map(|(name, text, _)| (*name, *text))
        .collect();
    for (line, (name, _, why)) in lines("cheats", &submissions).iter().zip(&cheats) {
        let student = name.trim_end_matches(".plan");
        assert!(line.starts_with(student), "{line}");
        assert!(
            line.contains(" 0 of 1 ") && line.contains(why),
            "{name}: {line}"
        );
    }
}

#[test]
fn submissions_that_do_not_end_or_are_no_plans_harm_nobody() {
    const ENDLESS: &str = "It calculates without end.";
    let deep = format!("{}1{}", "(list ".repeat(20_000), ")".repeat(20_000));
    let harmful = [
        ("endless.plan", "(defun bring-bottle () (loop))", ENDLESS),
        ("at-load.plan", "(unwind-protect (loop) (loop))", ENDLESS),
        (
            "macro.plan",
            "(defmacro m () (loop)) (defun bring-bottle () (m))",
            ENDLESS,
        ),
        ("reader.plan", "#.(loop)", ENDLESS),
        (
            "allocates.plan",
            "(defun bring-bottle () (let ((all nil)) (loop (push (make-array 1000000) all))))",
            "It takes more memory than it may.",
        ),
        (
            "huge.plan",
            "(make-array 100000000000000)",
            "It takes more memory than it may.",
        ),
        (
            "logs.plan",
            "(loop (format t \"aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa~%\"))",
            "It prints more than 1048576 bytes.",
        ),
        (
            "sleeps.plan",
            "(defun bring-bottle () (with-simulated-robot (loop (cpl:sleep 1))))",
            "It takes more than 300 s of simulated time.",
        ),
        (
            "quits.plan",
            "(quit 0)",
            "It leaves planwright instead of ending.",
        ),
        (
            "recursion.plan",
            "(defun f (x) (1+ (f x))) (f 1)",
            "It stops at recursion.plan:1 with STACK-STORAGE-CONDITION",
        ),
        ("deep.plan", &deep, "It stops with UNDEFINED-FUNCTION"),
        (
            "escapes.plan",
            "(defun bring-bottle () (error \"\u{1b}[2J\u{1b}]0;x\u{7}\"))",
            "It stops at escapes.plan:1 with SIMPLE-ERROR: ^[[2J^[]0;x^G",
        ),
        ("empty.plan", "", "BRING-BOTTLE is undefined."),
        (
            "letter.plan",
            "Dear teacher (this is",
            "The variable DEAR is unbound.",
        ),
        ("zeros.plan", "\0\0\0", "It "),
        ("good.plan", GOOD, "1 of 1"),
    ];
    let submissions: Vec<(&str, &str)> = harmful
        .iter()
        .map(|(name, text, _)| (*name, *text))
        .collect();
    for (line, (name, _, why)) in lines("harmful", &submissions).iter().zip(&harmful) {
        assert!(line.contains(why), "{name}: {line}");
        assert!(!line.contains('\u{1b}'), "{name}: {line}");
        assert_eq!(*name == "good.plan", line.contains(" 1 of 1"), "{line}");
    }
}

#[test]
fn a_class_gets_the_same_marks_on_any_number_of_threads() {
    let folder = folder("class");
    fs::write(folder.join("ann.plan"), GOOD).expect("a file can be written");
    fs::write(folder.join("<b>.plan"), HALF).expect("a file can be written");
    fs::write(folder.join("no-text.plan"), [0xff, 0xfe]).expect("a file can be written");
    let run = |threads: &str| {
        let arguments = [
            "bring-the-bottle",
            "ann.plan",
            "<b>.plan",
            "no-text.plan",
            "missing.plan",
            "--worlds",
            "2",
            "--threads",
            threads,
            "--csv",
            "marks.csv",
            "--junit",
            "marks.xml",
            "--html",
            "pages",
        ];
        let output = graded(&folder, &arguments);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        let mut all = vec![text(&output.stdout)];
        let files = [
            "marks.csv",
            "marks.xml",
            "pages/index.html",
            "pages/ann.html",
            "pages/-b-.html",
        ];
        all.extend(files.map(|file| fs::read_to_string(folder.join(file)).expect(file)));
        all
    };
    let one = run("1");
    let [table, csv, junit, class, ann, half] = &one[..] else {
        panic!("six texts");
    };
    assert!(table.contains("ann        2 of 2\n"), "{table}");
    assert!(
        table.contains("no-text    0 of 2  2 × It cannot be read: it is not UTF-8"),
        "{table}"
    );
    assert!(
        table.contains("missing    0 of 2  2 × It cannot be read: "),
        "{table}"
    );
    assert!(csv.starts_with("student,file,world,passed,"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 4 * 2);
    assert!(
        csv.contains("\r\n<b>,<b>.plan,0,false,expectation,on-the-island,"),
        "{csv}"
    );
    assert!(
        junit.contains("<testsuite name=\"ann\" tests=\"2\" failures=\"0\">"),
        "{junit}"
    );
    assert!(
        class.contains("<a href=\"-b-.html\">&lt;b&gt;</a>"),
        "{class}"
    );
    assert!(class.contains("expectation on-the-island"), "{class}");
    assert!(!ann.contains("<iframe"));
    assert!(half.contains("<iframe title=\"The run in world 0\""));
    let left = fs::read_dir(folder.join("pages")).expect("a folder");
    assert_eq!(left.count(), 5);
    for (at, (text, again)) in one.iter().zip(run("3")).enumerate() {
        assert!(*text == again, "output {at} differs");
    }
    fs::remove_dir_all(&folder).expect("it is there");
}

#[test]
fn mistakes_in_lessons_are_told_with_their_places() {
    let folder = folder("lessons");
    let steps = "(steps (a \"Do it.\" t))";
    let head = "(title \"T\") (text \"T\")";
    for (lesson, said) in [
        (String::new(), "my.lesson: there is no lesson in it"),
        (
            "(print 1)".to_owned(),
            "my.lesson:1:1: (PRINT 1) is no part of a lesson file",
        ),
        (
            format!("(deflesson a {head} (run 1) {steps})\n(deflesson b)"),
            "my.lesson:2:1: a file has one lesson",
        ),
        (
            format!("(deflesson a {head} {steps})"),
            "my.lesson: the lesson a is for the prompt: without (run FORM …) there is nothing to grade",
        ),
        (
            format!("(deflesson a {head} (run 1) (steps (a \"Do it.\" t :hint (\"x\"))))"),
            "is no step of a lesson: ",
        ),
        (
            format!("(deflesson a {head} (run 1) (steps (a \"Do it.\" t :explained 5)))"),
            "is no step of a lesson: ",
        ),
        (
            format!("(deflesson a {head} (run 1) {steps} (stops 1))"),
            "(STOPS 1) is no part of a lesson: (title …), ",
        ),
        (
            format!("(deflesson a {head} (run 1) (steps (a t)))"),
            "(A T) is no step of a lesson: ",
        ),
        (
            format!("(deflesson a {head} (run 1) {steps} (worlds 0))"),
            "0 is no number for (worlds …)",
        ),
        (
            format!("(deflesson a {head} (run 1) {steps}"),
            "my.lesson:1:1: end of file",
        ),
        (
            format!("(deflesson a {head} (run 1) (steps (a \"A.\" (no-such 1))) (solution 1))"),
            "NO-SUCH is undefined",
        ),
        (
            format!("(deflesson a {head} (start (spawn-object 1)) (run 1) {steps} (solution 1))"),
            "[in the lesson, world 0]",
        ),
        (
            format!("(deflesson a {head} (run 1) {steps})"),
            "has no solution that could be graded",
        ),
    ] {
        fs::write(folder.join("my.lesson"), &lesson).expect("a file can be written");
        let output = graded(&folder, &["my.lesson"]);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{lesson}: {}",
            text(&output.stdout)
        );
        let error = text(&output.stderr);
        assert!(error.contains(said), "{lesson}: {error}");
    }
    let output = graded(&folder, &["bring-the-botle"]);
    let error = text(&output.stderr);
    assert!(
        error.contains("there is no lesson bring-the-botle; did you mean bring-the-bottle?"),
        "{error}"
    );
    fs::remove_dir_all(&folder).expect("it is there");
}
