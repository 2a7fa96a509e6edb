//! Questions about many runs.

use std::path::PathBuf;
use std::process::Command;

/// Two worlds that failed, one that succeeded, one that was never judged.
const RECORDS: &str = r#"{"world":0,"outcome":"failure","class":"GRIPPER-CLOSED-COMPLETELY","cause":"NothingGripped","bodies":["BOWL-1"],"expectations":{"parked":false},"draws":{"bottle.y":-0.9,"clutter.1":"CUP"},"faults":[],"time":5.5,"failures":{"GRIPPER-CLOSED-COMPLETELY":2},"handlers":{},"measures":{"drift":3.5}}
{"world":1,"outcome":"failure","class":"GRIPPER-CLOSED-COMPLETELY","cause":"NothingGripped","bodies":[],"expectations":{"parked":true},"draws":{"bottle.y":-0.8},"faults":[],"time":6.25,"failures":{},"handlers":{},"measures":{"drift":3}}
{"world":2,"outcome":"success","class":null,"cause":null,"bodies":[],"expectations":{"parked":true},"draws":{"bottle.y":-1.0},"faults":[],"time":30,"failures":{},"handlers":{},"measures":{"drift":0.01}}
"#;

/// A file that is removed with the value.
struct File(PathBuf);

impl File {
    fn new(name: &str, text: &str) -> File {
        let name = format!("planwright-ask-{}-{name}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, text).expect("a file");
        File(path)
    }

    /// The exit status and what was printed: the answers, or the error.
    fn ask(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let output = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .arg("ask")
            .arg(&self.0)
            .args(arguments)
            .output()
            .expect("the program runs");
        let text = match output.status.success() {
            true => output.stdout,
            false => output.stderr,
        };
        (
            output.status.code(),
            String::from_utf8(text).expect("it is text"),
        )
    }

    fn answers(&self, arguments: &[&str]) -> String {
        let (status, text) = self.ask(arguments);
        assert_eq!(status, Some(0), "{text}");
        text
    }
}

impl Drop for File {
    fn drop(&mut self) {
        // A file that is gone already is no harm.
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn records_of_a_sweep_answer_goals() {
    let file = File::new("records.jsonl", RECORDS);
    assert_eq!(
        file.answers(&["(fact run :run ?run :outcome :failure :time ?time)"]),
        "run  time\n  0   5.5\n  1  6.25\n"
    );
    assert_eq!(
        file.answers(&["(fact run :class ?class :outcome ?outcome)", "--count"]),
        "class                      outcome  count  share\n\
         gripper-closed-completely  failure      2  66.7 %\n\
         -                          success      1  33.3 %\n"
    );
    let joined = "(and (fact expectation :name \"parked\" :held t :run ?run)
                       (fact draw :run ?run :name \"bottle.y\" :value ?y))";
    assert_eq!(
        file.answers(&[joined, "--show", "?y ?run", "--json"]),
        "{\"y\":-0.8,\"run\":1}\n{\"y\":-1.0,\"run\":2}\n"
    );
    assert_eq!(file.answers(&["(fact body :run 0 :name bowl-1)"]), "yes\n");
    assert_eq!(file.answers(&["(fact body :run 1)"]), "no\n");
    assert_eq!(file.answers(&["(fact fault :name ?n)"]), "no answers\n");
    let relations = file.answers(&[]);
    assert!(
        relations.contains("draw            4  :run :name :value"),
        "{relations}"
    );
}

#[test]
fn an_episode_of_a_run_answers_goals() {
    let folder = std::env::temp_dir().join(format!("planwright-episode-{}", std::process::id()));
    let plan = "(pp-tut:with-simulated-robot
                  (exe:perform (desig:an action (type detecting)
                                          (object (desig:an object (type spoon))))))";
    let run = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["run", "--eval", plan, "--episode"])
        .arg(&folder)
        .output()
        .expect("the program runs");
    // The plan fails, and its episode is there all the same.
    assert_eq!(run.status.code(), Some(1));
    let file = File(folder.clone());
    assert_eq!(
        file.answers(&[
            "(and (fact task :type :detecting :status ?status :task ?task)
                             (fact failure :task ?task :class ?class))"
        ]),
        "status  task  class\n\
         failed     1  perception-object-not-found\n"
    );
    std::fs::remove_dir_all(&folder).expect("the folder is there");
}

#[test]
fn what_cannot_be_asked_is_told() {
    let file = File::new("told.jsonl", RECORDS);
    for (goal, why) in [
        ("(fact run :oucome ?o)", "have no :oucome: they have :run, "),
        (
            "(fact runs :outcome ?o)",
            "There are no facts (runs …); there are body, draw, ",
        ),
        (
            "(fact ?what :run 1)",
            "The relation of a fact must be given",
        ),
        (
            "(fact run outcome)",
            "(fact RELATION :column VALUE …) was expected",
        ),
        ("(fact run :outcome ?o", "end of file"),
        ("(fact run :outcome ?o) 5", "One goal was expected"),
    ] {
        let (status, error) = file.ask(&[goal]);
        assert_eq!(status, Some(2), "{goal}: {error}");
        assert!(
            error.starts_with("error: ") && error.contains(why),
            "{goal}: {error}"
        );
    }
    let malformed = File::new("malformed.jsonl", "{\"world\":0}\n{\"world\":\n");
    let (status, error) = malformed.ask(&["(fact run :run ?r)"]);
    assert_eq!(status, Some(2), "{error}");
    assert!(error.contains("malformed.jsonl, line 2: "), "{error}");
    let nowhere = File(PathBuf::from("/nowhere/at all"));
    let (status, error) = nowhere.ask(&["(fact run :run ?r)"]);
    assert_eq!(status, Some(2));
    assert!(
        error.contains("There is no file or folder /nowhere/at all."),
        "{error}"
    );
}

/// The recording of a plan.
fn recorded(path: PathBuf, plan: &File) -> File {
    let done = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["run", "--record"])
        .arg(&path)
        .arg(&plan.0)
        .output()
        .expect("the program runs");
    assert!(done.status.success(), "{done:?}");
    File(path)
}

#[test]
fn recordings_answer_goals_and_damaged_ones_say_what_is_wrong() {
    let path = std::env::temp_dir().join(format!("planwright-ask-{}.mcap", std::process::id()));
    let plan = File::new(
        "record.plan",
        "(in-package :pp-tut) (with-simulated-robot (perform (an action (type moving-torso) (joint-angle upper-limit))))",
    );
    let recording = recorded(path, &plan);
    assert_eq!(
        recording.answers(&["(fact task :kind :performed :type ?type :status ?status)"]),
        "type          status\nmoving-torso  succeeded\nmoving-torso  succeeded\n"
    );
    // Where things were: the base stays, and nothing else is there.
    assert_eq!(
        recording.answers(&["(fact robot :time ?time :x ?x :y ?y :yaw ?yaw)"]),
        "time  x  y  yaw\n   0  0  0    0\n"
    );
    let bytes = std::fs::read(&recording.0).expect("the recording is there");
    std::fs::write(&recording.0, &bytes[..bytes.len() / 3]).expect("it can be written");
    let (status, text) = recording.ask(&["(fact task :type ?type)"]);
    assert_eq!(status, Some(2), "{text}");
    assert!(text.contains("cut off"), "{text}");
    std::fs::write(&recording.0, "no recording").expect("it can be written");
    let (status, text) = recording.ask(&["(fact task :type ?type)"]);
    assert_eq!(status, Some(2), "{text}");
    assert!(text.contains("is not an MCAP file"), "{text}");
}

#[test]
fn what_was_performed_in_the_worlds_of_a_sweep_is_kept_in_order() {
    let sweep = File::new(
        "episodes.plan",
        "(in-package :pp-tut)
         (defsweep torso (:worlds 4)
           \"The torso at any height.\"
           (vary (height (uniform 0.05 0.3)))
           (run (with-simulated-robot
                  (let ((?height height))
                    (perform (an action (type moving-torso) (joint-angle ?height)))))))",
    );
    let folder = std::env::temp_dir().join(format!("planwright-episodes-{}", std::process::id()));
    let mut texts = Vec::new();
    for threads in ["1", "3"] {
        let done = Command::new(env!("CARGO_BIN_EXE_planwright"))
            .args(["sweep", "--threads", threads, "--worlds", "4", "--episodes"])
            .arg(&folder)
            .arg(&sweep.0)
            .output()
            .expect("the program runs");
        assert!(done.status.code().is_some_and(|code| code < 2), "{done:?}");
        texts.push(std::fs::read_to_string(folder.join("task.jsonl")).expect("tasks are there"));
    }
    assert_eq!(texts[0], texts[1]);
    let told = File(folder.clone());
    let answers = told.answers(&[
        "(and (fact run :run ?run) (fact task :run ?run :type :moving-torso :kind :performed :status ?s))",
        "--show",
        "?run ?s",
        "--count",
    ]);
    assert!(
        answers.starts_with("run  s          count  share\n  0  succeeded      1"),
        "{answers}"
    );
    let _ = std::fs::remove_dir_all(&folder);
}

/// A path in the folder for temporary files, at which nothing is.
fn fresh(name: &str) -> PathBuf {
    let name = format!("planwright-ask-{}-{name}", std::process::id());
    let path = std::env::temp_dir().join(name);
    let _ = std::fs::remove_file(&path);
    path
}

#[test]
fn facts_are_written_into_an_sqlite_file_that_is_not_there_yet() {
    let records = File::new("sqlite.jsonl", RECORDS);
    let path = fresh("facts.db");
    let file = path.to_str().expect("it is text");
    assert_eq!(
        records.answers(&["--sqlite", file]),
        "body                1\ndraw                4\nexpectation         3\nfailed              1\n\
         measure             3\nrun                 3\n"
    );
    let bytes = std::fs::read(&path).expect("the file is there");
    assert!(bytes.starts_with(b"SQLite format 3\0"));
    assert_eq!(bytes.len() % 4096, 0);
    // Neither it nor an input is overwritten.
    for there in [file, records.0.to_str().expect("it is text")] {
        let before = std::fs::read(there).expect("it is there");
        let (status, error) = records.ask(&["--sqlite", there]);
        assert_eq!(status, Some(2), "{error}");
        assert!(error.starts_with("error: "), "{error}");
        assert_eq!(std::fs::read(there).expect("it is there"), before);
    }
    // In the same order, the same bytes.
    let again = fresh("again.db");
    records.answers(&["--sqlite", again.to_str().expect("it is text")]);
    assert_eq!(std::fs::read(&again).expect("the file is there"), bytes);
    std::fs::remove_file(&again).expect("the file is there");
    std::fs::remove_file(&path).expect("the file is there");
}

#[test]
fn an_sqlite_file_that_cannot_be_written_leaves_nothing() {
    let malformed = File::new(
        "halfway.jsonl",
        "{\"world\":0,\"outcome\":\"success\"}\n{\"world\":\n",
    );
    let path = fresh("halfway.db");
    let file = path.to_str().expect("it is text");
    for (arguments, why) in [
        (vec!["--sqlite", file], "halfway.jsonl, line 2: "),
        (
            vec!["--sqlite", "/nowhere/at all.db"],
            "cannot write /nowhere/at all.db",
        ),
        (vec!["--sqlite", "/tmp"], "/tmp"),
        (
            vec!["(fact run :run ?r)", "--sqlite", file],
            "cannot be used with",
        ),
    ] {
        let (status, error) = malformed.ask(&arguments);
        assert_eq!(status, Some(2), "{error}");
        assert!(error.contains(why), "{error}");
    }
    assert!(!path.exists() && !PathBuf::from(format!("{file}.part")).exists());
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_of_an_sqlite_file() {
    let pipe = fresh("endless.jsonl");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo runs").success());
    let pipe = File(pipe);
    let path = fresh("interrupted.db");
    let unfinished = PathBuf::from(format!("{}.part", path.display()));
    let mut asking = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .arg("ask")
        .arg(&pipe.0)
        .arg("--sqlite")
        .arg(&path)
        .spawn()
        .expect("the program runs");
    // It opens once the program reads, and more never comes.
    let writer = std::fs::File::options().write(true).open(&pipe.0);
    let _writer = writer.expect("it is read");
    assert!(unfinished.exists());
    let mut sent = Command::new("kill");
    let sent = sent.args(["-INT", &asking.id().to_string()]).status();
    assert!(sent.expect("kill runs").success());
    let ended = asking.wait().expect("it ends");
    assert_eq!(ended.code(), Some(130));
    assert!(!path.exists() && !unfinished.exists());
}

#[test]
fn a_session_writes_its_own_episode_and_what_it_has_read() {
    let records = File::new("read.jsonl", RECORDS);
    let (own, read) = (fresh("own.db"), fresh("read.db"));
    let plan = format!(
        "(progn
           (pp-tut:with-simulated-robot
             (exe:perform (desig:an action (type positioning-arm) (left-configuration park) (right-configuration park))))
           (print (pw:export-sqlite {own:?}))
           (print (handler-case (pw:export-sqlite {own:?}) (error (e) (princ-to-string e))))
           (pw:read-facts {:?})
           (print (pw:export-sqlite {read:?})))",
        records.0
    );
    let done = Command::new(env!("CARGO_BIN_EXE_planwright"))
        .args(["run", "--eval", &plan])
        .output()
        .expect("the program runs");
    let text = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(done.status.success(), "{done:?}");
    assert!(text.contains("own.db is there already"), "{text}");
    // The same rows as on the command line.
    assert!(text.trim_end().ends_with("15"), "{text}");
    for path in [&own, &read] {
        let bytes = std::fs::read(path).expect("the file is there");
        assert!(bytes.starts_with(b"SQLite format 3\0"));
        std::fs::remove_file(path).expect("the file is there");
    }
}

#[test]
fn a_recording_tells_where_things_were_when_it_is_asked_for_that() {
    let path = std::env::temp_dir().join(format!("planwright-where-{}.mcap", std::process::id()));
    let plan = File::new(
        "where.plan",
        "(in-package :pp-tut)
         (init-projection)
         (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
         (with-simulated-robot
           (perform (an action (type transporting)
                               (object (an object (type bottle)))
                               (target (a location (on (an object (type counter-top)
                                                                  (urdf-name sink-area-surface)
                                                                  (part-of kitchen))))))))",
    );
    let recording = recorded(path, &plan);
    let rows = recording.answers(&[
        "(fact object :object ?o :type ?type :on ?on :in-hand ?hand)",
        "--count",
    ]);
    for row in [
        "bottle-1  bottle  table_area_main ",
        "bottle-1  bottle  sink_area_surface ",
        "bottle-1  bottle  - ",
    ] {
        assert!(rows.contains(row), "{rows}");
    }
    // Where it stands first and last, and how far the robot has driven.
    let times = recording.answers(&["(fact object :time ?time :x ?x :y ?y)"]);
    let rows: Vec<Vec<f64>> = times
        .lines()
        .skip(1)
        .map(|line| {
            line.split_whitespace()
                .map(|n| n.parse().expect("a number"))
                .collect()
        })
        .collect();
    assert!(rows.is_sorted_by_key(|row| row[0]), "{times}");
    let near = |row: Option<&Vec<f64>>, x: f64, y: f64| {
        row.is_some_and(|row| (row[1] - x).abs() < 0.15 && (row[2] - y).abs() < 0.6)
    };
    assert!(
        near(rows.first(), -1.6, -0.9) && near(rows.last(), 1.45, -0.4),
        "{times}"
    );
    let robot = recording.answers(&["(fact robot :time ?time :x ?x :y ?y)"]);
    assert!(robot.lines().count() > 5, "{robot}");
}
