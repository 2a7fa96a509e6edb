//! Sweeps on the command line.

use std::path::PathBuf;
use std::process::{Command, Output};

/// A file in a folder of this process.
fn scratch(name: &str, text: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("planwright-sweeps-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder can be made");
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a file can be written");
    path
}

/// The same worlds on any number of threads.
const SWEEP: &str = "
    (defsweep light (:worlds 30)
      (vary (x (uniform 0 1))
            (cup (object cup :on table-area-main)))
      (run (when (< x 0.2) (error 'end-of-file)) (random 1.0))
      (expect (there (upright-p cup)) (rarely (> x 0.3)))
      (measure (twice (* 2 x)))
      (goal (success :at-least 0.5)))";

fn planwright(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(arguments)
        .output()
        .expect("the program runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn threads_do_not_matter() {
    let file = scratch("light.plan", SWEEP);
    let file = file.to_str().expect("a name");
    let run =
        |threads: &str| planwright(&["sweep", file, "--seed", "5", "--threads", threads, "--json"]);
    let one = run("1");
    assert_eq!(one.status.code(), Some(0), "{}", text(&one.stderr));
    assert_eq!(text(&one.stdout).lines().count(), 30);
    for threads in ["2", "7"] {
        assert_eq!(text(&run(threads).stdout), text(&one.stdout));
    }
    let shown = planwright(&["sweep", file, "LIGHT", "--seed", "5", "--worlds", "4"]);
    assert!(text(&shown.stdout).starts_with("light   seed 5   4 worlds\nsuccess  "));
}

#[test]
fn a_goal_that_is_missed_and_a_wrong_file_have_their_statuses() {
    let file = scratch("missed.plan", &SWEEP.replace("0.5)))", "0.99)))"));
    let missed = planwright(&["sweep", file.to_str().expect("a name"), "--worlds", "20"]);
    assert_eq!(missed.status.code(), Some(1));
    assert!(text(&missed.stdout).contains("goal 99 %: NOT MET"));
    let file = scratch("broken.plan", "\n(defsweep light (");
    let broken = planwright(&["sweep", file.to_str().expect("a name")]);
    assert_eq!(broken.status.code(), Some(2));
    assert!(
        text(&broken.stderr).contains("broken.plan:2:"),
        "{}",
        text(&broken.stderr)
    );
    let file = scratch("none.plan", SWEEP);
    let none = planwright(&["sweep", file.to_str().expect("a name"), "ligth"]);
    assert_eq!(none.status.code(), Some(2));
    assert!(
        text(&none.stderr).contains("did you mean light?"),
        "{}",
        text(&none.stderr)
    );
}
