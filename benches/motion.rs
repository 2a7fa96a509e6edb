//! What planning costs, how long motions take compared with the shortest time that is possible,
//! and how soon an interrupt takes effect: `cargo bench --bench motion`.
//! `cargo bench --bench motion -- clutter` prints the figures of 200 cluttered scenes.
#![allow(missing_docs)]

mod measured;

use std::ops::Range;
use std::sync::atomic::Ordering;
use std::thread;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use measured::Watch;
use planwright::measured::{PlannedMotion, cluttered_arms, cluttered_drives};
use planwright::{Evaluate, Outcome, Session, SessionOptions};

fn planning(c: &mut Criterion) {
    planwright::measured::trajectories(&mut Watch(c));
    planwright::measured::drives(&mut Watch(c));
    planwright::measured::arms(&mut Watch(c));
}

/// The processor time that this thread has taken, where the system tells; else the real time.
fn processor_time(began: Instant) -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let told = told.and_then(|text| text.split_whitespace().next()?.parse().ok());
    told.map_or_else(|| began.elapsed(), Duration::from_nanos)
}

/// Prints median, 95th percentile and worst of the numbers.
#[allow(clippy::print_stdout, reason = "the figures are what the bench is for")]
fn figures(name: &str, mut numbers: Vec<f64>) {
    numbers.sort_by(f64::total_cmp);
    if let Some(worst) = numbers.last() {
        let [median, most] = [50, 95].map(|percent| numbers[numbers.len() * percent / 100]);
        let count = numbers.len();
        println!("{name}: median {median:.2}, p95 {most:.2}, worst {worst:.2} of {count}");
    }
}

/// Planning times, and durations as multiples of the least that is possible, in many scenes.
fn clutter(_: &mut Criterion) {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let filter = arguments.iter().find(|argument| !argument.starts_with('-'));
    let is_test = arguments.iter().any(|argument| argument == "--test");
    if is_test || filter.is_some_and(|filter| filter != "clutter") {
        return;
    }
    let began = Instant::now();
    let mut clock = || processor_time(began);
    let of_all = |name: &str, motions: &[PlannedMotion]| {
        let planning = motions.iter().map(|m| 1e3 * m.planning.as_secs_f64());
        figures(&format!("{name}, planning (ms)"), planning.collect());
        let times = motions.iter().filter_map(|motion| motion.times);
        let ratios = times.filter(|[_, bound]| *bound > SHORTEST);
        let ratios = ratios.map(|[duration, bound]| duration / bound);
        figures(&format!("{name}, duration / bound"), ratios.collect());
    };
    let mut motions = Vec::new();
    cluttered_arms(SCENES, &mut clock, &mut |motion| motions.push(motion));
    of_all("arms in clutter", &motions);
    motions.clear();
    cluttered_drives(SCENES, &mut clock, &mut |motion| motions.push(motion));
    of_all("drives in clutter", &motions);
}

/// The seeds of the scenes.
const SCENES: Range<u64> = 0..200;
/// Motions that could be done in less time (s) are left out of the figures of durations.
const SHORTEST: f64 = 0.05;

/// No path leads to this goal, and it takes a while to find that out.
const FAR: &str = "(with-simulated-robot
  (let ((?far (make-pose \"map\" '((3 3 0) (0 0 0 1)))))
    (perform (an action (type going) (target (a location (pose ?far)))))))";

/// The time from Ctrl-C until planning is abandoned.
fn interrupts(c: &mut Criterion) {
    planwright::use_compiled_library();
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
    targets = planning, interrupts, clutter
}
criterion_main!(benches);
