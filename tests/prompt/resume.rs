//! Resuming a session leads to the state of the session that was not interrupted.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::prompt::{Beginning, Keeper, Resumed, Wanted, open, resume};
use session::dialogue::screen::input_name;
use session::dialogue::{Converse, Evaluate, Event, Repeat};
use session::{Session, SessionOptions};

/// A folder that is removed with the value.
pub(super) struct Folder(PathBuf);

impl Folder {
    pub(super) fn new(name: &str) -> Folder {
        let name = format!("planwright-resume-{}-{name}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).unwrap();
        Folder(folder)
    }

    pub(super) fn journal(&self) -> PathBuf {
        self.0.join("one.journal")
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A session that is kept in a journal.
pub(super) struct Sitting {
    pub(super) session: Session,
    keeper: Keeper,
    number: usize,
    /// What was told while it was resumed.
    pub(super) told: String,
}

impl Sitting {
    pub(super) fn begin(journal: &Path) -> Sitting {
        Sitting::open(Wanted::In(journal), None)
    }

    pub(super) fn resume(journal: &Path) -> Sitting {
        Sitting::open(Wanted::Of(journal), None)
    }

    /// With time that passes at that multiple of real time.
    fn open(wanted: Wanted<'_>, realtime: Option<f64>) -> Sitting {
        let opened = open(wanted, &Beginning::default()).unwrap();
        let options = SessionOptions {
            realtime,
            ..SessionOptions::default()
        };
        let mut sitting = Sitting {
            session: Session::new(&options).unwrap(),
            keeper: Keeper::new(opened.journal),
            number: 0,
            told: String::new(),
        };
        let Sitting {
            session,
            keeper,
            number,
            ..
        } = &mut sitting;
        if let Some(earlier) = opened.earlier {
            let mut told = Vec::new();
            let mut ask = || true;
            let resumed = resume(
                session, keeper, &earlier, number, &mut told, false, &mut ask,
            );
            assert_eq!(resumed.unwrap(), Resumed::Whole);
            session.set_interactive(true);
            sitting.told = String::from_utf8(told).unwrap();
        }
        sitting
    }

    /// Types an input; returns what the session says.
    pub(super) fn say(&mut self, text: &str) -> String {
        self.keeper.begun(text, true);
        self.number += 1;
        self.session.set_interactive(true);
        let mut said = String::new();
        let name = input_name(self.number);
        self.session
            .evaluate(&name, text, &mut |event| match event {
                Event::Output(text) => said.push_str(&text),
                Event::Values(values) => said.push_str(&format!("{}\n", values.join(" "))),
                Event::Aborted(abort) => said.push_str(&abort.report),
                Event::Stopped(stop) => said.push_str(&format!("{stop:?}")),
                _ => {}
            });
        self.keeper.ended(&self.session);
        said
    }

    /// Whether these inputs have been resumed, and have led to the same world.
    pub(super) fn has_resumed(&self, count: usize) -> bool {
        let resumed = format!("; Resumed {count} inputs;");
        self.told.starts_with(&resumed) && !self.told.contains("otherwise than")
    }
}

const BEGIN: [&str; 3] = [
    "(in-package :pp-tut)",
    "(load \"plans/tutorial/skills.plan\")",
    "(spawn-object '((-1.4 -0.75 0.86) (0 0 0 1)))",
];

/// The bottle is carried to the island.
const CARRY: &str = "(defparameter *arm*
  (with-simulated-robot
    (get-ready-at *place-at-table*)
    (let* ((bottle (find-object :bottle)) (arm (pick-up-object bottle :right)))
      (defparameter *bottle* bottle)
      (bring-to-island bottle arm)
      arm)))";

/// Questions whose answers depend on all that happened.
const QUESTIONS: [&str; 8] = [
    "*arm*",
    "(list *bottle* (desig:reference *bottle*))",
    "(get-current-pose-of-object 'bottle-1)",
    "(get-robot-transformation)",
    "(random 1000000)",
    "(list (roslisp:ros-time) (pw:world-hash))",
    "(pw:explain)",
    "(list + ++ *)",
];

/// That two sessions are the same, also in what happens next.
fn assert_same(a: &mut Sitting, b: &mut Sitting) {
    assert_eq!(a.session.world_hash(), b.session.world_hash());
    for question in QUESTIONS {
        assert_eq!(a.say(question), b.say(question), "{question}");
    }
    let next = "(with-simulated-robot (park-arms) (go-to *place-at-table*))";
    assert_eq!(a.say(next), b.say(next));
    assert_eq!(a.session.world_hash(), b.session.world_hash());
    assert_eq!(a.say("(rewind 2)"), b.say("(rewind 2)"));
    assert_eq!(a.session.world_hash(), b.session.world_hash());
}

#[test]
fn a_session_that_carried_a_bottle_is_resumed() {
    let folder = Folder::new("carry");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN.into_iter().chain([CARRY]) {
        first.say(input);
    }
    let copy = folder.0.join("two.journal");
    fs::copy(&journal, &copy).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(second.has_resumed(4), "{}", second.told);
    // What was resumed is resumed once more.
    drop(second);
    second = Sitting::resume(&copy);
    assert!(second.has_resumed(4), "{}", second.told);
    assert_same(&mut first, &mut second);
}

#[test]
fn failures_debugger_interrupts_and_undo_are_resumed() {
    let folder = Folder::new("failures");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN {
        first.say(input);
    }
    let drive = "(with-simulated-robot (go-to (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))";
    first.say(drive);
    assert_eq!(first.session.level(), 1);
    first.say("(pw:explain)");
    first.say("(get-robot-transformation)");
    first.say("q");
    first.say("(with-simulated-robot (park-arms) (go-to *place-at-table*))");
    first.say(
        "(defparameter *arm* 1) (defparameter *bottle* (make-pose \"map\" '((0 0 0) (0 0 0 1))))",
    );
    first.session.interrupt_next_at(400);
    first.say("(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.3))))");
    // Beside the interrupted plan.
    first.say("(get-robot-transformation)");
    first.say("(cpl:sleep 1)");
    first.say("(btr:move-object 'bottle-1 '((-1.3 -0.9 0.86) (0 0 0 1)))");
    first.say("1");
    first.say("(pw:snapshot 'here)");
    first.say("(inspect 'bottle-1)");
    first.say("1");
    first.say("q");
    first.say("(btr:move-object 'bottle-1 '((-1.2 -0.9 0.86) (0 0 0 1)))");
    first.say("(rewind)");
    first.say("(describe-topic 'bottle-1)");
    first.say("(btr-utils:kill-all-objects)");
    first.say("(pw:restore 'here)");
    let copy = folder.0.join("two.journal");
    fs::copy(&journal, &copy).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(second.has_resumed(23), "{}", second.told);
    let questions = [
        "(pw:explain)",
        "(get-robot-transformation)",
        "(roslisp:ros-time)",
        "(rewind)",
    ];
    for question in questions {
        assert_eq!(first.say(question), second.say(question), "{question}");
        assert_eq!(first.session.world_hash(), second.session.world_hash());
    }
    for name in ["one.transcript", "two.transcript"] {
        let sitting = if name == "one.transcript" {
            &mut first
        } else {
            &mut second
        };
        let file = folder.0.join(name);
        sitting.say(&format!(
            "(save-transcript {:?})",
            file.display().to_string()
        ));
    }
    let [a, b] = ["one.transcript", "two.transcript"]
        .map(|name| fs::read_to_string(folder.0.join(name)).unwrap());
    assert_eq!(a, b);
}

#[test]
fn an_evaluation_that_is_stopped_is_stopped_again() {
    let folder = Folder::new("stopped");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN {
        first.say(input);
    }
    first.say("(with-simulated-robot (park-arms))");
    first.say("(with-simulated-robot (go-to *place-at-table*) (go-to (make-pose \"map\" '((-1 1.5 0) (0 0 0 1)))))");
    assert_eq!(first.session.level(), 1);
    let copy = folder.0.join("two.journal");
    fs::copy(&journal, &copy).unwrap();
    let mut second = Sitting::resume(&copy);
    assert_eq!(second.session.level(), 1);
    for input in [
        "(get-robot-transformation)",
        ":r",
        "q",
        "(rewind)",
        "(pw:explain)",
    ] {
        assert_eq!(first.say(input), second.say(input), "{input}");
        assert_eq!(first.session.world_hash(), second.session.world_hash());
    }
}

#[test]
fn a_file_that_has_changed_is_told() {
    let folder = Folder::new("changed");
    let journal = folder.journal();
    let plan = folder.0.join("place.plan");
    let place = |x: f64| format!("(defparameter *place* '(({x} -0.9 0.86) (0 0 0 1)))");
    fs::write(&plan, place(-1.4)).unwrap();
    let mut first = Sitting::begin(&journal);
    first.say("(in-package :pp-tut)");
    first.say(&format!("(load {:?})", plan.display().to_string()));
    first.say("(spawn-object *place*)");
    drop(first);
    fs::write(&plan, place(-1.2)).unwrap();
    let earlier = open(Wanted::Of(&journal), &Beginning::default()).unwrap();
    let changed: Vec<String> = earlier
        .earlier
        .iter()
        .flat_map(|earlier| earlier.changed())
        .map(|changed| changed.to_string())
        .collect();
    let expected = format!("; {} has changed since input 2 loaded it.", plan.display());
    assert_eq!(changed, [expected]);
    drop(earlier);
    let mut second = Sitting::resume(&journal);
    let told =
        "; Input 3 has ended otherwise than in the earlier session: the world is another one.";
    assert!(second.told.contains(told), "{}", second.told);
    let pose = second.say("(get-current-pose-of-object 'bottle-1)");
    assert!(pose.contains("((-1.2"), "{pose}");
    // The journal is now that of the session as it has become.
    drop(second);
    let third = Sitting::resume(&journal);
    assert!(third.has_resumed(4), "{}", third.told);
}

#[test]
fn a_recording_is_made_again() {
    let folder = Folder::new("recording");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN {
        first.say(input);
    }
    let film = folder.0.join("film.mcap");
    first.say("(with-simulated-robot (park-arms))");
    first.say(&format!("(pw:record {:?})", film.display().to_string()));
    first.say("(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.2))))");
    first.say("(pw:record nil)");
    let recorded = fs::read(&film).unwrap();
    first.say("(with-simulated-robot (go-to *place-at-table*))");
    fs::remove_file(&film).unwrap();
    let copy = folder.0.join("two.journal");
    fs::copy(&journal, &copy).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(second.has_resumed(8), "{}", second.told);
    assert_eq!(second.session.world_hash(), first.session.world_hash());
    assert_eq!(fs::read(&film).unwrap(), recorded);
    assert_eq!(first.say("(pw:rewind 2)"), second.say("(pw:rewind 2)"));
    assert_eq!(first.session.world_hash(), second.session.world_hash());
}

#[test]
fn resuming_does_not_wait_for_real_time() {
    let folder = Folder::new("hurried");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN {
        first.say(input);
    }
    first.say("(with-simulated-robot (park-arms))");
    first.say("(cpl:sleep 100)");
    let hash = first.session.world_hash();
    drop(first);
    let begin = Instant::now();
    // More than an hour, if it did.
    let second = Sitting::open(Wanted::Of(&journal), Some(0.02));
    assert!(begin.elapsed() < Duration::from_secs(300));
    assert!(second.has_resumed(5), "{}", second.told);
    assert_eq!(second.session.world_hash(), hash);
}

#[test]
fn an_interrupt_while_nothing_moves_is_repeated_at_the_same_time() {
    let folder = Folder::new("sleep");
    let journal = folder.journal();
    // Half a second passes between two looks at the interrupt flag.
    let mut first = Sitting::open(Wanted::In(&journal), Some(10.0));
    first.session.interrupt_next_at(8);
    first.say("(cpl:sleep 100)");
    first.say("q");
    let time = first.say("(roslisp:ros-time)");
    let seconds: f64 = time.trim().trim_end_matches("d0").parse().unwrap();
    assert!(0.0 < seconds && seconds < 100.0, "{time}");
    drop(first);
    let mut second = Sitting::open(Wanted::Of(&journal), Some(10.0));
    assert!(second.has_resumed(3), "{}", second.told);
    assert_eq!(second.say("(roslisp:ros-time)"), time);
}
