//! What questions to the world cost in a kitchen with thirty objects: `cargo bench --bench questions`.
#![allow(missing_docs)]

use criterion::{Criterion, criterion_group, criterion_main};
use planwright::{Evaluate, Event, Session, SessionOptions};

/// Fifteen objects on the island, before which the robot stands, and fifteen beside the sink.
const SCENE: &str = "
    (in-package :btr)
    (pp-tut:init-projection)
    (dotimes (i 30)
      (destructuring-bind (x y width depth) (if (< i 15) '(-1.1 0.6 0.2 0.2) '(1.35 0.0 0.15 0.3))
        (btr-utils:spawn-object (intern (format nil \"THING-~a\" i)) (nth (mod i 4) '(:bottle :cup :bowl :mug))
                                :pose (list (list (+ x (* width (mod i 3)))
                                                  (+ y (* depth (mod (floor i 3) 5)))
                                                  (if (< i 15) 0.97 0.96))
                                            '(0 0 0 1)))))
    (prolog-?w '(assert (object-pose ?w :robot ((-0.2 1.0 0) (0 0 1 0)))))
    (%set-joint :robot \"head_tilt_joint\" 0.7)
    (defun answers (goal) (length (cut:force-ll (prolog-?w goal))))";

/// Of all objects, and of one.
const GOALS: [&str; 22] = [
    "(item ?w ?x)",
    "(object-pose ?w ?x ?p)",
    "(contact ?w ?a ?b)",
    "(supported-by ?w ?a ?b)",
    "(supported-by ?w thing-8 ?b)",
    "(above ?w ?a ?b)",
    "(above ?w thing-8 ?b)",
    "(in ?w ?a ?b)",
    "(near ?w ?a ?b)",
    "(left-of ?w ?a ?b)",
    "(visible ?w ?r ?o)",
    "(visible ?w ?r thing-8)",
    "(occluding-objects ?w ?r thing-8 ?o)",
    "(reachable ?w ?r ?o)",
    "(reachable ?w ?r thing-8)",
    "(pose-reachable ?w ?r ((-0.8 1.0 1.2) (0 0 1 0)) ?s)",
    "(blocking ?w ?r thing-8 ?o)",
    "(stable ?w ?o)",
    "(stable ?w thing-8)",
    "(joint-state ?w ?b ?j ?x)",
    "(link-pose ?w ?b ?l ?p)",
    "(object-grasp ?w ?n ?g ?s)",
];

/// What is said of a form: its values and its warnings, or why it was aborted.
fn said(session: &mut Session, text: &str) -> String {
    let mut said = Vec::new();
    session.evaluate("bench", text, &mut |event| match event {
        Event::Values(values) => said.extend(values),
        Event::Output(text) => said.push(text),
        Event::Aborted(abort) => said.push(abort.report),
        _ => {}
    });
    said.join(" ")
}

fn questions(c: &mut Criterion) {
    planwright::use_compiled_library();
    let mut session = Session::new(&SessionOptions::default()).expect("a session starts");
    let scene = said(&mut session, SCENE);
    assert!(scene.ends_with("ANSWERS"), "{scene}");
    assert!(!scene.contains("did not stay"), "{scene}");
    for goal in GOALS {
        let form = format!("(answers '{goal})");
        let count = said(&mut session, &form);
        let name = format!("{goal}, answers: {count}");
        c.bench_function(&name, |b| b.iter(|| said(&mut session, &form)));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = questions
}
criterion_main!(benches);
