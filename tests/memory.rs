//! Tasks that have ended leave nothing behind, nor do values that hold each other. In a process of
//! its own, whose memory nobody else uses.

#![cfg(target_os = "linux")]

use std::alloc::System;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use cap::Cap;
use planwright::{Evaluate, HeapLimit, Outcome, Session, SessionOptions};

#[global_allocator]
static HEAP: Cap<System> = Cap::new(System, usize::MAX);

/// The most bytes that were in use when a session looked.
static MOST: AtomicUsize = AtomicUsize::new(0);

/// The bytes in use.
fn in_use() -> usize {
    let bytes = HEAP.allocated();
    MOST.fetch_max(bytes, Ordering::Relaxed);
    bytes
}

/// One test at a time: they measure the memory of the process.
static MEMORY: Mutex<()> = Mutex::new(());

/// Keeps other tests away. Sessions start from the compiled library, as those of the program do.
fn alone() -> MutexGuard<'static, ()> {
    planwright::use_compiled_library();
    MEMORY.lock().unwrap_or_else(PoisonError::into_inner)
}

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

/// Bytes that are allocated after an evaluation.
fn allocated_after(session: &mut Session, text: &str) -> usize {
    let outcome = session.evaluate("test", text, &mut |_| {});
    assert_eq!(outcome, Outcome::Finished, "{text}");
    HEAP.allocated()
}

#[test]
fn memory_stays_flat_over_a_million_tasks() {
    let _alone = alone();
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
    let _alone = alone();
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

/// Options with a limit, so that the collector knows how much memory is in use.
fn limited(bytes: usize) -> SessionOptions {
    SessionOptions {
        heap: Some(HeapLimit { bytes, in_use }),
        ..SessionOptions::default()
    }
}

#[test]
fn circles_of_all_kinds_of_objects_are_freed_whatever_their_size() {
    let _alone = alone();
    let mut session = Session::new(&limited(1 << 30)).unwrap();
    let mut run = |text: &str| allocated_after(&mut session, text);
    run(
        "(defstruct node next) (defclass thing () ((part :accessor part)))
         (defgeneric visit (x))
         (defun long (x) (append (make-list 30) (list x)))",
    );
    for (count, circle) in [
        (20_000, "(let ((l (make-list 8))) (setf (cdr (last l)) l))"),
        (10, "(let ((l (make-list 100000))) (setf (cdr (last l)) l))"),
        (
            5000,
            "(let ((v (make-array 9))) (setf (aref v 3) (long v)))",
        ),
        (
            5000,
            "(let ((a (make-array '(3 3)))) (setf (aref a 1 1) (long a)))",
        ),
        (
            5000,
            "(let ((n (make-node))) (setf (node-next n) (long n)))",
        ),
        (
            5000,
            "(let ((x (make-instance 'thing))) (setf (part x) (long x)))",
        ),
        (
            5000,
            "(let ((f nil)) (setf f (let ((l (long 1))) (lambda () (cons f l)))))",
        ),
        (
            5000,
            "(let ((h (make-hash-table))) (dotimes (i 9) (setf (gethash (list i) h) (long h))))",
        ),
        (
            5000,
            "(let ((f (cpl:make-fluent :value 0))) (setf (cpl:value f) (long f)))",
        ),
        (
            5000,
            "(let ((f (cpl:make-fluent :value 0))) (setf (cpl:value f) (cpl:fl-funcall (lambda (x) x) f)))",
        ),
        (5000, "(let ((g (gensym))) (setf (get g 'self) (long g)))"),
        (
            5000,
            "(let ((g (gensym))) (setf (symbol-value g) (long g)))",
        ),
        (
            5000,
            "(let ((g (gensym))) (setf (symbol-function g) (lambda () g)))",
        ),
        (
            5000,
            "(let ((g (gensym)) (h (gensym))) (setf (symbol-value g) h (symbol-value h) g))",
        ),
        (20_000, "(setf (symbol-value (gensym)) 1)"),
        (4000, "(delete-package (make-package \"PASSING\"))"),
        (
            5000,
            "(let ((c (make-condition 'simple-error :format-arguments (list 1))))
               (setf (cdr (simple-condition-format-arguments c)) (long c)))",
        ),
        (
            5000,
            "(let ((r nil)) (restart-case (setf r (long (compute-restarts))) (again () r)))",
        ),
        (
            5000,
            "(let ((g (gensym)))
               (set g (make-two-way-stream (make-synonym-stream g) (make-synonym-stream g))))",
        ),
        (
            100,
            "(progn (eval '(defmethod visit ((x (eql 7))) (lambda () x)))
                    (remove-method #'visit (find-method #'visit '() (list '(eql 7)))))",
        ),
        (
            100,
            "(eval '(defclass again () ((a :initform (let ((f nil)) (setf f (lambda () f)))))))",
        ),
        (
            2000,
            "(let ((x (list nil))) (cpl:top-level (cpl:with-tags (:tag a (setf (car x) a) (long x)))))",
        ),
        (
            5000,
            "(let ((g (gensym))) (set g (make-broadcast-stream (make-synonym-stream g))))",
        ),
        (
            5000,
            "(let ((l (list 1 2 3)))
                  (setf (third l) (prolog:prolog `(prolog:member ?x ,l))))",
        ),
        (
            5000,
            "(let ((l (list 1 2 3))) (setf (third l) (cut:lazy-list ((i 0)) (cut:cont l (1+ i)))))",
        ),
    ] {
        let before = run(&format!("(dotimes (i {count}) {circle}) (tg:gc :full t)"));
        let after = run(&format!(
            "(dotimes (i {}) {circle}) (tg:gc :full t)",
            3 * count
        ));
        assert!(
            after < before + (256 << 10),
            "{before} B after {count} times {circle}, {after} B after {}",
            4 * count
        );
    }
}

#[test]
fn symbols_go_with_what_refers_to_them() {
    let _alone = alone();
    let mut session = Session::new(&limited(1 << 30)).unwrap();
    let mut run = |text: &str| allocated_after(&mut session, text);
    run(
        "(defmacro twice (x) (let ((g (gensym))) `(let ((,g ,x)) (+ ,g ,g))))
         (defvar *place* (list 1 2))",
    );
    for form in [
        "(eval '(loop for x in '(1 2) collect x))",
        "(eval '(dolist (x '(1 2)) x))",
        "(eval '(incf (car *place*)))",
        "(eval '(twice 3))",
        "(eval '(handler-case (error \"no\") (error (e) e)))",
        "(eval '(cpl:with-failure-handling ((cpl:simple-plan-failure (e) e)) 1))",
        "(let ((g (gensym))) (eval `(let ((,g 1)) (lambda () ,g))))",
        "(let ((g (gensym))) (eval `(flet ((,g (x) x)) (,g 1))))",
        "(let ((g (gensym))) (eval `(defun ,g (n) (if (= n 0) 1 (,g (- n 1))))))",
        "(let ((g (gensym))) (eval `(defun ,g () (lambda () '(,g)))))",
        "(let ((g (gensym))) (setf (symbol-function g) (eval `(lambda () (,g)))))",
        "(unintern (intern (format nil \"NEW-~a\" (random 1000000000))))",
        "(unintern (gentemp))",
        "(unintern (read-from-string (format nil \"new-~a\" (random 1000000000))))",
        "(with-input-from-string (s (format nil \"(cl-user::new-~a)\" (random 1000000000)))
           (unintern (first (read s))))",
        "(let ((s (intern (format nil \"NEW-~a\" (random 1000000000)))))
           (setf (get s 'self) s (symbol-value s) (list s))
           (unintern s))",
        "(let ((p (make-package (format nil \"NEW-~a\" (random 1000000000)))))
           (intern \"A\" p)
           (export (intern \"B\" p) p)
           (delete-package p))",
    ] {
        let before = run(&format!("(dotimes (i 1000) {form}) (tg:gc :full t)"));
        let after = run(&format!("(dotimes (i 3000) {form}) (tg:gc :full t)"));
        assert!(
            after < before + 65_536,
            "{before} B after 1,000 times {form}, {after} B after 4,000"
        );
    }
}

#[test]
fn memory_that_circles_hold_is_freed_before_it_is_said_to_be_exhausted() {
    let _alone = alone();
    let limit = HEAP.allocated() + (48 << 20);
    let mut session = Session::new(&limited(limit)).unwrap();
    MOST.store(0, Ordering::Relaxed);
    for round in [
        "(make-list 200000)",
        "(make-list 3)",
        "(vector (make-string 300000))",
    ] {
        let circles = format!(
            "(dotimes (i 60) (let ((x (list {round}))) (setf (cdr x) x)))
             (dotimes (i 100) (let ((x (list (make-list 10000)))) (setf (cdr x) x)))"
        );
        let outcome = session.evaluate("test", &circles, &mut |_| {});
        assert_eq!(outcome, Outcome::Finished, "{circles}");
    }
    // What is in use for good is not.
    let full = "(handler-case (let ((all '())) (loop (push (make-list 1000) all)))
                  (storage-condition () 'full))";
    assert_eq!(
        session.evaluate("test", full, &mut |_| {}),
        Outcome::Finished
    );
    let most = MOST.load(Ordering::Relaxed);
    assert!(
        most < limit + limit / 10,
        "{most} B of {limit} B were in use"
    );
}

#[test]
fn a_limit_that_is_set_is_kept_whatever_fills_it() {
    let _alone = alone();
    let mut session = Session::new(&limited(usize::MAX)).unwrap();
    let is_over = AtomicBool::new(false);
    let wrong = std::thread::scope(|scope| {
        // A vector that has grown is smaller again before a session looks.
        scope.spawn(|| {
            while !is_over.load(Ordering::Relaxed) {
                in_use();
                std::thread::sleep(Duration::from_micros(50));
            }
        });
        let mut wrong = Vec::new();
        for filling in [
            "(let ((all '())) (loop (push (make-string 1000) all)))",
            "(let ((all '())) (loop (push (make-hash-table) all)))",
            "(let ((all '())) (loop (push (make-array '(10 10)) all)))",
            "(let ((all '())) (loop (push (gensym) all)))",
            "(let ((all '())) (loop (push (lambda () all) all)))",
            "(let ((all '())) (loop (push (make-condition 'error) all)))",
            "(let ((all '())) (loop (push (cpl:make-fluent) all)))",
            "(let ((all '())) (loop (push (desig:make-designator :object '((:type :cup))) all)))",
            "(let ((h (make-hash-table))) (loop for i from 0 do (setf (gethash i h) i)))",
            "(let ((v (make-array 1 :adjustable t :fill-pointer 0))) (loop (vector-push-extend 1 v)))",
            "(let ((s \"ab\")) (loop (setf s (concatenate 'string s s))))",
            "(let ((l (list 1 2))) (loop (setf l (append l l))))",
            "(let ((x (list 1))) (loop (setf x (copy-tree (list x x)))))",
        ] {
            assert_eq!(
                session.evaluate("test", "(tg:gc :full t)", &mut |_| {}),
                Outcome::Finished
            );
            MOST.store(0, Ordering::Relaxed);
            let limit = in_use() + (48 << 20);
            let heap = &session.image_mut().limits.heap;
            heap.set_limit(limited(limit).heap);
            let form = format!("(handler-case {filling} (storage-condition () 'full))");
            let outcome = session.evaluate("test", &form, &mut |_| {});
            assert_eq!(outcome, Outcome::Finished, "{filling}");
            let most = MOST.load(Ordering::Relaxed);
            if most > limit + limit / 10 {
                wrong.push(format!("{most} B of {limit} B were in use: {filling}"));
            }
        }
        is_over.store(true, Ordering::Relaxed);
        wrong
    });
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn sessions_that_have_ended_leave_nothing_behind() {
    let _alone = alone();
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
    let _alone = alone();
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

#[test]
fn a_thread_that_had_a_session_gives_everything_back() {
    let _alone = alone();
    let work = "(in-package :pp-tut)
        (let ((l (make-list 8))) (setf (cdr (last l)) l))
        (let ((g (gensym))) (setf (get g 'self) g))
        (dotimes (i 20)
          (let ((?i (a location (on (an object (urdf-name kitchen-island-surface)
                                               (part-of kitchen))))))
            (desig:reference ?i)))
        (init-projection)
        (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))
        (with-simulated-robot (perform (an action (type parking-arms))))";
    let after_one = || {
        let session = std::thread::spawn(move || {
            let mut session = Session::new(&limited(1 << 30)).unwrap();
            resident_after(&mut session, work);
        });
        session.join().unwrap();
        HEAP.allocated()
    };
    // The first one makes what all share.
    after_one();
    let [before, after] = [after_one(), after_one()];
    assert!(
        after < before + 4096,
        "{before} B before a thread, {after} B after it"
    );
}

#[test]
fn references_of_symbolic_locations_leave_nothing_behind() {
    let _alone = alone();
    let mut session = Session::new(&limited(1 << 30)).unwrap();
    let mut run = |text: &str| allocated_after(&mut session, text);
    run("(in-package :pp-tut)
         (defun references (n)
           (dotimes (i n)
             (let ((?i (a location (on (an object (urdf-name kitchen-island-surface)
                                                  (part-of kitchen))))))
               (desig:reference ?i))))");
    let before = run("(references 20) (tg:gc :full t)");
    let after = run("(references 40) (tg:gc :full t)");
    assert!(
        after < before + (128 << 10),
        "{before} B after 20 references, {after} B after 60"
    );
    // Nobody has to ask for it.
    let most = run("(references 400)");
    assert!(
        most < after + (20 << 20),
        "{after} B before 400 references, {most} B after them"
    );
}

#[test]
fn forms_that_change_the_world_take_little_memory() {
    let _alone = alone();
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut run = |text: &str| allocated_after(&mut session, text);
    run("(in-package :pp-tut) (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)))");
    // A form at top level each, which can be taken back, and after which the world is remembered.
    let forms = |count: u32| -> String {
        let x = |form: u32| -1.7 + 0.005 * f64::from(form);
        let form = |form| {
            format!(
                "(btr-utils:move-object 'bottle-1 '(({} -0.9 0.82) (0 0 0 1)))\n",
                x(form)
            )
        };
        (0..count).map(form).collect()
    };
    let before = run(&forms(10));
    let after = run(&forms(100));
    assert!(
        after < before + 100 * (15 << 10),
        "{before} B after 10 forms, {after} B after 110"
    );
    // There are no more than that.
    let later = run(&forms(100));
    assert!(
        later < after + (256 << 10),
        "{after} B after 110 forms, {later} B after 210"
    );
}

#[test]
fn locations_that_a_program_keeps_do_not_keep_copies_of_the_world() {
    let _alone = alone();
    let mut session = Session::new(&limited(1 << 30)).unwrap();
    let mut run = |text: &str| allocated_after(&mut session, text);
    run("(in-package :pp-tut)
         (defvar *kept* '())
         (defun keep (n)
           (dotimes (i n)
             (let* ((?p (make-pose \"map\" '((-1.4 -0.9 0.8) (0 0 0 1))))
                    (?place (a location (reachable-for pr2)
                                        (location (a location (pose ?p))))))
               (desig:reference ?place)
               (push ?place *kept*))))");
    let before = run("(keep 10) (tg:gc :full t)");
    let after = run("(keep 40) (tg:gc :full t)");
    assert!(
        after < before + (2 << 20),
        "{before} B with 10 locations, {after} B with 50"
    );
}
