//! Plans whose robot makes errors.

use super::cook::Cook;
use session::dialogue::Evaluate;
use session::{Session, SessionOptions};
use spatial::pose;

/// As what type the robot sees the bottle in front of it if it looks for objects of a type, with
/// some noise.
fn seen(noise: &str, kind: &str) -> String {
    let mut cook = Cook::at_table_with_bottle();
    let shown = cook.done(&format!(
        "(with-simulated-robot
           (with-noise ({noise})
             (cpl:with-failure-handling
                 ((perception-object-not-found (failure)
                    (declare (ignore failure))
                    (return :not-found)))
               (desig:desig-prop-value
                 (perform (an action (type detecting) (object (an object (type {kind})))))
                 :type))))"
    ));
    assert_eq!(cook.done("(pw:set-noise)").trim(), "NIL");
    shown.lines().last().unwrap_or_default().to_owned()
}

#[test]
fn objects_are_overlooked_and_mistaken_only_when_that_is_asked_for() {
    assert_eq!(seen(":position 0.001", "bottle"), ":BOTTLE");
    assert_eq!(seen(":misses 1", "bottle"), ":NOT-FOUND");
    assert_eq!(seen(":false-types 1", "bottle"), ":NOT-FOUND");
}

#[test]
fn a_detected_pose_is_off_by_the_noise_and_differs_from_look_to_look() {
    let mut cook = Cook::at_table_with_bottle();
    let mut look = |noise: &str| {
        cook.done(&format!(
            "{noise} (desig:desig-prop-value (with-simulated-robot (find-object :bottle)) :pose)"
        ))
    };
    let truth = look("");
    assert_eq!(look(""), truth);
    // The first line shows the former settings.
    let second_part = |text: String| text.split_once('\n').unwrap().1.to_owned();
    let noisy = second_part(look("(pw:set-noise :position 0.01)"));
    assert_ne!(noisy, truth);
    assert_ne!(look(""), noisy);
}

#[test]
fn a_drive_ends_beside_its_goal() {
    let mut cook = Cook::new();
    let mut off = |noise: &str| {
        cook.done(&format!(
            "(init-projection)
             (with-simulated-robot
               (with-noise ({noise}) (go-to (make-pose \"map\" '((0 1 0) (0 0 0 1))))))"
        ));
        let base = cook.session.simulation().world().robot_configuration().base;
        let place = base.translation.vector;
        (place.x.hypot(place.y - 1.0), pose::yaw(&base).abs())
    };
    let (distance, turn) = off(":position 0.1");
    assert!(distance < 1e-9 && turn < 1e-9);
    let (distance, turn) = off(":odometry-position 0.01 :odometry-yaw 0.02");
    assert!(distance > 1e-4 && distance < 0.05 && turn > 1e-4 && turn < 0.1);
}

#[test]
fn a_failure_ends_the_noise_around_it() {
    let mut cook = Cook::new();
    cook.fails("NOWHERE-TO-BE-FOUND", "(with-noise () (find-object :cup))");
    assert_eq!(cook.done("(pw:set-noise)").trim(), "NIL");
}

#[test]
fn the_seed_decides_on_the_errors() {
    let hash = |seed| {
        let options = SessionOptions {
            seed,
            noise: Some(String::new()),
            ..SessionOptions::default()
        };
        let mut session = Session::new(&options).unwrap();
        let text = "(in-package :pp-tut)
            (with-simulated-robot
              (let ((?pose (make-pose \"map\" '((0 1 0) (0 0 0 1)))))
                (perform (an action (type going) (target (a location (pose ?pose)))))))";
        session.evaluate("test", text, &mut |_| {});
        session.world_hash()
    };
    assert_eq!(hash(1), hash(1));
    assert_ne!(hash(1), hash(2));
}

#[test]
fn a_fresh_world_is_as_noisy_as_the_one_before() {
    let mut cook = Cook::new();
    cook.done("(pw:set-noise :yaw 0.125) (init-projection)");
    assert_eq!(cook.done("(pw:set-noise)").trim(), "(:YAW 0.125d0)");
}

#[test]
fn wrong_settings_are_refused() {
    let mut cook = Cook::new();
    let mut report = |text: &str| cook.say(text).unwrap_err().0;
    assert_eq!(
        report("(pw:set-noise :postion 0.1)"),
        "postion is no kind of noise; did you mean position?"
    );
    assert_eq!(
        report("(pw:set-noise :misses 2)"),
        "The noise misses is a number from 0 to 1, not 2."
    );
    assert!(report("(pw:set-noise :misses)").contains("a name and a number"));
    assert!(report("(pw:set-noise :misses :often)").contains("REAL"));
    let options = SessionOptions {
        noise: Some("position:0.1".to_owned()),
        ..SessionOptions::default()
    };
    let error = Session::new(&options).err().unwrap().to_string();
    assert!(error.contains("NAME=NUMBER"), "{error}");
}

#[test]
fn noise_that_begins_anew_makes_other_errors() {
    let mut cook = Cook::at_table_with_bottle();
    let mut look = || {
        cook.done(
            "(desig:desig-prop-value
               (with-simulated-robot (with-noise (:position 0.01) (find-object :bottle))) :pose)",
        )
    };
    assert_ne!(look(), look());
}

/// How far (m) bottles end from their target, with the noise of the robot: where they were taken from
/// a table and brought to the other one. A plan that fails brings none.
fn misses(noise: &str, count: usize) -> Vec<f64> {
    let mut all = Vec::new();
    for number in 0..count {
        let mut cook = Cook::new();
        let shown = cook.done(&format!(
            "(progn
               (btr-utils:spawn-object 'b :bottle :pose (list (list (- -1.0 (* 0.07 {number})) -0.85 0.86) '(0 0 0 1)))
               (pw:set-noise {noise})
               (handler-case
                   (with-simulated-robot
                     (let ((?to (make-pose \"map\" '((-0.85 1.5 0.961) (0 0 0 1)))))
                       (perform (an action (type transporting) (object (an object (type bottle)))
                                   (location (a location (on (an object (type counter-top)
                                                                (urdf-name table-area-main)
                                                                (part-of kitchen)))))
                                   (target (a location (pose ?to))))))
                     :brought)
                 (cpl:plan-failure () :failed)))"
        ));
        if shown.contains(":BROUGHT") {
            let world = cook.session.simulation().world();
            let at = world
                .object_pose("B")
                .expect("it is there")
                .translation
                .vector;
            all.push((at.x + 0.85).hypot(at.y - 1.5));
        }
    }
    all.sort_by(f64::total_cmp);
    all
}

#[test]
fn errors_are_felt_where_things_end() {
    let without = misses("", 2);
    assert!(
        without.len() == 2 && without.iter().all(|miss| *miss < 1e-3),
        "{without:?}"
    );
    for noise in [
        ":position 0.01",
        ":odometry-position 0.01",
        ":odometry-yaw 0.02",
        ":grasp-position 0.01",
    ] {
        let felt = misses(noise, 2);
        let most = felt.last().copied().unwrap_or_default();
        assert!((2e-3..0.05).contains(&most), "{noise}: {felt:?}");
    }
    let usual = misses(":usual", 5);
    let middle = usual.get(usual.len() / 2).copied().unwrap_or_default();
    assert!((5e-3..30e-3).contains(&middle), "{usual:?}");
}
