//! Questions to how the world was: HOLDS with a time, events and contacts, and what is refused.

use super::{said, said_and_printed};
use session::{Session, SessionOptions};

/// A session in which the robot has picked up a bottle, a hand of which is opened afterwards.
fn session() -> Session {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    said(
        &mut session,
        "(in-package :pp-tut)
         (defun rows-of (variables goal)
           (mapcar (lambda (answer)
                     (mapcar (lambda (variable) (cut:var-value variable answer)) variables))
                   (cut:force-ll (prolog:prolog goal))))
         (init-projection)
         (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
         (with-simulated-robot
           (let ((?table (make-pose \"map\" '((-1.447 -0.15 0) (0 0 -0.7071 0.7071))))
                 (?spot (make-pose \"base_footprint\" '((0.65 0.08 0.76) (0 0 0 1)))))
             (perform (a motion (type moving-torso) (joint-angle 0.3)))
             (park-arms)
             (perform (an action (type going) (target (a location (pose ?table)))))
             (perform (an action (type looking) (target (a location (pose ?spot)))))
             (let ((?bottle (perform (an action (type detecting) (object (an object (type bottle)))))))
               (perform (an action (type picking-up) (arm right) (grasp left-side) (object ?bottle))))))",
    );
    session
}

#[test]
fn what_held_is_known_for_every_time() {
    let mut session = session();
    for (question, answer) in [
        // Before it was gripped, it stood on the table; then it was in the hand, and later above the table.
        (
            "(let ((gripped (caar (rows-of '(?t) '(coe:occurs (attached bottle-1 :right) ?t)))))
               (flet ((asked (occasion time) (and (coe:holds occasion `(at ,time)) t)))
                 (list (asked '(cpoe:object-in-hand bottle-1) (- gripped 0.1))
                       (asked '(cpoe:object-in-hand bottle-1) (+ gripped 0.1))
                       (asked '(btr:supported-by ?w bottle-1 :kitchen) (- gripped 0.1))
                       (asked '(btr:supported-by ?w bottle-1 :kitchen) (system:clock)))))",
            "(NIL T T NIL)",
        ),
        (
            "(mapcar #'first (rows-of '(?hand ?from ?to) '(coe:holds (cpoe:object-in-hand ?o ?hand) (throughout ?from ?to))))",
            "(:RIGHT)",
        ),
        (
            "(rows-of '(?type)
               '(and (coe:occurs (attached bottle-1 ?arm) ?time)
                     (coe:task-specific-action :top-level () ?type ?task ?designator)
                     (prolog:member ?type (:detecting :picking-up :placing))
                     (coe:task-started-at ?task ?from)
                     (coe:task-ended-at ?task ?to)
                     (coe:duration-includes (throughout ?from ?to) (at ?time))))",
            "((:PICKING-UP))",
        ),
        (
            "(length (rows-of '(?from ?to) '(coe:holds (coe:task-status ?t :running) (throughout ?from ?to))))",
            // Every task has run once.
            "(length (rows-of '(?t) '(coe:task ?t)))",
        ),
        (
            "(rows-of '(?kind) '(fact event :object bottle-1 :other \"table_area_main\" :kind ?kind))",
            "((:CONTACT-BEGAN) (:CONTACT-ENDED))",
        ),
        // Negation with a variable: nothing was in the left hand, ever.
        (
            "(rows-of '(?o) '(not (coe:holds (cpoe:object-in-hand ?o :left) (during 0 100))))",
            "((?O))",
        ),
    ] {
        let expected = match answer.starts_with("(length") {
            true => said(&mut session, answer),
            false => answer.to_owned(),
        };
        assert_eq!(said(&mut session, question), expected, "{question}");
    }
}

#[test]
fn a_question_to_the_past_changes_nothing() {
    let mut session = session();
    let now = "(list (btr-utils:object-pose 'bottle-1) (rob-int::base-pose) (system:clock) (coe:holds '(cpoe:object-in-hand bottle-1)))";
    let before = said(&mut session, now);
    said(
        &mut session,
        "(progn (coe:holds '(btr:stable ?w ?o) '(at 1)) (pw:ask '(fact object :object ?o :x ?x)))",
    );
    assert_eq!(said(&mut session, now), before);
    said(
        &mut session,
        "(ignore-errors (coe:holds '(cpoe:location-accessible ?l) '(at 1)))",
    );
    assert_eq!(said(&mut session, now), before);
}

#[test]
fn what_is_no_time_is_refused() {
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    for (question, part) in [
        (
            "(coe:holds '(cpoe:torso-at 0.3) 5)",
            "5 is no time: (at TIME), (during FROM TO) or (throughout FROM TO) was expected",
        ),
        (
            "(coe:holds '(cpoe:torso-at 0.3) '(at \"noon\"))",
            "is no time",
        ),
        (
            "(coe:holds '(cpoe:torso-at 0.3) '(at -2))",
            "How the world was at -2.000 s is not remembered",
        ),
        ("(coe:holds 'nonsense '(at 2))", "is not an occasion"),
        (
            "(coe:holds '(cpoe::nonsense ?x) '(at 2))",
            "There is no occasion NONSENSE",
        ),
    ] {
        let said = said_and_printed(&mut session, question);
        assert!(said.contains(part), "{question}: {said}");
    }
}
