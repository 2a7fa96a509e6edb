//! What planning costs, and how soon an interrupt takes effect: `cargo bench --bench motion`.
#![allow(missing_docs)]

mod measured;

use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use measured::Watch;
use planwright::{Evaluate, Outcome, Session, SessionOptions};

fn planning(c: &mut Criterion) {
    planwright::measured::trajectories(&mut Watch(c));
    planwright::measured::drives(&mut Watch(c));
    planwright::measured::arms(&mut Watch(c));
}

/// No path leads to this goal, and it takes a while to find that out.
const FAR: &str = "(with-simulated-robot
  (let ((?far (make-pose \"map\" '((3 3 0) (0 0 0 1)))))
    (perform (an action (type going) (target (a location (pose ?far)))))))";

/// The time from Ctrl-C until planning is abandoned.
fn interrupts(c: &mut Criterion) {
    let mut session = Session::new(&SessionOptions::default()).expect("a session");
    let outcome = session.evaluate("bench", "(in-package :pp-tut)", &mut |_| {});
    assert_eq!(outcome, Outcome::Finished);
    c.bench_function("an interrupt while a path is searched for", |bencher| {
        bencher.iter_custom(|count| {
            let interrupted = (0..count).map(|_| {
                let flag = session.interrupt_handle();
                let pressed = thread::spawn(move || {
                    thread::sleep(Duration::from_millis(50));
                    flag.store(true, Ordering::Relaxed);
                    Instant::now()
                });
                let outcome = session.evaluate("bench", FAR, &mut |_| {});
                let stopped = Instant::now();
                assert_eq!(outcome, Outcome::Aborted);
                stopped - pressed.join().expect("the key was pressed")
            });
            interrupted.sum()
        });
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = planning, interrupts
}
criterion_main!(benches);
