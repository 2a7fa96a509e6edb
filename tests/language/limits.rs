//! What is too much ends in a condition, and what is used up is given back.

use std::sync::atomic::Ordering;

use proptest::prelude::*;
use session::dialogue::screen::INTERRUPT;
use session::dialogue::{Evaluate, Event, Outcome, Repeat};
use session::{Session, SessionOptions};

fn session() -> Session {
    Session::new(&SessionOptions::default()).unwrap()
}

/// Everything that is told while a text is evaluated.
fn told(session: &mut Session, text: &str) -> (Outcome, String) {
    let mut shown = String::new();
    let outcome = session.evaluate("test", text, &mut |event| match event {
        Event::Output(text) => shown.push_str(&text),
        Event::Values(values) => shown.push_str(&format!("{values:?}\n")),
        Event::Aborted(abort) => shown.push_str(&format!("{} {}\n", abort.condition, abort.report)),
        _ => {}
    });
    (outcome, shown)
}

#[test]
fn calls_that_nest_without_end_are_a_condition_that_can_be_handled() {
    let mut session = session();
    let text = "(defun down (n) (if (= n 0) 0 (+ 1 (down (- n 1)))))
                (down 100000)
                (handler-case (down -1) (storage-condition () :too-deep))
                (+ 1 1)";
    let (outcome, shown) = told(&mut session, text);
    assert_eq!(outcome, Outcome::Finished, "{shown}");
    assert_eq!(
        shown,
        "[\"DOWN\"]\n[\"100000\"]\n[\":TOO-DEEP\"]\n[\"2\"]\n"
    );
}

#[test]
fn a_list_of_a_million_elements_is_worked_on_and_freed() {
    let mut session = session();
    let text = "(let ((l (loop for i below 1000000 collect i)))
                  (list (length l) (reduce #'+ l) (car (last (sort (mapcar #'- l) #'<)))
                        (equal l (copy-list l))))";
    let (outcome, shown) = told(&mut session, text);
    assert_eq!(outcome, Outcome::Finished, "{shown}");
    assert_eq!(shown, "[\"(1000000 499999500000 0 T)\"]\n");
}

/// How often a form looks whether it is to end before it is interrupted.
const LOOKS: u64 = 20;

#[test]
fn endless_loops_can_be_interrupted() {
    for endless in [
        "(loop)",
        "(loop for i from 0 collect (* i i) do (setf i 0))",
        "(let ((l (list 1 2))) (setf (cdr (last l)) l) (mapc #'identity l))",
        "(cpl:top-level (cpl:par (loop (cpl:sleep 1)) (loop (cpl:sleep 2))))",
        "(cpl:top-level (cpl:with-failure-handling ((error (e) (cpl:retry))) (error \"x\")))",
        "(equal '#1=(a . #1#) '#2=(a . #2#))",
        "(let ((a (vector 1)) (b (vector 1))) (setf (aref a 0) a (aref b 0) b) (equalp a b))",
        "(progn (defmacro mm () `(mm)) (mm))",
        "(progn (defmacro mm () `(mm)) (handler-case (macroexpand '(mm)) (t () 1)))",
        "(eval '#1=(progn 1 #1#))",
        "(length (princ-to-string (expt 7 3000000)))",
        "(read-from-string (make-string 3000000 :initial-element #\\9))",
        "(integer-length (isqrt (expt 7 3000000)))",
        "(integer-length (floor (expt 7 10000000) (expt 3 5000000)))",
        "(gcd (expt 3 2000000) (expt 7 1500000))",
        "(expt 7 20000000)",
        "(let ((d nil)) (dotimes (i 3000000) (setf d (list d))) (length (prin1-to-string d)))",
        "(length (copy-tree (let ((a (list 1))) (setf (cdr a) a) a)))",
        "(length (multiple-value-list (apply #'values (make-list 10000000))))",
    ] {
        let mut session = session();
        // It is then in the middle.
        session.interrupt_next_at(LOOKS);
        let (outcome, shown) = told(&mut session, endless);
        assert_eq!(outcome, Outcome::Aborted, "{endless}: {shown}");
        assert_eq!(shown, format!("{INTERRUPT} Interrupted.\n"), "{endless}");
        assert_eq!(session.interrupted_at(), Some(LOOKS), "{endless}");
        let (outcome, shown) = told(&mut session, "(+ 1 1)");
        assert_eq!((outcome, shown.as_str()), (Outcome::Finished, "[\"2\"]\n"));
    }
}

#[test]
fn what_has_been_written_is_seen_while_a_form_runs() {
    for endless in [
        "(progn (print :shown) (finish-output) (loop))",
        "(progn (princ :shown) (loop))",
        "(progn (format t \"SHOWN~%\") (equal '#1=(a . #1#) '#2=(a . #2#)))",
        "(progn (write-line \"SHOWN\") (equal '#1=(a . #1#) '#2=(a . #2#)))",
        "(cpl:top-level (cpl:par (progn (princ :shown) (loop)) (cpl:sleep 1)))",
        "(loop (write-string \"SHOWN\"))",
    ] {
        let mut session = session();
        let flag = session.interrupt_handle();
        let (mut shown, mut condition) = (String::new(), String::new());
        let outcome = session.evaluate("test", endless, &mut |event| match event {
            Event::Output(text) => {
                shown.push_str(&text);
                if shown.contains("SHOWN") {
                    flag.store(true, Ordering::Relaxed);
                }
            }
            Event::Aborted(abort) => condition = abort.condition,
            _ => {}
        });
        assert_eq!(outcome, Outcome::Aborted, "{endless}");
        assert_eq!(condition, INTERRUPT, "{endless}");
    }
}

#[test]
fn code_without_end_is_a_condition() {
    for endless in [
        "'#1=(progn #1#)",
        "'#1=(eval-when (:execute) #1#)",
        "'(destructuring-bind #1=(a #1#) '(1) 2)",
        "'(destructuring-bind #1=(&optional (#1# 1)) '(1) 2)",
        "'(defmacro m #1=(a #1#) 1)",
        "'(macrolet ((m #1=(a #1#) 1)) (m 1))",
        "'(let ((x 1)) . #1=((let ((x 1)) . #1#)))",
        "'(lambda () #1=(if #1# 1 2))",
        "'(setf #1=(car #1#) 1)",
        "'(loop for #1=(a #1#) in '(1) collect a)",
        "'(loop for #1=(a . #1#) in '(1) collect a)",
        "'(case 1 #1=((1 2 . #1#) 1))",
        "'(handler-case 1 #1=(error () . #1#))",
        "'(quasiquote #1=(a #1#))",
        "'(quasiquote #1=(a . #1#))",
        "'(the #1=(or integer #1#) 1)",
        "'(typep 1 '#1=(or integer #1#))",
        "'(symbol-macrolet ((a (car a))) a)",
        "'(defun f #1=(&optional (a #1#)) a)",
        "(let ((f 1)) (dotimes (i 300000) (setf f (list 'progn f))) f)",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list f))) `(destructuring-bind ,f nil 1))",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list f))) `(loop for ,f in nil collect 1))",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list f))) `(quasiquote ,f))",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list 'quasiquote f))) f)",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list 'or f))) `(typep 1 ',f))",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list 'car f))) `(setf ,f 1))",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list 'lambda nil f))) f)",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (vector f))) `(quasiquote ,f))",
        "(let ((f 'x)) (dotimes (i 300000) (setf f (list 'pp-tut::an 'action (list :type f)))) f)",
    ] {
        let mut session = session();
        let text = format!("(handler-case (eval {endless}) (condition () :ended)) (+ 1 1)");
        let (outcome, shown) = told(&mut session, &text);
        assert_eq!(outcome, Outcome::Finished, "{endless}: {shown}");
        assert!(shown.ends_with("[\"2\"]\n"), "{endless}: {shown}");
    }
}

/// Forms without parts; `N` stands for a small number.
const LEAVES: &[&str] = &[
    "N",
    "-N",
    "x",
    "'sym",
    "\"text\"",
    "N.5",
    "N/3",
    "#\\a",
    "nil",
    "t",
    ":key",
    "y",
    "'(1 N)",
    "(vector 1 N)",
    "#'car",
    "(make-hash-table)",
    "(error \"no N\")",
    "(signal 'warning)",
    "(return-from b N)",
    "(throw 'c N)",
    "(go again)",
    "(random 5)",
    "(values N x)",
];

/// Forms with parts: `A` and `B` stand for other forms.
const BRANCHES: &[&str] = &[
    "(+ A B)",
    "(list A B)",
    "(cons A B)",
    "(car A)",
    "(funcall A B)",
    "(apply #'list A B)",
    "(mapcar (lambda (x) A) B)",
    "(let ((x A)) B)",
    "(let* ((x A) (y x)) B)",
    "(setq x A)",
    "(if A B x)",
    "(progn A B)",
    "(block b A B)",
    "(catch 'c A B)",
    "(unwind-protect A B)",
    "(handler-case A (error (x) B))",
    "(ignore-errors A B)",
    "(handler-bind ((error (lambda (x) B))) A)",
    "(multiple-value-list (values A B))",
    "(restart-case A (use-value (x) B))",
    "(with-simple-restart (skip \"s\") A B)",
    "(dotimes (i 3 x) A)",
    "(loop for x in A collect B)",
    "(format nil \"~a ~s\" A B)",
    "(flet ((f (x) A)) (f B))",
    "(labels ((f (x) (if (eql x 0) A 0))) (f B))",
    "(macrolet ((m (z) `(list ,z))) (m A))",
    "(symbol-macrolet ((y A)) B)",
    "(sort A #'<)",
    "(reduce #'+ A :initial-value B)",
    "(nth A B)",
    "(coerce A 'list)",
    "(elt A B)",
    "(let ((n 0)) (tagbody again (when (< (incf n) 3) A B)))",
    "(eval 'A)",
    "(destructuring-bind (x &optional y) A B)",
    "(typep A 'B)",
    "(setf (car A) B)",
    "(concatenate 'list A B)",
    "(subseq A N)",
    "(equal A B)",
    "`(1 ,A ,@B)",
    "(cpl:top-level (cpl:par A B))",
    "(cpl:with-failure-handling ((error (x) B)) A)",
];

fn program() -> BoxedStrategy<String> {
    let leaf = (0..LEAVES.len(), 0..4_u8)
        .prop_map(|(i, n): (usize, u8)| LEAVES[i].replace('N', &n.to_string()))
        .boxed();
    leaf.prop_recursive(6, 60, 2, |inner| {
        (0..BRANCHES.len(), 0..4_u8, inner.clone(), inner)
            .prop_map(|(i, n, a, b): (usize, u8, String, String)| {
                let form = BRANCHES[i].replace('N', &n.to_string());
                // Parts are put in by mark, since they may hold these letters themselves.
                let form = form.replace("A", "\u{1}").replace("B", "\u{2}");
                form.replace('\u{1}', &a).replace('\u{2}', &b)
            })
            .boxed()
    })
    .boxed()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 30, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_programs_never_panic_and_do_the_same_twice(forms in proptest::collection::vec(program(), 4)) {
        let texts: Vec<String> = forms.iter().map(|form| {
            format!("(let ((x '(3 1 2)) (y 2)) (catch 'c (block b (tagbody (return-from b {form}) again))))")
        }).collect();
        // To open a session takes longer than to run most programs.
        let run = || {
            let mut session = session();
            let shown: String = texts.iter().map(|text| told(&mut session, text).1).collect();
            prop_assert!(!shown.contains("panic"), "{}", shown);
            Ok(shown)
        };
        let first = run()?;
        prop_assert_eq!(&first, &run()?, "{:?}", texts);
    }
}
