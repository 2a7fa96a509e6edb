//! Sessions that are closed: plans move the robot, and that is all.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn folder(name: &str) -> PathBuf {
    let folder =
        std::env::temp_dir().join(format!("planwright-closed-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Standard output and standard error of forms in a closed session with a bottle.
fn closed(name: &str, forms: &[&str]) -> (Option<i32>, String, String) {
    let folder = folder(name);
    let setup = folder.join("setup.plan");
    fs::write(
        &setup,
        "(in-package :pp-tut) (init-projection) (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottle 'bottle-1)",
    )
    .unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_planwright"));
    command.args(["run", "--closed", "--setup"]).arg(&setup);
    for form in forms {
        command.args(["--eval", form]);
    }
    let output = command
        .current_dir(&folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let left: Vec<_> = fs::read_dir(&folder).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
    fs::remove_dir_all(&folder).unwrap();
    (
        output.status.code(),
        String::from_utf8(output.stdout).unwrap(),
        String::from_utf8(output.stderr).unwrap(),
    )
}

#[test]
fn a_closed_session_hands_over() {
    let plan = "(in-package :pp-tut)
        (with-simulated-robot
          (let ((?bottle (an object (type bottle))))
            (perform (an action (type searching) (object ?bottle)))
            (perform (an action (type fetching) (object ?bottle) (arm right)))
            (perform (an action (type handing-over) (object ?bottle) (to left)))))
        (pp-plans::objects-in-hand :left)";
    let (status, out, err) = closed("hands-over", &[plan]);
    assert_eq!(status, Some(0), "{err}");
    assert!(out.trim_end().ends_with("(BOTTLE-1)"), "{out}");
}

#[test]
fn a_closed_session_refuses_files_ports_and_edits() {
    for form in [
        "(open \"made.txt\" :direction :output)",
        "(load \"setup.plan\")",
        "(directory \"*.plan\")",
        "(delete-file \"setup.plan\")",
        "(rename-file \"setup.plan\" \"other.plan\")",
        "(ensure-directories-exist \"made/\")",
        "(picture)",
        "(record \"made.mcap\")",
        "(save-view \"made.html\")",
        "(save-transcript \"made.transcript\")",
        "(view)",
        "(swank:create-server :port 0)",
        "(pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :cup 'cup-1)",
        "(btr-utils:kill-all-objects)",
        "(btr-utils:move-object 'pp-tut::bottle-1 '((1 1 1) (0 0 0 1)))",
        "(btr-utils:move-robot '((1 1 0) (0 0 0 1)))",
        "(rewind)",
        "(set-noise :position 0.1)",
        "(roslisp-utilities:startup-ros)",
        "(pw::%sweep-begin 0 0)",
        "(pw::%sweep-run-ends)",
        "(progn (btr::%begin-trial) (pp-tut::with-simulated-robot (pp-tut::park-arms)))",
    ] {
        let (status, out, err) = closed("refused", &[form]);
        if status == Some(0) {
            // A folder that cannot be looked into has no files.
            assert_eq!(out, "NIL\n", "{form}");
        } else {
            assert_eq!(status, Some(1), "{form}: {err}");
            let says_so = err.contains("closed") || err.contains("has no files");
            assert!(says_so, "{form}: {err}");
        }
    }
}

#[test]
fn what_sets_a_session_up_is_not_overwritten() {
    let folder = folder("overwritten");
    let setup = folder.join("setup.plan");
    fs::write(&setup, "(list 1)").unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_planwright"));
    command.args(["run", "--closed", "--setup"]).arg(&setup);
    command.args(["--eval", "1", "--record"]).arg(&setup);
    let output = command.stdin(Stdio::null()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(fs::read_to_string(&setup).unwrap(), "(list 1)");
    fs::remove_dir_all(&folder).unwrap();
}

/// What a session prints whose inputs come from a pipe.
fn piped(folder: &Path, arguments: &[&str], input: &str) -> String {
    let mut child = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(input.as_bytes()).unwrap();
    drop(stdin);
    let output = child.wait_with_output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    format!("{printed}{}", String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_session_is_resumed_as_closed_as_it_was() {
    let folder = folder("resumed");
    fs::write(folder.join("setup.plan"), "(defparameter *set-up* :yes)").unwrap();
    let edit = "(btr-utils:kill-all-objects)\n";
    let closed = [
        "--closed",
        "--setup",
        "setup.plan",
        "--journal",
        "closed.journal",
    ];
    let printed = piped(&folder, &closed, "*set-up*\n");
    assert!(printed.contains(":YES"), "{printed}");
    let printed = piped(&folder, &["--resume=closed.journal"], edit);
    assert!(printed.contains("This session is closed"), "{printed}");
    piped(&folder, &["--journal", "open.journal"], "(list 1)\n");
    let printed = piped(&folder, &["--resume=open.journal"], edit);
    assert!(!printed.contains("This session is closed"), "{printed}");
    let despite = ["--closed", "--resume=open.journal", "--despite-changes"];
    let printed = piped(&folder, &despite, edit);
    assert!(printed.contains("This session is closed"), "{printed}");
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn plans_run_in_a_closed_session() {
    let (status, out, err) = closed(
        "plans",
        &[
            "(in-package :pp-tut)",
            "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.2))) (park-arms))",
            "(btr-utils:object-exists 'bottle-1)",
        ],
    );
    assert_eq!((status, err.as_str()), (Some(0), ""));
    assert!(out.ends_with("T\n"), "{out}");
}
