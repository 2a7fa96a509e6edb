//! Resuming a session from its tape leads to the state of the session that was not interrupted.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::atomic::AtomicBool;

use proptest::prelude::*;

use crate::prompt::{Beginning, Keeper, Wanted, open, resume};
use session::dialogue::screen::input_name;
use session::dialogue::{Converse, Evaluate, Event, Repeat};
use session::{Session, SessionOptions};

/// A folder that is removed with the value.
pub(super) struct Folder(PathBuf);

impl Folder {
    pub(super) fn new(name: &str) -> Folder {
        let name = format!("planwright-tape-{}-{name}", std::process::id());
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

fn tape_of(journal: &Path) -> PathBuf {
    journal.with_extension("journal.tape")
}

/// A session that is kept in a journal.
pub(super) struct Sitting {
    pub(super) session: Session,
    keeper: Keeper,
    number: usize,
    /// What was told while it was resumed.
    pub(super) told: String,
    /// How many steps motions took meanwhile.
    steps: u64,
}

impl Sitting {
    pub(super) fn begin(journal: &Path) -> Sitting {
        Sitting::open(Wanted::In(journal))
    }

    pub(super) fn resume(journal: &Path) -> Sitting {
        Sitting::open(Wanted::Of(journal))
    }

    fn open(wanted: Wanted<'_>) -> Sitting {
        let opened = open(wanted, &Beginning::default()).unwrap();
        let mut session = Session::new(&SessionOptions::default()).unwrap();
        let steps = Rc::new(Cell::new(0));
        let counter = Rc::clone(&steps);
        session.set_observer(Box::new(move |_| counter.set(counter.get() + 1)));
        let mut sitting = Sitting {
            session,
            keeper: Keeper::new(opened.journal),
            number: 0,
            told: String::new(),
            steps: 0,
        };
        let Sitting {
            session,
            keeper,
            number,
            ..
        } = &mut sitting;
        match opened.earlier {
            None => keeper.begin_fresh_tape(session),
            Some(earlier) => {
                let mut told = Vec::new();
                let never = AtomicBool::new(false);
                resume(session, keeper, &earlier, number, &mut told, false, &never).unwrap();
                session.set_interactive(true);
                sitting.told = String::from_utf8(told).unwrap();
            }
        }
        sitting.steps = steps.get();
        sitting
    }

    /// Types an input; returns what the session says.
    pub(super) fn say(&mut self, text: &str) -> String {
        self.keeper.begun(text, true, &mut self.session);
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
        self.keeper.ended(&mut self.session);
        said
    }

    pub(super) fn was_quick(&self) -> bool {
        !self.told.contains("does not fit") && self.told.contains("; Resumed ") && self.steps == 0
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
fn a_session_that_carried_a_bottle_is_resumed_without_the_physics() {
    let folder = Folder::new("carry");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN.into_iter().chain([CARRY]) {
        first.say(input);
    }
    let copy = folder.0.join("two.journal");
    fs::copy(&journal, &copy).unwrap();
    fs::copy(tape_of(&journal), tape_of(&copy)).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(second.was_quick(), "{}", second.told);
    assert!(second.told.contains("Resumed 4 inputs"), "{}", second.told);
    // What was resumed is resumed once more.
    drop(second);
    second = Sitting::resume(&copy);
    assert!(second.was_quick(), "{}", second.told);
    assert_same(&mut first, &mut second);
}

#[test]
fn failures_debugger_interrupts_and_undo_are_resumed_from_the_tape() {
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
    fs::copy(tape_of(&journal), tape_of(&copy)).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(second.was_quick(), "{}", second.told);
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
    fs::copy(tape_of(&journal), tape_of(&copy)).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(!second.told.contains("does not fit"), "{}", second.told);
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
fn a_file_that_has_changed_does_not_fit_the_tape() {
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
    let mut second = Sitting::resume(&journal);
    assert!(second.told.contains("does not fit"), "{}", second.told);
    assert!(second.told.contains("not the same"), "{}", second.told);
    let pose = second.say("(get-current-pose-of-object 'bottle-1)");
    assert!(pose.contains("((-1.2"), "{pose}");
    // The tape is now that of the session as it has become.
    drop(second);
    let third = Sitting::resume(&journal);
    assert!(third.was_quick(), "{}", third.told);
}

#[test]
fn a_session_without_a_tape_is_resumed_with_the_physics() {
    for obstacle in ["a folder", "another file"] {
        let folder = Folder::new(&obstacle.replace(' ', "-"));
        let journal = folder.journal();
        let tape = tape_of(&journal);
        match obstacle {
            "a folder" => fs::create_dir(&tape).unwrap(),
            _ => fs::write(&tape, "a film").unwrap(),
        }
        let mut first = Sitting::begin(&journal);
        for input in BEGIN {
            first.say(input);
        }
        first.say("(with-simulated-robot (park-arms))");
        let hash = first.session.world_hash();
        drop(first);
        let second = Sitting::resume(&journal);
        assert!(
            second.told.starts_with("; Resumed 4 inputs"),
            "{}",
            second.told
        );
        assert_eq!(second.session.world_hash(), hash);
        assert_ne!(second.steps, 0);
        if obstacle == "another file" {
            assert_eq!(fs::read_to_string(&tape).unwrap(), "a film");
        }
    }
}

#[test]
fn only_what_is_not_on_the_tape_is_evaluated_with_the_physics() {
    let folder = Folder::new("partly");
    let journal = folder.journal();
    let mut first = Sitting::begin(&journal);
    for input in BEGIN {
        first.say(input);
    }
    let film = folder.0.join("film.mcap");
    first.say("(with-simulated-robot (park-arms))");
    first.say(&format!("(pw:record {:?})", film.display().to_string()));
    let move_torso =
        "(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.2))))";
    first.say(move_torso);
    first.say("(pw:record nil)");
    let recorded = fs::read(&film).unwrap();
    first.say("(with-simulated-robot (go-to *place-at-table*))");
    let hash = first.session.world_hash();
    fs::remove_file(&film).unwrap();
    let copy = folder.0.join("two.journal");
    fs::copy(&journal, &copy).unwrap();
    fs::copy(tape_of(&journal), tape_of(&copy)).unwrap();
    let mut second = Sitting::resume(&copy);
    assert!(!second.told.contains("does not fit"), "{}", second.told);
    assert_eq!(second.session.world_hash(), hash);
    assert_eq!(fs::read(&film).unwrap(), recorded);
    let mut alone = Sitting::begin(&folder.0.join("three.journal"));
    for input in BEGIN {
        alone.say(input);
    }
    alone.say("(with-simulated-robot (park-arms))");
    let steps = alone.session.simulation().world().steps();
    alone.say(move_torso);
    let steps = alone.session.simulation().world().steps() - steps;
    assert_eq!(second.steps, steps);
    assert_eq!(first.say("(pw:rewind 2)"), second.say("(pw:rewind 2)"));
    assert_eq!(first.session.world_hash(), second.session.world_hash());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Whatever is wrong with the tape, the session is the same.
    #[test]
    fn a_damaged_tape_changes_nothing(place in any::<prop::sample::Index>(), bit in 0..8_u8, cut: bool) {
        let folder = Folder::new("damaged");
        let journal = folder.journal();
        let mut first = Sitting::begin(&journal);
        for input in BEGIN {
            first.say(input);
        }
        first.say("(with-simulated-robot (park-arms))");
        let hash = first.session.world_hash();
        drop(first);
        let tape = tape_of(&journal);
        let mut bytes = fs::read(&tape).unwrap();
        let at = place.index(bytes.len());
        if cut {
            bytes.truncate(at);
        } else {
            bytes[at] ^= 1 << bit;
        }
        fs::write(&tape, bytes).unwrap();
        let mut second = Sitting::resume(&journal);
        prop_assert_eq!(second.session.world_hash(), hash);
        prop_assert!(!second.told.contains("not the same"));
        second.say("(get-robot-transformation)");
        drop(second);
        let third = Sitting::resume(&journal);
        prop_assert!(third.was_quick(), "{}", third.told);
        prop_assert_eq!(third.session.world_hash(), hash);
    }
}
