//! What a command writes never destroys what it reads, and is tried before anything runs.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A folder of this test; removed with the value.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let name = format!("planwright-outputs-{}-{name}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }

    fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).expect("a file");
        path
    }

    fn run(&self, arguments: &[&str]) -> Output {
        Command::new(env!("CARGO_BIN_EXE_planwright"))
            .current_dir(&self.0)
            .args(arguments)
            .output()
            .expect("the program runs")
    }

    /// An error before anything is printed, which says that.
    fn refuses(&self, arguments: &[&str], why: &str) {
        let output = self.run(arguments);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(why), "{arguments:?}: {error}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn text(path: &Path) -> String {
    std::fs::read_to_string(path).expect("it is there")
}

const PLAN: &str = "(print :running)\n";
const SWEEP: &str = "(defsweep s (:worlds 2) (vary (x (uniform 0 1))) (run (print x)))\n";

#[test]
fn an_output_that_is_an_input_is_refused_by_every_command() {
    let folder = Folder::new("inputs");
    let plan = folder.file("x.plan", PLAN);
    let sweep = folder.file("s.plan", SWEEP);
    let recorded = folder.run(&["run", "x.plan", "--record", "r.mcap"]);
    assert!(recorded.status.success());
    let recording = std::fs::read(folder.0.join("r.mcap")).expect("it is there");
    for arguments in [
        &["picture", "x.plan", "-o", "x.plan"][..],
        &["picture", "x.plan", "--gif", "./x.plan"],
        &["run", "x.plan", "--record", "x.plan"],
        &["run", "x.plan", "--html", "x.plan"],
        &["sweep", "s.plan", "--csv", "s.plan"],
        &["sweep", "s.plan", "--junit", "s.plan"],
        &["sweep", "s.plan", "--html", "s.plan"],
        &["sweep", "s.plan", "--compare", "x.plan", "--csv", "x.plan"],
        &["view", "r.mcap", "--html", "r.mcap"],
    ] {
        folder.refuses(arguments, "would overwrite");
    }
    assert_eq!(text(&plan), PLAN);
    assert_eq!(text(&sweep), SWEEP);
    assert_eq!(std::fs::read(folder.0.join("r.mcap")).ok(), Some(recording));
}

#[test]
fn outputs_are_tried_before_the_plan_runs() {
    let folder = Folder::new("tried");
    folder.file("x.plan", PLAN);
    folder.file("s.plan", SWEEP);
    folder.refuses(&["picture", "x.plan", "-o", "none/x.png"], "none/x.png");
    folder.refuses(&["picture", "x.plan", "--frames", "x.plan/f"], "x.plan/f");
    folder.refuses(&["sweep", "s.plan", "--csv", "none/s.csv"], "none/s.csv");
    folder.refuses(
        &["sweep", "s.plan", "--csv", "s.txt", "--junit", "./s.txt"],
        "both write",
    );
    assert!(!folder.0.join("s.txt").exists());
}

#[test]
fn frames_are_not_mixed_with_others() {
    let folder = Folder::new("frames");
    folder.file("x.plan", PLAN);
    std::fs::create_dir(folder.0.join("film")).expect("a folder");
    folder.file("film/notes.txt", "mine");
    let film = [
        "picture", "x.plan", "--frames", "film", "--width", "32", "--height", "32",
    ];
    assert!(folder.run(&film).status.success());
    assert!(folder.0.join("film/frame-0001.png").exists());
    folder.refuses(&film, "has frames already, such as frame-0001.png");
}

#[test]
fn what_killed_processes_have_left_of_shards_is_removed() {
    let folder = Folder::new("shards");
    folder.file("s.plan", SWEEP);
    let whole = folder.run(&["sweep", "s.plan", "--into", "job", "--shards", "2"]);
    assert!(whole.status.success());
    let left = folder.file("job/shard-0.jsonl.tmp.4000001", "half");
    let other = folder.file("job/shard-7.jsonl.tmp.4000001", "of no shard that is there");
    let report = folder.run(&["sweep", "--report", "job"]);
    assert!(report.status.success());
    assert!(!left.exists());
    assert!(other.exists());
}
