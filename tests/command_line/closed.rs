//! Sessions that are closed: plans move the robot, and that is all.

use std::fs;
use std::path::PathBuf;
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
