//! How fast the language is: calls, failure handling, reading and compiling plans.

use criterion::{Criterion, criterion_group, criterion_main};
use planwright::{Evaluate, Event, Outcome, Session, SessionOptions};

fn session() -> Session {
    // The built-in models are known to be valid.
    Session::new(&SessionOptions::default()).unwrap()
}

fn run(session: &mut Session, text: &str) {
    let outcome = session.evaluate("bench", text, &mut |event| {
        if let Event::Aborted(abort) = event {
            panic!("{}", abort.report);
        }
    });
    assert_eq!(outcome, Outcome::Finished);
}

/// `(fib 20)` makes 21891 calls.
fn calls(c: &mut Criterion) {
    let mut session = session();
    let definition = "(defun fib (n) (if (< n 2) n (+ (fib (- n 1)) (fib (- n 2)))))";
    run(&mut session, definition);
    c.bench_function("fib 20: 21891 calls", |b| {
        b.iter(|| run(&mut session, "(fib 20)"));
    });
}

/// A thousand failures, each handled and retried.
fn failures(c: &mut Criterion) {
    let mut session = session();
    let definition = "(defun retry-often (n)
        (let ((tries 0))
          (cpl:with-failure-handling
              ((cpl:plan-failure (e)
                 (declare (ignore e))
                 (when (< tries n) (cpl:retry))
                 (return tries)))
            (incf tries)
            (cpl:fail \"again\"))))";
    run(&mut session, definition);
    c.bench_function("1000 failures handled and retried", |b| {
        b.iter(|| run(&mut session, "(retry-often 1000)"));
    });
}

/// Parallel branches that do nothing.
fn branches(c: &mut Criterion) {
    let mut session = session();
    let form = format!("(cpl:top-level (cpl:par {}))", "nil ".repeat(100));
    c.bench_function("par of 100 empty branches", |b| {
        b.iter(|| run(&mut session, &form));
    });
}

/// Two tasks that wake each other a thousand times: 2000 waits, each ended by the other task.
fn fluents(c: &mut Criterion) {
    let mut session = session();
    let definition = "(defun play (n)
        (let ((ball (cpl:make-fluent :name 'ball :value 0)))
          (cpl:top-level
            (cpl:par
              (dotimes (i n)
                (cpl:wait-for (cpl:fl-funcall #'evenp ball))
                (incf (cpl:value ball)))
              (dotimes (i n)
                (cpl:wait-for (cpl:fl-funcall #'oddp ball))
                (incf (cpl:value ball)))))
          (cpl:value ball)))";
    run(&mut session, definition);
    c.bench_function("1000 round trips between two tasks", |b| {
        b.iter(|| run(&mut session, "(play 1000)"));
    });
    let definition = "(defun play-on (n)
        (let* ((ball (cpl:make-fluent :name 'ball :value 0))
               (even (cpl:fl-funcall #'evenp ball))
               (odd (cpl:fl-funcall #'oddp ball)))
          (cpl:top-level
            (cpl:par
              (dotimes (i n) (cpl:wait-for even) (incf (cpl:value ball)))
              (dotimes (i n) (cpl:wait-for odd) (incf (cpl:value ball)))))))";
    run(&mut session, definition);
    c.bench_function("1000 round trips through two fluent nets", |b| {
        b.iter(|| run(&mut session, "(play-on 1000)"));
    });
}

/// A plan file of about 10 KB.
fn files(c: &mut Criterion) {
    let mut session = session();
    let plan = include_str!("../plans/tutorial/move-bottle.plan");
    let definitions = plan.split("(move-bottle '(").next().unwrap_or_default();
    let text = definitions.repeat(10_000 / definitions.len() + 1);
    let name = format!("a plan of {} bytes, read and compiled", text.len());
    c.bench_function(&name, |b| b.iter(|| run(&mut session, &text)));
}

/// From nothing to a prompt: first as a program does that has not called `use_compiled_library`, which counts from
/// then on.
fn start(c: &mut Criterion) {
    c.bench_function("start of a session from the library's texts", |b| {
        b.iter(session);
    });
    planwright::use_compiled_library();
    c.bench_function("start of a session", |b| b.iter(session));
}

criterion_group!(benches, start, calls, failures, branches, fluents, files);
criterion_main!(benches);
