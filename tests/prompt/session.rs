//! What the prompt's inputs do besides: going back in the world, taking values apart, completion,
//! hints and saved transcripts.

use super::talk::{BOTTLE, Talk};
use crate::tests::waiting::wait_for;
use crate::transcript::{Transcript, Verdict, replay};
use session::dialogue::{Converse, Evaluate, Outcome, Repeat};
use session::{Session, SessionOptions};

#[test]
fn rewinding_counts_the_forms_that_changed_the_world() {
    let mut talk = Talk::new();
    let empty = talk.hash();
    talk.say(BOTTLE);
    let with_bottle = talk.hash();
    talk.say("(defparameter *kept* 1)");
    talk.say("(spawn-object '((-1.6 -1.3 0.82) (0 0 0 1)) :cup 'cup-1)");
    talk.say("(+ 1 1)");
    talk.say("(list-available-objects)");
    assert!(talk.say("(rewind)").contains("CUP-1"));
    assert_eq!(talk.hash(), with_bottle);
    assert!(
        talk.say("(get-current-pose-of-object 'cup-1)")
            .contains("no object named")
    );
    talk.say("q");
    talk.say("(rewind)");
    assert_eq!(talk.hash(), empty);
    assert_eq!(talk.say("*kept*"), "1\n");
    assert!(talk.say("(rewind)").contains("changed the world"));
    talk.say("q");
}

#[test]
fn at_a_level_the_world_goes_back_to_before_the_form_that_stands_still() {
    let mut talk = Talk::new();
    talk.say(BOTTLE);
    let before = talk.hash();
    talk.say("(progn (spawn-object '((-1.6 -1.3 0.82) (0 0 0 1)) :cup 'cup-1) (car 5))");
    assert_ne!(talk.hash(), before);
    talk.say("(rewind)");
    assert_eq!(talk.hash(), before);
}

#[test]
fn two_forms_are_taken_back_at_once() {
    let mut talk = Talk::new();
    let empty = talk.hash();
    talk.say(BOTTLE);
    talk.say("(spawn-object '((-1.6 -1.3 0.82) (0 0 0 1)) :cup 'cup-1)");
    talk.say("(rewind 2)");
    assert_eq!(talk.hash(), empty);
}

#[test]
fn a_hundred_forms_are_taken_back() {
    const FORMS: usize = 120;
    let mut talk = Talk::new();
    talk.say(BOTTLE);
    let mut before = Vec::new();
    for step in 0..FORMS as u32 {
        before.push(talk.hash());
        let x = -1.7 + 0.005 * f64::from(step);
        talk.say(&format!(
            "(btr-utils:move-object 'bottle-1 '(({x} -0.9 0.82) (0 0 0 1)))"
        ));
    }
    let refused = talk.say("(rewind 121)");
    talk.say("q");
    let words: Vec<&str> = refused.split_whitespace().collect();
    let count = words.windows(2).find(|pair| pair[0] == "Only");
    let count: usize = count.expect(&refused)[1].parse().expect(&refused);
    // One is kept for the form that takes them back.
    assert_eq!(count, 99);
    for back in [1, 1, 40, count - 42] {
        talk.say(&format!("(rewind {back})"));
    }
    assert_eq!(talk.hash(), before[FORMS - count]);
}

#[test]
fn a_snapshot_is_gone_back_to_by_its_name() {
    let mut talk = Talk::new();
    talk.say(BOTTLE);
    talk.say("(snapshot 'laid)");
    let laid = talk.hash();
    talk.say("(init-projection)");
    assert_ne!(talk.hash(), laid);
    talk.say("(restore 'laid)");
    assert_eq!(talk.hash(), laid);
    assert!(
        talk.say("(restore 'lade)")
            .contains("There is no snapshot LADE; there are LAID.")
    );
}

#[test]
fn tasks_are_told_as_a_tree_with_their_status() {
    let mut talk = Talk::new();
    talk.say("(with-simulated-robot (cpl:par (cpl:sleep 1) (cpl:sleep 2)))");
    let shown = talk.say("(tasks)");
    assert!(shown.contains("TOP-LEVEL"), "{shown}");
    assert_eq!(shown.matches("PAR-CHILD").count(), 2, "{shown}");
    assert_eq!(shown.matches("succeeded").count(), 3, "{shown}");
    talk.say("(with-simulated-robot (car 5))");
    let shown = talk.say("(tasks)");
    assert!(
        shown.contains("waits for a decision") || shown.contains("running"),
        "{shown}"
    );
}

#[test]
fn time_is_told_in_both_clocks() {
    let mut talk = Talk::new();
    let shown = talk.say("(time (with-simulated-robot (cpl:sleep 2) 5))");
    assert!(shown.starts_with("; 2.000 s simulated, "), "{shown}");
    assert!(shown.ends_with(" s real\n5\n"), "{shown}");
}

#[test]
fn values_are_taken_apart() {
    let mut talk = Talk::new();
    let shown = talk.say("(inspect (list 1 (list 2 3)))");
    assert!(shown.contains("  1: 1  (2 3)"), "{shown}");
    assert_eq!(talk.session.prompt(), "PP-TUT inspect");
    assert!(talk.say("1").contains("  0: 0  2"));
    assert_eq!(talk.say("*"), "(2 3)\n");
    assert!(talk.say("b").contains("(1 (2 3))"));
    talk.say("q");
    assert_eq!(talk.session.prompt(), "PP-TUT");
}

#[test]
fn documentation_is_found_by_name() {
    let mut talk = Talk::new();
    assert!(
        talk.say("(doc spawn-object)")
            .contains("(spawn-object pose")
    );
    assert!(
        talk.say("?picking-up")
            .contains("(an action (type picking-up) (object …)")
    );
    assert!(talk.say("(doc :bottle)").contains("A type of objects"));
    assert!(talk.say("(doc no-such-thing)").contains("Nothing is known"));
    assert!(
        talk.say("(list-actions)")
            .contains("(type going) (target …)")
    );
    assert!(talk.say("(help)").contains("(rewind)"));
    assert!(
        talk.say("(apropos \"list-defined-gra\")")
            .contains("LIST-DEFINED-GRASPS")
    );
    // A variable is a variable.
    talk.say("(defparameter ?x 5)");
    assert_eq!(talk.say("?x"), "5\n");
}

#[test]
fn what_helps_at_the_prompt_is_there_in_every_package() {
    let mut talk = Talk::new();
    talk.say("(defpackage :mine (:use :cl))");
    talk.say("(in-package :mine)");
    assert!(talk.say("(help)").contains("(rewind)"));
    assert!(talk.say("?car").contains("(car list)"));
    talk.say("(defun tasks () :my-own)");
    assert_eq!(talk.say("(tasks)"), ":MY-OWN\n");
}

#[test]
fn functions_variables_and_packages_are_completed() {
    let talk = Talk::new();
    assert_eq!(talk.completions("(spawn-o"), ["spawn-object"]);
    assert_eq!(talk.completions("(list *print-circ"), ["*print-circle*"]);
    assert!(talk.completions("(pp-pl").contains(&"pp-plans:".to_owned()));
    assert_eq!(
        talk.completions("(btr-utils:object-ex"),
        ["btr-utils:object-exists"]
    );
    assert_eq!(talk.completions("(MAKE-POS"), ["MAKE-POSE"]);
    assert!(talk.completions("; (spawn-o").is_empty());
}

#[test]
fn objects_in_the_world_are_completed() {
    let mut talk = Talk::new();
    talk.say(BOTTLE);
    assert_eq!(
        talk.completions("(get-current-pose-of-object 'bott"),
        ["bottle-1"]
    );
    assert_eq!(talk.completions("(an object (name bot"), ["bottle-1"]);
    assert_eq!(talk.completions("(spawn-object x :bottl"), [":bottle"]);
}

#[test]
fn designators_are_completed_from_their_table() {
    let talk = Talk::new();
    assert_eq!(
        talk.completions("(perform (an "),
        ["action", "motion", "object", "location"]
    );
    assert_eq!(talk.completions("(an action (type picki"), ["picking-up"]);
    assert_eq!(
        talk.completions("(an action (type picking-up) (ar"),
        ["arm", "arms"]
    );
    assert_eq!(
        talk.completions("(an action (type picking-up) (arm "),
        ["left", "right"]
    );
    let grasps =
        talk.completions("(an action (type picking-up) (object (an object (type cup))) (grasp ");
    assert!(grasps.contains(&"front".to_owned()), "{grasps:?}");
    let keys = talk.completions("(an action (type going) (");
    assert_eq!(keys, ["target"]);
    // A key that is there already is not offered again.
    let keys = talk.completions("(an action (type picking-up) (arm left) (");
    assert!(!keys.contains(&"arm".to_owned()), "{keys:?}");
}

#[test]
fn files_are_completed_in_strings() {
    let talk = Talk::new();
    assert_eq!(talk.completions("(load \"Cargo.to"), ["Cargo.toml"]);
    assert_eq!(talk.completions("(load \"src/sess"), ["session/"]);
}

#[test]
fn the_shape_of_the_form_is_shown_with_the_current_argument() {
    let mut talk = Talk::new();
    assert_eq!(
        talk.hint("(spawn-object "),
        "(spawn-object *pose* &optional type name color)"
    );
    assert_eq!(
        talk.hint("(spawn-object x :cu"),
        "(spawn-object pose &optional *type* name color)"
    );
    talk.say("(defun greet (whom &key loudly) (list whom loudly))");
    assert_eq!(
        talk.hint("(greet :you :loudly "),
        "(greet whom &key *loudly*)"
    );
    assert_eq!(
        talk.hint("(an action (type going) (target "),
        "(target …) where to"
    );
    assert_eq!(talk.hint("(an action (type going) "), "(target …)");
}

#[test]
fn an_interrupt_can_be_repeated_at_the_same_step() {
    let drive = "(with-simulated-robot
      (let ((?near (make-pose \"map\" '((0.5 0 0) (0 0 0 1)))))
        (perform (an action (type going) (target (a location (pose ?near)))))))";
    let interrupted = |at| {
        let mut talk = Talk::new();
        talk.session.interrupt_next_at(at);
        let (shown, outcome) = talk.take(drive);
        assert_eq!(outcome, Outcome::Stopped, "{shown}");
        assert_eq!(talk.session.interrupted_at(), Some(at));
        talk
    };
    let (mut a, b, c) = (interrupted(60), interrupted(60), interrupted(90));
    assert_eq!(a.hash(), b.hash());
    assert_ne!(a.hash(), c.hash());
    // Going on comes to where an undisturbed drive comes.
    a.say("c");
    let mut undisturbed = Talk::new();
    undisturbed.say(drive);
    assert_eq!(a.hash(), undisturbed.hash());
}

#[test]
fn planning_that_is_interrupted_has_no_effect() {
    use std::sync::Arc;
    use std::sync::atomic::Ordering;

    // To find the ways takes longer than to drive them, and all of it takes many seconds.
    let drive = "(with-simulated-robot
      (park-arms)
      (dotimes (i 40)
        (let ((?far (make-pose \"map\" (if (evenp i) '((2.9 3 0) (0 0 0 1)) '((0 0 0) (0 0 0 1))))))
          (perform (an action (type going) (target (a location (pose ?far))))))))";
    let mut talk = Talk::new();
    let flag = talk.session.interrupt_handle();
    // A search for a way holds the flag as long as it lasts.
    let holders = Arc::strong_count(&flag);
    let pressed = std::thread::spawn(move || {
        wait_for("a search", || {
            (Arc::strong_count(&flag) > holders).then_some(())
        });
        flag.store(true, Ordering::Relaxed);
    });
    let (shown, outcome) = talk.take(drive);
    assert_eq!(outcome, Outcome::Stopped, "{shown}");
    pressed.join().expect("the key was pressed");
    // Another session is interrupted at the very same place.
    let at = talk.session.interrupted_at().expect("it was interrupted");
    let mut other = Talk::new();
    other.session.interrupt_next_at(at);
    assert_eq!(other.take(drive).1, Outcome::Stopped);
    assert_eq!(other.session.interrupted_at(), Some(at));
    assert_eq!(other.hash(), talk.hash());
    assert!(talk.say("q").contains("aborted"));
    other.say("q");
    assert_eq!(other.hash(), talk.hash());
    assert_eq!(
        talk.say("(with-simulated-robot (park-arms) :parked)"),
        ":PARKED\n"
    );
}

/// The form that a step of the tour shows, after the last empty line.
fn form_to_type(shown: &str) -> String {
    let form = shown.rsplit("\n\n").next().unwrap_or_default();
    assert!(form.starts_with('('), "{shown}");
    form.trim_end().to_owned()
}

#[test]
fn the_tour_is_solved_by_what_it_shows() {
    let mut talk = Talk::new();
    let mut shown = talk.say("(tour)");
    assert!(
        shown.contains("Step 1 of 6: Put a bottle on the table."),
        "{shown}"
    );
    // What is typed in between does not matter.
    assert!(!talk.say("(+ 1 2)").contains("Done"));
    for number in 1..6 {
        shown = talk.say(&form_to_type(&shown));
        let next = format!("Step {} of 6: ", number + 1);
        assert!(
            shown.contains("; Done: ") && shown.contains(&next),
            "{shown}"
        );
        assert!(!shown.contains("No longer so"), "{shown}");
        let again = talk.say("(tour)");
        assert!(again.starts_with(&next), "{again}");
    }
    let last = form_to_type(&shown);
    assert_eq!(talk.take(&last).1, Outcome::Stopped);
    let over = talk.say("q");
    assert!(
        over.contains("aborted") && over.contains("The lesson is done: The tour"),
        "{over}"
    );
    assert!(talk.say("(tour 1)").contains("Step 1 of 6"));
    assert!(talk.say("(tour 2)").starts_with("Drive to the table."));
    assert!(talk.say("(tour 7)").contains("1 to 6 were expected"));
}

/// A session in which what is done of lessons is remembered in a file.
fn remembering(path: &std::path::Path) -> Talk {
    let mut talk = Talk::new();
    talk.session.remember_lessons(path, "test");
    talk
}

#[test]
fn what_is_done_of_lessons_is_remembered() {
    let folder = std::env::temp_dir().join(format!("planwright-lessons-{}", std::process::id()));
    let path = folder.join("state").join("lessons");
    let mut talk = remembering(&path);
    assert!(!talk.say("(lesson)").contains(" steps)"));
    talk.say("(lesson 'tour)");
    assert!(
        talk.say(BOTTLE)
            .contains("; Done: Put a bottle on the table.")
    );
    let kept = || std::fs::read_to_string(&path).expect("it is there");
    assert_eq!(kept(), "tour 1 6\n");
    // Another session knows; what has been undone stays done there.
    let listed = remembering(&path).say("(lesson)");
    let line = listed
        .lines()
        .find(|line| line.contains("'tour"))
        .expect("a line");
    assert!(
        line.ends_with("The tour: a first session  (1 of 6 steps)"),
        "{listed}"
    );
    assert!(
        talk.say("(btr-utils:kill-all-objects)")
            .contains("; No longer so")
    );
    assert_eq!(kept(), "tour 1 6\n");
    // A damaged file, and one of lessons that there are no more.
    std::fs::write(&path, "gone 1 2\ntour x\n\u{0}\n").expect("it can be written");
    assert!(!remembering(&path).say("(lesson)").contains(" steps)"));
    // A closed session neither reads nor writes it.
    let mut closed = remembering(&path);
    closed.session.close();
    std::fs::write(&path, "tour 6 6\n").expect("it can be written");
    assert!(!closed.say("(lesson)").contains("(done)"));
    assert!(remembering(&path).say("(lesson)").contains("(done)"));
    std::fs::remove_dir_all(&folder).expect("it is there");
}

#[cfg(unix)]
#[test]
fn progress_that_cannot_be_kept_is_told_once() {
    let mut talk = remembering(std::path::Path::new("/proc/no/such/folder/lessons"));
    talk.say("(lesson 'tour)");
    let shown = talk.say(BOTTLE);
    assert!(
        shown.contains("; Progress cannot be kept: ") && shown.contains("Step 2 of 6"),
        "{shown}"
    );
    let shown = talk.say("(btr-utils:kill-all-objects)");
    assert!(
        shown.contains("No longer so") && !shown.contains("Progress"),
        "{shown}"
    );
}

#[test]
fn a_session_is_saved_as_a_transcript() {
    let mut talk = Talk::new();
    talk.say("(list 1\n  2)");
    talk.say("(car 5)");
    talk.say("q");
    talk.say("(princ \"x\")");
    let path = std::env::temp_dir().join(format!("planwright-{}.transcript", std::process::id()));
    talk.say(&format!(
        "(save-transcript {:?})",
        path.to_str().expect("a path")
    ));
    let saved = std::fs::read_to_string(&path).expect("it is there");
    std::fs::remove_file(&path).expect("it goes away");
    assert!(
        saved.starts_with("CL-USER> (in-package :pp-tut)\n#<PACKAGE"),
        "{saved}"
    );
    assert!(saved.contains("PP-TUT> (list 1\n  2)\n(1 2)\n"), "{saved}");
    assert!(
        saved.contains("; Evaluation aborted on #<TYPE-ERROR"),
        "{saved}"
    );
    assert!(
        saved.ends_with("PP-TUT> (princ \"x\")\nx\n\"x\"\n\n"),
        "{saved}"
    );
    assert!(saved.contains("PP-TUT 1]> q\n"), "{saved}");
}

/// Saves the session as a transcript, replays that and expects no difference; returns it.
fn saved_and_replayed(talk: &mut Talk, name: &str) -> String {
    let path = crate::tests::scratch_folder().join(format!("{name}.transcript"));
    let shown = path.to_str().expect("a path");
    talk.say(&format!("(pw:save-transcript {shown:?})"));
    let saved = std::fs::read_to_string(&path).expect("it is there");
    let transcript = Transcript::parse("saved", &saved);
    let mut fresh = Session::new(&SessionOptions::default()).expect("the session starts");
    for verdict in replay(&transcript, &mut fresh) {
        if let Verdict::Failed(difference) = verdict {
            panic!("{}\n{saved}", difference.unified().join("\n"));
        }
    }
    saved
}

/// More than one block of what is packed together, each with inputs that show much and one that shows nothing.
#[test]
fn a_long_session_is_saved_whole() {
    let mut talk = Talk::new();
    for number in 0..60 {
        talk.say(&format!(
            "(dotimes (i 300) (format t \"~a of {number}: é~%\" (* i {number})))"
        ));
        talk.say("(values)");
    }
    let saved = saved_and_replayed(&mut talk, "long");
    assert!(saved.len() > 3 * (64 << 10), "{} bytes", saved.len());
    let mut rest = saved.as_str();
    for number in 0..60 {
        for part in [
            format!("PP-TUT> (dotimes (i 300) (format t \"~a of {number}: "),
            format!("{} of {number}: é\nNIL\n\nPP-TUT> (values)\n", 299 * number),
        ] {
            let at = rest
                .find(&part)
                .unwrap_or_else(|| panic!("{part} is missing"));
            rest = &rest[at + part.len()..];
        }
    }
}

#[test]
fn what_was_typed_in_the_debugger_is_saved_and_replayed() {
    let mut talk = Talk::new();
    talk.say("(defparameter *a* (list *unknown* (lambda () 1)))");
    talk.choose("[USE-VALUE]");
    talk.say("(+ 40 2)");
    talk.say("*a*");
    talk.say("(defun f (x) (list x (car x)))");
    talk.say("(f 5)");
    talk.say("(setf *a* (lambda () x))");
    talk.say("(f 6)");
    talk.say(":bt");
    talk.say("a");
    talk.say(":locals");
    talk.say("q");
    talk.say("(funcall *a*)");
    let saved = saved_and_replayed(&mut talk, "debugger");
    assert!(saved.contains(" value> (+ 40 2)\n*A*\n"), "{saved}");
    assert!(saved.contains("PP-TUT 2]> :bt\n"), "{saved}");
    assert!(saved.contains("PP-TUT> (funcall *a*)\n5\n"), "{saved}");
}

#[test]
fn what_the_prompt_alone_understands_is_saved_and_replayed() {
    let mut talk = Talk::new();
    talk.say("(in-package :cl-user)");
    talk.say("?mapcar");
    talk.say("(time (list (lambda () 1)))");
    talk.say("(tasks)");
    talk.say("(inspect (list 1 (list 2 3)))");
    talk.say("1");
    talk.say("q");
    talk.say("(values) 1");
    talk.say("(length \"text\nA> text\")");
    talk.say("(format t \"A> not a prompt~%PP 1]> nor this~%...~%~%\")");
    talk.say("(world-hash)");
    let saved = saved_and_replayed(&mut talk, "prompt");
    assert!(saved.contains("CL-USER inspect> 1\n"), "{saved}");
    assert!(saved.contains(" s simulated, [..] s real\n"), "{saved}");
    assert!(saved.contains("\n[..]> not a prompt\n"), "{saved}");
}

#[test]
fn a_session_that_stands_still_is_saved_and_replayed() {
    let mut talk = Talk::new();
    talk.session.interrupt_next_at(50);
    talk.say("(loop)");
    talk.session.interrupt_next_at(70);
    talk.say("0");
    talk.say("(tasks)");
    talk.say("1");
    talk.say("(car 5)");
    let saved = saved_and_replayed(&mut talk, "standing-still");
    assert!(
        saved.contains("PP-TUT> (loop) ; Ctrl-C at poll 50\n"),
        "{saved}"
    );
    assert!(saved.ends_with("PP-TUT 1]>\n"), "{saved}");
}

#[test]
fn completions_do_not_change_the_numbers_of_objects() {
    let mut talk = Talk::new();
    talk.say("(defparameter *one* (lambda () 1))");
    let completions = talk.session.completions("(funcall *one", 13);
    assert!(
        completions.candidates[0].doc.contains("{…}"),
        "{completions:?}"
    );
    talk.say("(list (lambda () 2) *one*)");
    saved_and_replayed(&mut talk, "numbers");
}
