//! Sweeps: one plan in many worlds.

use session::dialogue::{Evaluate, Event, Outcome};
use session::{LogLevel, Session, SessionOptions};
use sweep::{Drawn, Ending, Record};

fn session(text: &str) -> Session {
    let options = SessionOptions {
        log_level: LogLevel::None,
        ..SessionOptions::default()
    };
    let mut session = Session::new(&options).expect("a session starts");
    let outcome = session.evaluate("sweep.plan", text, &mut |event| {
        if let Event::Aborted(abort) = event {
            panic!("{text}\n{}", abort.report);
        }
    });
    assert_eq!(outcome, Outcome::Finished);
    session
}

/// What comes of a world of the sweep in the text.
fn world(text: &str, number: u64) -> Record {
    session(text).run_sweep_world("s", 42, number, &[], 100_000, None)
}

/// What a session prints.
fn printed(session: &mut Session, text: &str) -> String {
    let mut shown = String::new();
    session.evaluate("test", text, &mut |event| match event {
        Event::Output(text) => shown.push_str(&text),
        Event::Values(values) => shown.push_str(&format!("=> {}\n", values.join(" "))),
        Event::Aborted(abort) => shown.push_str(&format!("! {}\n", abort.report)),
        _ => {}
    });
    shown
}

fn draws(record: &Record) -> Vec<(String, String)> {
    let draws = record.draws.iter();
    draws
        .map(|(path, value)| (path.to_owned(), value.to_string()))
        .collect()
}

#[test]
fn a_draw_that_is_added_changes_no_other() {
    let few = "(defsweep s () (vary (a (uniform 0 1)) (c (normal 5 1 :between (4 6)))) (run a))";
    let more = "(defsweep s () (vary (c (normal 5 1 :between (4 6))) (b (yaw)) (a (uniform 0 1))
                                   (d (choice 1 (5 2))) (e (between 3 9)) (f (sometimes 0.5 :yes))
                                   (g (permutation '(1 2 3))) (h (subset '(1 2 3)))
                                   (i (+ (uniform 0 1) (uniform 0 1)))) (run a))";
    let (few, more) = (world(few, 7), world(more, 7));
    assert_eq!(few.outcome, Ending::Success);
    for draw in draws(&few) {
        assert!(draws(&more).contains(&draw), "{draw:?} of {more:?}");
    }
    let paths: Vec<String> = draws(&more).into_iter().map(|(path, _)| path).collect();
    assert_eq!(paths, ["c", "b", "a", "d", "e", "f", "g", "h", "i", "i.2"]);
}

#[test]
fn worlds_end_in_different_ways() {
    let ending = |run: &str| {
        let text = format!(
            "(in-package :pp-tut)
             (defsweep s (:limit 5) (vary (x (uniform 2 3))) (run {run})
               (expect (low (< x 1)) (high (> x 1))))"
        );
        let record = world(&text, 0);
        (record.outcome, record.class.unwrap_or_default())
    };
    let is = |outcome, class: &str| (outcome, class.to_owned());
    assert_eq!(ending("x"), is(Ending::Expectation, "low"));
    assert_eq!(ending("(car x)"), is(Ending::Failure, "TYPE-ERROR"));
    assert_eq!(
        ending("(with-simulated-robot (cpl:fail 'gripper-closed-completely))"),
        is(Ending::Failure, "GRIPPER-CLOSED-COMPLETELY")
    );
    assert_eq!(
        ending("(with-simulated-robot (cpl:sleep 100))"),
        is(Ending::Limit, "")
    );
    assert_eq!(ending("(quit 3)"), is(Ending::Failure, "QUIT"));
}

#[test]
fn a_world_without_end_ends() {
    // Cleaning up goes on for ever, too.
    let record = world("(defsweep s () (run (unwind-protect (loop) (loop))))", 0);
    assert_eq!(record.outcome, Ending::Endless);
}

#[test]
fn things_are_where_they_were_drawn_and_a_world_without_room_is_invalid() {
    let text = "(defsweep s ()
                  (vary (bottle (object bottle :on table-area-main :x (uniform -1.9 -1.2)
                                        :y (uniform -1.05 -0.75)))
                        (clutter (objects (between 2 3) :of (cup bowl) :on table-area-main
                                          :apart 0.05))
                        (box (obstacle :x (uniform 0.9 1.2) :y (uniform 0.2 1.2) :size 0.2)))
                  (run (list bottle clutter box))
                  (expect (table (on-surface-p bottle 'table-area-main))
                          (upright (every #'upright-p (cons bottle clutter)))
                          (apart (every (lambda (thing) (> (distance bottle thing) 0.05)) clutter))
                          (floor (nothing-on-floor-p))
                          (clean (no-penetration-p))
                          (parked (arms-parked-p))))";
    for number in 0..3 {
        let record = world(text, number);
        assert_eq!(record.outcome, Ending::Success, "{record:?}");
        assert!(record.draws.get("clutter.2.yaw").is_some(), "{record:?}");
    }
    let full =
        "(defsweep s () (vary (bottle (object bottle :on table-area-main :x -1.5 :y -0.9 :yaw 0))
                                     (cup (object cup :on table-area-main :x -1.5 :y -0.9 :yaw 0)))
                  (run nil))";
    let record = world(full, 0);
    assert_eq!(record.outcome, Ending::Invalid);
    assert_eq!(record.class.as_deref(), Some("cup"));
    assert_eq!(
        record.cause.as_deref(),
        Some("found no place in 100 tries: BOTTLE is there")
    );
}

/// A plan of two motions.
const DRIVE: &str = "
    (in-package :pp-tut)
    (defun drive (place)
      (with-simulated-robot
        (let ((?place (make-pose \"map\" (list (list place 0 0) '(0 0 0 1)))))
          (perform (an action (type going) (target (a location (pose ?place)))))
          (perform (a motion (type moving-torso) (joint-angle 0.2))))))
    (defsweep s () (vary (place (uniform -0.5 0.6))) (run (drive place)))";

#[test]
fn a_world_at_the_prompt_is_that_of_the_record() {
    let text = DRIVE;
    for number in [0, 5] {
        let record = world(text, number);
        assert_eq!(record.outcome, Ending::Success, "{record:?}");
        assert!(record.distance > 0.1 && record.time > 1.0, "{record:?}");
        let mut session = session(text);
        // Whatever was before does not matter.
        printed(&mut session, "(drive 0.7) (random 10)");
        let shown = printed(
            &mut session,
            &format!("(sweep-world 's {number} :seed 42) (run-sweep-world) (pw:world-hash)"),
        );
        assert!(shown.contains("=> T"), "{shown}");
        assert!(shown.contains(&record.hash), "{shown}\n{record:?}");
    }
}

#[test]
fn a_sweep_at_the_prompt_says_how_often_a_plan_works() {
    let text = "(defsweep s (:worlds 40)
                  (vary (x (uniform 0 1)))
                  (run (print x) (when (> x 0.5) (error 'end-of-file)))
                  (goal (success :at-least 0.9)))";
    let mut session = session(text);
    let shown = printed(&mut session, "(sweep 's :seed 3)");
    assert!(
        shown.starts_with("s   seed 3   40 worlds\nsuccess  "),
        "{shown}"
    );
    assert!(shown.contains("goal 90 %: NOT MET\n"), "{shown}");
    assert!(shown.contains("  END-OF-FILE  --replay "), "{shown}");
    let few = printed(&mut session, "(sweep 's :seed 3 :worlds 1)");
    assert!(few.contains("1 world\n"), "{few}");
}

#[test]
fn mistakes_in_a_sweep_are_told_where_they_are() {
    let mut session = session("");
    let mut said = |text: &str| printed(&mut session, text);
    for (text, report) in [
        (
            "(defsweep s ())",
            "The sweep s runs nothing: (run …) is missing.",
        ),
        (
            "(defsweep s () (run 1) (vry (x 1)))",
            "is no part of a sweep",
        ),
        (
            "(defsweep s () (vary (x (yaw)) (x 2)) (run 1))",
            "There are two variables x.",
        ),
        (
            "(defsweep s () (vary x) (run 1))",
            "is no variable: (NAME FORM) was expected.",
        ),
        (
            "(defsweep s () (goal 0.9) (run 1))",
            "(success :at-least 0.95) was expected",
        ),
        (
            "(defsweep s (:worlds 0) (run 1))",
            "0 is no number of worlds.",
        ),
        ("(defsweep s (:limit :never) (run 1))", ":NEVER is no limit"),
        (
            "(defsweep s () (vary (b (object botle :on table-area-main))) (run b)) (sweep-world 's 0)",
            "There is no type of objects :BOTLE; did you mean :BOTTLE?",
        ),
        (
            "(defsweep s () (vary (b (object bottle :on table-aera-main))) (run b)) (sweep-world 's 0)",
            "The kitchen has no furniture named table-aera-main; did you mean table-area-main?",
        ),
        (
            "(defsweep s () (vary (b (uniform 2 1))) (run b)) (sweep-world 's 0)",
            "2 and 1 are no range",
        ),
        ("(sweep 'unknown)", "There is no sweep unknown; there are "),
        ("(pw::%draw-yaw)", "Draws belong into the VARY of a sweep."),
    ] {
        let shown = said(text);
        assert!(shown.contains(report), "{text}\n{shown}");
    }
}

/// A plan of the whole robot: the bottle from the table to the island, as the tutorial has it.
const MOVE_BOTTLE: &str = include_str!("../../plans/sweeps/move-bottle.plan");

/// What comes of that plan with a bottle where it is easy to grasp, and faults.
fn with_faults(faults: &str) -> (String, Record) {
    let text = format!(
        "{MOVE_BOTTLE}
         (defsweep s (:limit 300)
           (vary (bottle (object bottle :on table-area-main :x -1.6 :y -0.9 :yaw 0)))
           (with-injected-failures {faults})
           (run (move-bottle 0.3))
           (expect (on-island (on-surface-p bottle 'kitchen-island-surface))
                   (tidy (nothing-on-floor-p))))"
    );
    let record = world(&text, 3);
    (text, record)
}

#[test]
fn faults_end_motions_as_they_would_on_the_robot() {
    for (fault, class, cause) in [
        (
            "gripper-slip",
            "GRIPPER-CLOSED-COMPLETELY",
            "HeldObjectSlipped",
        ),
        (
            "gripper-misses :of bottle",
            "GRIPPER-CLOSED-COMPLETELY",
            "NothingGripped",
        ),
        (
            "perception-miss :of bottle",
            "PERCEPTION-OBJECT-NOT-FOUND",
            "ObjectNotFound",
        ),
        (
            "perception-confusion",
            "PERCEPTION-OBJECT-NOT-FOUND",
            "ObjectNotFound",
        ),
        (
            "navigation-stops-short",
            "NAVIGATION-GOAL-NOT-REACHED",
            "Stalled",
        ),
        ("torso-stuck", "TORSO-GOAL-NOT-REACHED", "Stalled"),
    ] {
        let (_, record) = with_faults(&format!("({fault})"));
        assert_eq!(record.outcome, Ending::Failure, "{fault}: {record:?}");
        assert_eq!(record.class.as_deref(), Some(class), "{fault}: {record:?}");
        assert_eq!(record.cause.as_deref(), Some(cause), "{fault}: {record:?}");
        let kind = fault.split(' ').next().unwrap_or_default();
        assert!(
            record.faults[0].starts_with(&format!("inject.{kind}")),
            "{record:?}"
        );
    }
    // What does not concern the bottle, or comes too late, changes nothing.
    let (_, unharmed) = with_faults(
        "(perception-miss :of cup) (arm-stuck :after 200) (gripper-slip :probability 0)",
    );
    assert_eq!(unharmed.outcome, Ending::Success, "{unharmed:?}");
    let (_, plain) = with_faults("");
    assert_eq!(plain.hash, unharmed.hash);
}

#[test]
fn what_slips_falls_and_the_same_world_at_the_prompt_has_the_same_hash() {
    let (text, record) = with_faults("(gripper-slip :after 12)");
    assert_eq!(
        record.cause.as_deref(),
        Some("HeldObjectSlipped"),
        "{record:?}"
    );
    let mut session = session(&text);
    let shown = printed(
        &mut session,
        "(sweep-world 's 3 :seed 42)
         (handler-case (run-sweep-world) (cram-language:plan-failure () (pw::%sweep-run-ends)))
         (with-simulated-robot (cpl:sleep pw::*patience*))
         (pw:world-hash)",
    );
    assert!(shown.contains(&record.hash), "{shown}\n{record:?}");
}

#[test]
fn the_faults_of_a_record_are_a_schedule_that_strikes_again() {
    let (_, drawn) = with_faults("(gripper-slip :of bottle :probability 0.4)");
    assert_eq!(drawn.faults.len(), 1, "{drawn:?}");
    let (_, again) = with_faults(&format!("(:schedule '({:?}))", drawn.faults[0]));
    assert_eq!(again.faults, drawn.faults);
    assert_eq!(again.hash, drawn.hash);
    let count = drawn.faults[0].rsplit('.').next().expect("a count");
    let (_, counted) = with_faults(&format!("(gripper-slip :of bottle :at {count})"));
    assert_eq!(counted.faults, drawn.faults);
    assert_eq!(counted.hash, drawn.hash);
    let (_, another) = with_faults("(:schedule '(\"inject.gripper-slip.CUP.1\"))");
    assert_eq!(another.faults, Vec::<String>::new());
    assert_eq!(another.outcome, Ending::Success, "{another:?}");
}

#[test]
fn handlers_that_no_world_has_led_to_are_known() {
    let sweep = "
        (in-package :pp-tut)
        (defun flaky (x)
          (cpl:with-failure-handling
              (((or manipulation-low-level-failure gripper-closed-completely) (e)
                 (declare (ignore e))
                 (return))
               (navigation-goal-not-reached () (return :elsewhere)))
            (when (< x 0.5) (cpl:fail 'gripper-closed-completely :description \"\"))))
        (defun never-called ()
          (handle-failure perception-object-not-found ((detect)) (print e)))
        (defsweep s () (vary (x (uniform 0 1))) (run (flaky x)))";
    let counts = |number: u64| {
        let record = world(sweep, number);
        assert_eq!(record.outcome, Ending::Success, "{record:?}");
        let named: Vec<String> = record
            .handlers
            .iter()
            .map(|(name, count)| format!("{name} {count}"))
            .collect();
        (
            record
                .draws
                .get("x")
                .and_then(Drawn::number)
                .expect("a number")
                < 0.5,
            named,
        )
    };
    let expected = |reached: u64| {
        [
            format!("sweep.plan:5 MANIPULATION-LOW-LEVEL-FAILURE {reached}"),
            format!("sweep.plan:5 GRIPPER-CLOSED-COMPLETELY {reached}"),
            "sweep.plan:8 NAVIGATION-GOAL-NOT-REACHED 0".to_owned(),
            "sweep.plan:11 PERCEPTION-OBJECT-NOT-FOUND 0".to_owned(),
        ]
    };
    let all: Vec<(bool, Vec<String>)> = (0..6).map(counts).collect();
    assert!(all.iter().any(|(fails, _)| *fails) && !all.iter().all(|(fails, _)| *fails));
    for (fails, counts) in all {
        assert_eq!(counts, expected(u64::from(fails)));
    }
}

#[test]
fn a_blocked_way_is_a_body() {
    let (_, record) = with_faults("(navigation-blocked :for 5)");
    assert!(
        record
            .faults
            .iter()
            .any(|fault| fault.starts_with("inject.navigation-blocked")),
        "{record:?}"
    );
}

#[test]
fn mistakes_in_faults_are_told() {
    let mut session = session("");
    for (text, report) in [
        (
            "(with-injected-failures ((gripper-slipp)) 1)",
            "did you mean gripper-slip?",
        ),
        (
            "(with-injected-failures ((gripper-slip :probability 2)) 1)",
            "2 is no probability",
        ),
        (
            "(with-injected-failures (gripper-slip) 1)",
            "GRIPPER-SLIP is no fault",
        ),
        (
            "(with-injected-failures ((gripper-slip :at 0)) 1)",
            "0 does not say when a fault strikes",
        ),
        (
            "(with-injected-failures ((gripper-slip :at 1 :probability 0.5)) 1)",
            "says twice when it strikes",
        ),
        (
            "(with-injected-failures ((:schedule '(\"inject.gripper-slip\"))) 1)",
            "is no fault of a schedule",
        ),
        (
            "(with-injected-failures ((perception-noise :position (uniform 0 1))) 1)",
            "",
        ),
    ] {
        let shown = printed(&mut session, text);
        assert!(
            shown.contains(report) && shown.starts_with('!'),
            "{text}\n{shown}"
        );
    }
    assert_eq!(
        printed(
            &mut session,
            "(with-injected-failures ((:seed 3) (arm-stuck)) 1)"
        ),
        "=> 1\n"
    );
}
