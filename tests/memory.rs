//! Tasks that have ended leave nothing behind. In a process of its own, whose memory nobody
//! else uses.

#![cfg(target_os = "linux")]

use planwright::{Evaluate, Outcome, Session, SessionOptions};

/// Kilobytes of memory that this process holds.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:"));
    let number = line.and_then(|line| line.split_whitespace().nth(1));
    number.unwrap().parse().unwrap()
}

#[test]
fn memory_stays_flat_over_a_million_tasks() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut run = |text: &str| {
        let outcome = session.evaluate("test", text, &mut |_| {});
        assert_eq!(outcome, Outcome::Finished, "{text}");
        resident()
    };
    run("(defun many (n)
           (dotimes (i n)
             (cpl:top-level (cpl:par-loop (x '(1 2 3 4 5 6 7 8 9)) (* x x)))))");
    let before = run("(many 10000)");
    let after = run("(many 90000)");
    assert!(
        after < before + 2048,
        "{before} kB after 100,000 tasks, {after} kB after a million"
    );
}
