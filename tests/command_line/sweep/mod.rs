//! Sweeps on the command line.

mod folders;
mod kitchens;
mod limits;

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

/// A plan that changes all that its file has defined, with a count of what earlier worlds have left.
const CHANGING: &str = "
    (defpackage :shop (:use :cpl :planwright))
    (in-package :shop)
    (defvar *seen* (list 0))
    (defvar *by-text* (make-hash-table :test 'equal))
    (defstruct place (visits 0))
    (defvar *place* (make-place))
    (defclass thing () ((made :allocation :class :initform 0 :accessor made)))
    (let ((n 0)) (defun next () (incf n)))
    (defun literal () '(0))
    (defmethod size ((x thing)) 1)
    (defvar *thing* (make-instance 'thing))
    (defsweep changing (:worlds 21)
      (vary (x (uniform 0 1)))
      (run (progn (nconc *seen* (list x)) (nconc (literal) (list x))
                  (setf (gethash (princ-to-string x) *by-text*) x)
                  (incf (place-visits *place*)) (incf (made *thing*))
                  (push :seen *features*) (intern (format nil \"~a\" x) :keyword)
                  (eval '(defclass thing () ((other :initform 1))))
                  (eval '(defmethod size ((x thing)) (1+ (slot-value x 'other))))
                  (unless (find-package :market) (make-package :market))
                  (set-macro-character #\\! (lambda (s c) (list s c)))
                  (pp-tut:spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
                  (when (< x 0.1) (error 'end-of-file))))
      (measure (seen (length *seen*)) (literals (length (literal)))
               (texts (hash-table-count *by-text*)) (visits (place-visits *place*))
               (size (size *thing*)) (next (next)) (drawn (random 1.0))
               (features (count :seen *features*)) (made-up (parse-integer (subseq (string (gensym)) 1))))
      (goal (success :at-least 0.5)))";

#[test]
fn no_world_notices_what_others_have_changed() {
    let file = scratch("changing.plan", CHANGING);
    let file = file.to_str().expect("a name");
    let run = |more: &[&str]| {
        let run = planwright(&[&["sweep", file, "--seed", "3", "--json"], more].concat());
        assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
        text(&run.stdout)
    };
    let one = run(&["--threads", "1"]);
    for line in one.lines() {
        let left = r#""seen":2,"literals":2,"texts":1,"visits":1,"size":2,"next":1,"#;
        assert!(
            line.contains(left) || line.contains(r#""class":"END-OF-FILE""#),
            "{line}"
        );
    }
    for threads in ["2", "7"] {
        assert_eq!(run(&["--threads", threads]), one);
    }
    let folder = std::env::temp_dir().join(format!("planwright-changing-{}", std::process::id()));
    let into = folder.to_str().expect("a name");
    assert_eq!(run(&["--into", into, "--shards", "4"]), one);
    std::fs::remove_dir_all(folder).expect("a folder can be removed");
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

/// A plan that fails if the bottle is far to the right and there is a bowl.
const PLANTED: &str = "
    (in-package :pp-tut)
    (defsweep planted (:worlds 60)
      (vary
        (bottle (object bottle :on table-area-main :x (uniform -1.9 -1.2) :y (uniform -1.05 -0.75)))
        (clutter (objects (between 0 3) :of (cup bowl milk) :on table-area-main :apart 0.02))
        (torso (choice 0.15 0.3)))
      (run (let ((y (cl-transforms:y (cl-transforms:origin (btr-utils:object-pose bottle)))))
             (when (and (< y -0.9)
                        (some (lambda (thing) (btr-utils:object-exists thing)) clutter)
                        (some (lambda (thing) (eq :bowl (pw::%type-of-object thing))) clutter))
               (error 'end-of-file)))))";

#[test]
fn a_planted_cause_is_found_and_shrunk_to_what_matters() {
    let file = scratch("planted.plan", PLANTED);
    let file = file.to_str().expect("a name");
    let records = planwright(&["sweep", file, "--seed", "1", "--worlds", "12", "--json"]);
    let failing = text(&records.stdout);
    let failing = failing
        .lines()
        .find(|line| line.contains("END-OF-FILE") && line.contains("\"clutter\":3"))
        .expect("one of the worlds fails");
    let world = failing["{\"world\":".len()..]
        .split(',')
        .next()
        .expect("a number");
    for threads in ["1", "3"] {
        let shrunk = planwright(&[
            "sweep",
            file,
            "--seed",
            "1",
            "--shrink",
            world,
            "--threads",
            threads,
        ]);
        let shown = text(&shrunk.stdout);
        assert!(
            shown.starts_with(&format!("world {world}, END-OF-FILE, after ")),
            "{shown}"
        );
        assert_eq!(shown.matches(" bowl\n").count(), 1, "{shown}");
        assert!(
            !shown.contains(" cup\n") && !shown.contains(" milk\n"),
            "{shown}"
        );
        assert!(shown.contains("bottle.yaw 0\n"), "{shown}");
        // The simplest y below -0.9 would be -1, but there the bottle, at the middle of its x, would
        // stand where the bowl is.
        assert!(
            shown.contains("bottle.x -1.55\n  bottle.y -1.03\n"),
            "{shown}"
        );
        let form = &shown[shown.find("(sweep-world").expect("a form")..];
        // A value that it cannot have, such as a rounded one, is no change.
        assert!(shown.contains("torso 0.15\n"), "{shown}");
        let rounded = ["(\"torso\" 0.1d0)", "(\"torso\" 0.2d0)"];
        assert!(!rounded.iter().any(|set| form.contains(set)), "{form}");
        let again = scratch(
            "again.plan",
            &format!("{PLANTED}\n{form}\n(run-sweep-world)"),
        );
        let again = planwright(&["run", again.to_str().expect("a name")]);
        assert_eq!(again.status.code(), Some(1), "{}", text(&again.stderr));
        assert!(
            text(&again.stderr).contains("END-OF-FILE"),
            "{}",
            text(&again.stderr)
        );
        let nearer = form.replace("-1.03d0", "-1d0");
        let nearer = scratch("nearer.plan", &format!("{PLANTED}\n{nearer}"));
        let nearer = planwright(&["run", nearer.to_str().expect("a name")]);
        assert!(
            text(&nearer.stderr).contains("clutter.1 found no place in 100 tries: BOTTLE is"),
            "{}",
            text(&nearer.stderr)
        );
    }
}

/// A plan that works in some of the worlds.
const OFTEN: &str =
    "(defsweep often () (vary (x (uniform 0 1))) (run (when (< x 0.2) (error 'end-of-file))))";

#[test]
fn a_comparison_ends_when_it_is_decided() {
    let file = scratch("often.plan", OFTEN);
    let seldom = scratch("seldom.plan", &OFTEN.replace("0.2", "0.5"));
    let same = scratch("same.plan", &OFTEN.replace("0.2", "0.21"));
    let file = file.to_str().expect("a name");
    let compare = |other: &PathBuf, threads| {
        let other = other.to_str().expect("a name");
        let arguments = ["sweep", file, "--worlds", "230", "--threads", threads];
        let output =
            planwright(&[&arguments[..], &["--compare", other, "--until-decided"]].concat());
        (output.status.code(), text(&output.stdout))
    };
    let (status, shown) = compare(&seldom, "2");
    let end = shown.lines().last().expect("a line");
    assert!(
        end.starts_with("decided after 200 worlds: ")
            && end.contains("often.plan is better (p < 0.0304"),
        "{shown}"
    );
    assert_eq!(status, Some(0));
    assert_eq!(compare(&seldom, "3"), (status, shown));
    let (status, shown) = compare(&same, "2");
    assert!(
        shown.ends_with("\nnot decided after 230 worlds\n"),
        "{shown}"
    );
    assert_eq!(status, Some(0));
    let alone = planwright(&["sweep", file, "--until-decided"]);
    assert_eq!(alone.status.code(), Some(2));
}

const ROBOTS: &str = "
    (defsweep robots (:worlds 12)
      (vary (robot (robot)) (x (uniform 0 1)))
      (run (unless (eq (rob-int::robot-name) robot) (error 'end-of-file)))
      (expect (one-arm (or (not (eq robot :fetch)) (equal (rob-int::arms-there :right :left) '(:right))))))";

#[test]
fn a_sweep_draws_robots() {
    let file = scratch("robots.plan", ROBOTS);
    let output = planwright(&["sweep", file.to_str().expect("a name"), "--json"]);
    let records = text(&output.stdout);
    for name in ["PR2", "FETCH", "HSR"] {
        assert!(
            records.contains(&format!("\"robot\":\"{name}\"")),
            "{records}"
        );
    }
    assert_eq!(output.status.code(), Some(0), "{records}");
    for (robot, why) in [
        ("(robot :fitch)", ":FITCH is no robot that planwright has"),
        (
            "(object 'cup :on table-area-main)) (r (robot)",
            "ROBOT comes first in VARY",
        ),
    ] {
        let text_of = ROBOTS.replace("(robot (robot))", &format!("(robot {robot})"));
        let wrong = scratch("no-robot.plan", &text_of);
        let output = planwright(&["sweep", wrong.to_str().expect("a name")]);
        let said = text(&output.stderr);
        assert!(said.contains(why), "{said}");
        assert_eq!(output.status.code(), Some(2), "{said}");
    }
}

#[test]
fn robots_are_compared_in_the_same_worlds() {
    let file = scratch(
        "one-arm.plan",
        "(defsweep one-arm (:worlds 4) (vary (x (uniform 0 1)))
           (run (when (rest (rob-int::arms-there :right :left)) (error 'end-of-file))))",
    );
    let file = file.to_str().expect("a name");
    let output = planwright(&["sweep", file, "--compare-robot", "fetch"]);
    let shown = text(&output.stdout);
    assert!(
        shown.contains("4 worlds in both: pr2 0.0 %, fetch 100.0 %"),
        "{shown}"
    );
    let output = planwright(&["sweep", file, "--compare-robot", "fitch"]);
    let said = text(&output.stderr);
    assert!(
        said.contains("the robots of planwright are pr2, fetch, hsr; did you mean fetch?"),
        "{said}"
    );
    assert_eq!(output.status.code(), Some(2));
    // Neither writes what only one sweep has.
    let output = planwright(&["sweep", file, "--compare-robot", "fetch", "--episodes", "x"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn plans_are_compared_in_the_same_worlds_and_reports_are_written() {
    let file = scratch("old.plan", SWEEP);
    let other = scratch(
        "new.plan",
        &SWEEP
            .replace("(< x 0.2)", "(> x 0.9)")
            .replace("(> x 0.3)", "t"),
    );
    let (file, other) = (
        file.to_str().expect("a name"),
        other.to_str().expect("a name"),
    );
    let output = planwright(&[
        "sweep",
        file,
        "--worlds",
        "40",
        "--seed",
        "2",
        "--compare",
        other,
    ]);
    let shown = text(&output.stdout);
    assert!(shown.contains("40 worlds in both: "), "{shown}");
    assert!(
        shown.contains("worse with ") && shown.contains("p = 0.0"),
        "{shown}"
    );
    let at = |name: &str| scratch("old.plan", SWEEP).with_file_name(name);
    let [csv, xml, html, png] = ["a.csv", "a.xml", "a.html", "a.png"].map(at);
    let path = |path: &PathBuf| path.to_str().expect("a name").to_owned();
    let map = format!("x,cup.x={}", path(&png));
    let output = planwright(&[
        "sweep",
        file,
        "--csv",
        &path(&csv),
        "--junit",
        &path(&xml),
        "--html",
        &path(&html),
        "--heat-map",
        &map,
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let read = |path: &PathBuf| std::fs::read(path).expect("written");
    assert_eq!(text(&read(&csv)).lines().count(), 31);
    assert!(text(&read(&xml)).contains("success at least 50 %"));
    assert!(
        text(&read(&html)).contains("what matters: x &lt; 0.3"),
        "{}",
        text(&read(&html))
    );
    assert!(read(&png).starts_with(b"\x89PNG"));
}

#[test]
fn a_mistake_in_what_varies_stops_the_sweep_with_its_place() {
    let wrong = scratch(
        "wrong.plan",
        "(defun place ()\n  (car 5))\n(defsweep wrong (:worlds 500)
           (vary (x (place)))
           (run x))",
    );
    let wrong = wrong.to_str().expect("a name");
    let output = planwright(&["sweep", wrong]);
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("wrong.plan:2:3: "), "{error}");
    assert!(
        error.contains("in what the sweep varies or injects, world 0"),
        "{error}"
    );
}

#[test]
fn things_are_put_onto_surfaces_that_were_drawn() {
    let drawn = scratch(
        "drawn.plan",
        "(defsweep drawn (:worlds 12)
           (vary (where (choice :table-area-main :kitchen-island-surface))
                 (cup (object cup :on where)))
           (run where))",
    );
    let drawn = drawn.to_str().expect("a name");
    let records = text(&planwright(&["sweep", drawn, "--json"]).stdout);
    assert_eq!(
        records.matches("\"outcome\":\"success\"").count(),
        12,
        "{records}"
    );
}

#[test]
fn options_that_say_too_little_are_refused_at_once() {
    let file = scratch("refused.plan", SWEEP);
    let file = file.to_str().expect("a name");
    for (arguments, why) in [
        (["--engine", "slurm"], "--into"),
        (["--heat-map", "x=map.png"], "bottle.x,bottle.y=map.png"),
        (["--heat-map", "x,=map.png"], "bottle.x,bottle.y=map.png"),
        (["--shard", "1/2"], "--into"),
    ] {
        let refused = planwright(&[&["sweep", file], arguments.as_slice()].concat());
        let said = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{said}");
        assert!(said.contains(why), "{said}");
    }
}
