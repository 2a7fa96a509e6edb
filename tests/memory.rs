//! Tasks that have ended leave nothing behind, nor do values that hold each other. In a process of
//! its own, whose memory nobody else uses.

#![cfg(target_os = "linux")]

use std::sync::Mutex;

use planwright::{Evaluate, Outcome, Session, SessionOptions};

/// One test at a time: they measure the memory of the process.
static MEMORY: Mutex<()> = Mutex::new(());

/// Kilobytes of memory that this process holds.
fn resident() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmRSS:"));
    let number = line.and_then(|line| line.split_whitespace().nth(1));
    number.unwrap().parse().unwrap()
}

/// Kilobytes of memory that this process holds after an evaluation.
fn resident_after(session: &mut Session, text: &str) -> u64 {
    let outcome = session.evaluate("test", text, &mut |_| {});
    assert_eq!(outcome, Outcome::Finished, "{text}");
    resident()
}

#[test]
fn memory_stays_flat_over_a_million_tasks() {
    let _alone = MEMORY.lock();
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut run = |text: &str| resident_after(&mut session, text);
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

#[test]
fn memory_stays_flat_over_a_million_circles_of_each_kind() {
    let _alone = MEMORY.lock();
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut run = |text: &str| resident_after(&mut session, text);
    run("(defstruct node next) (defclass thing () ((part :accessor part)))");
    for circle in [
        "(labels ((f (n) (if (= n 0) 0 (f (- n 1))))) (f 1))",
        "(labels ((a (n) (if (= n 0) 0 (b (- n 1)))) (b (n) (a n))) (a 2))",
        "(let ((f nil)) (setf f (lambda () f)))",
        "(let ((l (list 1 2 3))) (setf (cdr (last l)) l))",
        "(let ((l (list 1 2 3))) (nconc l l))",
        "(let ((v (vector 1 2))) (setf (aref v 0) (list v)))",
        "(let ((n (make-node))) (setf (node-next n) n))",
        "(let ((x (make-instance 'thing))) (setf (part x) x))",
        "(let ((h (make-hash-table))) (setf (gethash 1 h) h))",
        "(let ((f (cpl:make-fluent :value 0))) (setf (cpl:value f) (list f)))",
        "(let ((f (cpl:make-fluent)))
           (cpl:register-update-callback f 'it (lambda (v) (declare (ignore v)) f)))",
        "(desig:equate (desig:make-designator :object '((:type :bottle)))
                       (desig:make-designator :object '((:type :bottle))))",
        "(let ((l (list :a 1))) (setf (second l) (desig:make-designator :object (list l))))",
        "(gensym)",
        "(list (make-symbol \"A\") (copy-symbol 'circle) (gensym 3))",
        "(read-from-string \"#:passing\")",
    ] {
        let before = run(&format!("(dotimes (i 100000) {circle})"));
        let after = run(&format!("(dotimes (i 900000) {circle})"));
        assert!(
            after < before + 8192,
            "{before} kB after 100,000 times {circle}, {after} kB after a million"
        );
    }
}

#[test]
fn sessions_that_have_ended_leave_nothing_behind() {
    let _alone = MEMORY.lock();
    let transport = "(in-package :pp-tut)
        (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
        (with-simulated-robot
          (let ((?spot (make-pose \"map\" '((-0.8 2 0.96) (0 0 0 1)))))
            (perform (an action (type transporting) (object (an object (type bottle)))
                                (target (a location (pose ?spot)))))))";
    let run = |count: usize| {
        for _ in 0..count {
            let mut session = Session::new(&SessionOptions::default()).unwrap();
            resident_after(&mut session, transport);
        }
        resident()
    };
    let before = run(5);
    let after = run(10);
    assert!(
        after < before + 2048,
        "{before} kB after 5 sessions, {after} kB after 15"
    );
    let idle = |count: usize| {
        for _ in 0..count {
            Session::new(&SessionOptions::default()).unwrap();
        }
        resident()
    };
    let before = idle(10);
    let after = idle(60);
    assert!(
        after < before + 1024,
        "{before} kB after 10 sessions that do nothing, {after} kB after 70"
    );
}

#[test]
fn threads_that_had_a_session_leave_nothing_behind() {
    let _alone = MEMORY.lock();
    let threads = |count: usize| {
        for _ in 0..count {
            let session = std::thread::spawn(|| {
                let mut session = Session::new(&SessionOptions::default()).unwrap();
                resident_after(&mut session, "(dotimes (i 1000) (list i i i i i i i i))");
            });
            session.join().unwrap();
        }
        resident()
    };
    let before = threads(10);
    let after = threads(50);
    assert!(
        after < before + 1024,
        "{before} kB after 10 threads, {after} kB after 60"
    );
}
