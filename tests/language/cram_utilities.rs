//! Lazy lists, patterns, unification and functors, as CRAM's own tests expect them.

use super::checked::check;
use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

#[test]
fn lists_compute_no_more_than_is_asked_for() {
    check(&[
        (
            "(let* ((n 0) (l (cut:lazy-list ((i 0)) (when (< i 3) (incf n) (cut:cont i (1+ i))))))
               (list (cut:lazy-car l) n (cut:lazy-car (cut:lazy-cdr l)) n (cut:force-ll l) n l))",
            "(0 1 1 2 (0 1 2) 3 (0 1 2))",
        ),
        (
            "(let* ((n 0) (l (cut:lazy-take 3 (cut:lazy-list () (incf n) (cut:cont :x)))))
               (list n (progn (cut:lazy-cdr l) n) (cut:force-ll l) n))",
            "(1 2 (:X :X :X) 3)",
        ),
        (
            "(let* ((n 0) (l (cut:lazy-filter (lambda (x) (incf n) (evenp x)) '(1 2 3 4))))
               (list n (cut:lazy-list-p l) (cut:force-ll l) n))",
            "(2 T (2 4) 4)",
        ),
        (
            "(cut:force-ll (cut:lazy-list ((i 0)) (cond ((> i 6) (cut:finish i)) ((oddp i) (cut:next (1+ i))) (t (cut:cont i (1+ i))))))",
            "(0 2 4 6 7)",
        ),
        (
            "(length (cut:force-ll (cut:lazy-filter #'evenp (cut:lazy-mapcar #'1+ (loop for i below 20000 collect i)))))",
            "10000",
        ),
        (
            "(let ((l (cut:lazy-mapcan #'identity '((1) 2)))) (handler-case (cut:lazy-cdr l) (simple-error () :no-list)))",
            ":NO-LIST",
        ),
    ]);
}

#[test]
fn patterns_match_and_terms_unify() {
    check(&[
        (
            "(cut:bindings-equal (cut:pat-match '(foo !?x foo !?y !?z bar) '(foo foo bar bar foo bar)) '((?x) (?y) (?z bar bar foo)))",
            "T",
        ),
        (
            "(multiple-value-list (cut:pat-match '(!?x d) '(a b c)))",
            "(NIL NIL)",
        ),
        (
            "(handler-case (cut:pat-match '(a . !?x) '(a . b)) (simple-error () :wrong))",
            ":WRONG",
        ),
        (
            "(handler-case (cut:pat-match '(a ?x) '(a ?y)) (simple-error () :wrong))",
            ":WRONG",
        ),
        (
            "(prolog:unify '(?x ?y c) '(a ?x c))",
            "((?Y . A) (?X . A)) ; T",
        ),
        (
            "(prolog:unify '(?x ?y ?x) '((?y) a (a)))",
            "((?Y . A) (?X ?Y)) ; T",
        ),
        (
            "(multiple-value-list (prolog:unify '(a !?x) '(a b . c)))",
            "(NIL NIL)",
        ),
        (
            "(handler-case (prolog:unify 'bar '!?foo) (simple-error () :wrong))",
            ":WRONG",
        ),
    ]);
}

#[test]
fn functors_compare_and_forget() {
    check(&[
        (
            "(prolog:prolog '(and (member ?x (1 2 3)) (> ?x 1) (<= ?x 2)))",
            "(((?X . 2)))",
        ),
        ("(prolog:prolog '(< ?x 2))", "NIL"),
        (
            "(prolog:prolog '(filter-bindings (?a ?b) (== (?a ?b ?c) (1 2 3))))",
            "(((?B . 2) (?A . 1)))",
        ),
        ("(prolog:prolog '(filter-bindings () (fail)))", "NIL"),
        (
            "(prolog:prolog '(or (member ?x (1 2)) (and (member ?y (1 2)) (cut)) (== ?x 3)))",
            "(((?X . 1)) ((?X . 2)) ((?Y . 1)))",
        ),
        (
            "(progn (defclass dummy () ((a :initform :a))) (mapcar (lambda (b) (cut:var-value '?t b)) (prolog:prolog '(and (instance-of dummy ?o) (instance-of ?t ?o)))))",
            "(DUMMY)",
        ),
        (
            "(progn (prolog:def-fact-group pairs (linked) (prolog:<- (linked a b)) (prolog:<- (linked a . ?rest) (fail))) (prolog:prolog '(linked ?x ?y)))",
            "(((?Y . B) (?X . A)))",
        ),
    ]);
}

#[test]
fn proofs_are_found_when_they_are_asked_for() {
    check(&[
        (
            "(prolog:def-fact-group counting (counted) (prolog:<- (counted 0)) (prolog:<- (counted ?n) (counted ?m) (lisp-fun 1+ ?m ?n)))",
            "COUNTING",
        ),
        (
            "(let ((proofs (prolog:prolog '(counted ?n)))) (mapcar (lambda (b) (cut:var-value '?n b)) (list (cut:lazy-car proofs) (cut:lazy-car (cut:lazy-cdr proofs)) (cut:lazy-elt proofs 10))))",
            "(0 1 10)",
        ),
        (
            "(cut:force-ll (prolog:prolog '(counted ?n)) 2)",
            "(((?N . 0)) ((?N . 1)))",
        ),
        (
            "(let ((calls '())) (defun noted (x) (push x calls) x) (let ((proofs (prolog:prove-all '(and (member ?x (1 2 3)) (lisp-fun noted ?x ?_))))) (list (reverse calls) (progn (cut:lazy-cdr proofs) (reverse calls)) (length (cut:force-ll proofs)) (reverse calls))))",
            "((1) (1 2) 3 (1 2 3))",
        ),
        // What calls no functions is an ordinary list.
        (
            "(length (prolog:prolog '(and (member ?x (1 2 3)) (member ?y (1 2)))))",
            "6",
        ),
        // A copy of the bindings is no part of the search.
        (
            "(let ((proofs (prolog:prolog '(counted ?n)))) (list (cut:lazy-elt proofs 2) (cut:lazy-elt proofs 1) (cut:lazy-elt proofs 3)))",
            "(((?N . 2)) ((?N . 1)) ((?N . 3)))",
        ),
        (
            "(progn (defun not-two (x) (if (= x 2) (error \"two\") x)) (defvar *proofs* (prolog:prolog '(and (member ?x (1 2)) (lisp-fun not-two ?x ?y)))) (list (cut:lazy-car *proofs*) (handler-case (cut:lazy-cdr *proofs*) (error (e) (princ-to-string e)))))",
            "(((?Y . 1) (?X . 1)) \"two\")",
        ),
        (
            "(cut:lazy-cdr *proofs*)",
            "!! The next proof of this query is being searched for, or an error ended that: the list of proofs cannot be continued; make the query again.",
        ),
    ]);
}

#[test]
fn proofs_start_from_bindings_that_are_known() {
    check(&[
        (
            "(prolog:prove-all '(member ?x (1 2)) '((?x . 2)))",
            "(((?X . 2)))",
        ),
        ("(prolog:prove-one '(member ?x (1 2)) '((?x . 3)))", "NIL"),
        (
            "(prolog:prolog '(member ?x (1 2)) '((?y . ?x) (?x . 1)))",
            "(((?Y . 1) (?X . 1)))",
        ),
        ("(prolog:prolog '(and) '((?x . 1) (?x . 2)))", "NIL"),
        (
            "(prolog:prolog '(and) 5)",
            "!! The value 5 is not of type LIST",
        ),
    ]);
}

#[test]
fn rules_that_prove_themselves_end_with_an_error() {
    check(&[(
        "(progn (prolog:def-fact-group circular (round-p) (prolog:<- (round-p ?x) (round-p ?x) (and))) (prolog:prolog '(round-p 1)))",
        "!! A Prolog goal needs more and more goals to be proved: does a rule prove itself?",
    )]);
}

#[test]
fn goals_that_are_written_wrong_are_told_once() {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let form = "(prolog:def-fact-group pairs (linked) (prolog:<- (linked a b)) (prolog:<- (linked a . ?rest) (fail)))
        (prolog:prolog '(and (member ?y (1 2)) (or (member ?x) (member ?z) (membr 1 2) (linked))))";
    let mut said = String::new();
    session.evaluate("test", form, &mut |event| {
        if let Event::Output(text) = event {
            said.push_str(&text);
        }
    });
    assert_eq!(
        said,
        "WARNING: The Prolog goal MEMBER does not take 1 argument; it is written (MEMBER item LIST).\n\
         WARNING: Trying to prove goal (MEMBR 1 2) with undefined functor MEMBR. Did you mean MEMBER?\n\
         WARNING: The Prolog goal LINKED does not take 0 arguments; it is written (LINKED A B) or (LINKED A . ?REST).\n"
    );
}

/// What forms print in a session.
fn said(forms: &str) -> String {
    let mut session = Session::new(&SessionOptions::default()).unwrap();
    let mut said = String::new();
    session.evaluate("test", forms, &mut |event| match event {
        Event::Output(text) => said.push_str(&text),
        Event::Aborted(abort) => said.push_str(&format!("!! {}\n", abort.report)),
        _ => {}
    });
    said
}

const FAMILY: &str = "(prolog:def-fact-group family (parent older)
  (prolog:<- (parent ann bob)) (prolog:<- (parent bob cid)) (prolog:<- (parent bob dan))
  (prolog:<- (older ?a ?b) (parent ?a ?b))
  (prolog:<- (older ?a ?c) (parent ?a ?b) (older ?b ?c))
  (prolog:<- (first-child ?a ?b) (parent ?a ?b) (prolog:cut)))";

#[test]
fn traced_goals_show_their_four_ports_with_bindings() {
    let text = said(&format!(
        "{FAMILY} (prolog:trace-prolog 'parent 'older) (prolog:prolog '(older ann dan))"
    ));
    assert_eq!(
        text,
        "  0: call (OLDER ANN DAN)\n\
         \x20   1: call (PARENT ANN DAN)\n\
         \x20   1: fail (PARENT ANN DAN)\n\
         \x20   1: call (PARENT ANN ?B)\n\
         \x20   1: exit (PARENT ANN BOB)\n\
         \x20   1: call (OLDER BOB DAN)\n\
         \x20     2: call (PARENT BOB DAN)\n\
         \x20     2: exit (PARENT BOB DAN)\n\
         \x20   1: exit (OLDER BOB DAN)\n\
         \x20 0: exit (OLDER ANN DAN)\n\
         \x20 0: redo (OLDER ANN DAN)\n\
         \x20   1: redo (OLDER BOB DAN)\n\
         \x20     2: call (PARENT BOB ?B)\n\
         \x20     2: exit (PARENT BOB CID)\n\
         \x20     2: call (OLDER CID DAN)\n\
         \x20       3: call (PARENT CID DAN)\n\
         \x20       3: fail (PARENT CID DAN)\n\
         \x20       3: call (PARENT CID ?B)\n\
         \x20       3: fail (PARENT CID ?B)\n\
         \x20     2: fail (OLDER CID DAN)\n\
         \x20     2: redo (PARENT BOB CID)\n\
         \x20     2: exit (PARENT BOB DAN)\n\
         \x20     2: call (OLDER DAN DAN)\n\
         \x20       3: call (PARENT DAN DAN)\n\
         \x20       3: fail (PARENT DAN DAN)\n\
         \x20       3: call (PARENT DAN ?B)\n\
         \x20       3: fail (PARENT DAN ?B)\n\
         \x20     2: fail (OLDER DAN DAN)\n\
         \x20   1: fail (OLDER BOB DAN)\n\
         \x20   1: redo (PARENT ANN BOB)\n\
         \x20   1: fail (PARENT ANN ?B)\n\
         \x20 0: fail (OLDER ANN DAN)\n"
    );
}

#[test]
fn a_trace_changes_no_proof() {
    let queries = [
        "(older ?a ?b)",
        "(and (older ?a ?b) (not (older ?b ?a)))",
        "(first-child bob ?x)",
        "(and (parent ?a ?x) (once (older ?x ?y)))",
        "(-> (parent ?a dan) (older ?b ?a) (true))",
        "(*-> (parent ?a ?x) (older ?x ?y))",
        "(findall ?x (older ann ?x) ?all)",
        "(setof ?a (older ?a ?x) ?all)",
        "(forall (parent ?a ?b) (older ?a ?b))",
        "(or (first-child ann ?x) (first-child bob ?x))",
        "(and (member ?x (1 2 3)) (lisp-pred oddp ?x))",
        "(lisp-fun + 1 2 ?x)",
        "(and (parent ?a ?b) (lisp-fun list ?a ?b ?c))",
    ];
    for query in queries {
        let ask = format!("(print (cut:force-ll (prolog:prolog '{query})))");
        let plain = said(&format!("{FAMILY} {ask}"));
        for traced in [
            "t",
            "'parent 'older",
            "'and 'or 'not '-> '*-> 'once 'member 'findall",
        ] {
            let text = said(&format!(
                "{FAMILY} (prolog:trace-prolog {traced}) (setf *trace-output* (make-broadcast-stream)) {ask}"
            ));
            assert_eq!(text, plain, "{query} with {traced} traced");
        }
    }
}

#[test]
fn a_trace_is_as_lazy_as_what_it_shows() {
    let text = said(
        "(prolog:trace-prolog 'member)
         (defparameter *all* (prolog:prolog '(and (member ?x (1 2 3)) (lisp-pred identity ?x))))
         (format t \"one~%\") (cut:lazy-cdr *all*)",
    );
    assert_eq!(
        text,
        "  0: call (MEMBER ?X (1 2 3))\n  0: exit (MEMBER 1 (1 2 3))\n\
         \x20 0: redo (MEMBER 1 (1 2 3))\n  0: exit (MEMBER 2 (1 2 3))\none\n\
         \x20 0: redo (MEMBER 2 (1 2 3))\n  0: exit (MEMBER 3 (1 2 3))\n"
    );
}

#[test]
fn a_trace_without_end_ends() {
    let text = said(
        "(prolog:def-fact-group endless () (prolog:<- (going ?x) (going ?x) (and)))
         (prolog:trace-prolog 'going) (prolog:prolog '(going 0))",
    );
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 1002, "{}", lines.last().unwrap());
    assert_eq!(
        lines[1000],
        "  … the trace of this query ends after 1000 lines"
    );
    assert!(
        lines[1001].starts_with("!! A Prolog goal"),
        "{}",
        lines[1001]
    );
    let long = said(
        "(prolog:trace-prolog '==) (prolog:prolog `(== ?x ,(make-list 500 :initial-element \"two
lines\")))",
    );
    assert!(
        long.lines().all(|line| line.chars().count() < 220),
        "{long}"
    );
    assert_eq!(long.lines().count(), 2);
}

#[test]
fn what_is_traced_is_told_and_can_be_ended() {
    assert_eq!(
        said(
            "(print (list (prolog:trace-prolog 'member 'append) (prolog:trace-prolog 'member) (prolog:untrace-prolog 'append)
                (prolog:trace-prolog) (prolog:trace-prolog t) (prolog:untrace-prolog) (prolog:trace-prolog)))
             (prolog:prolog '(member ?x (1)))
             (prolog:trace-prolog 'membr)"
        ),
        "\n((:MEMBER :APPEND) (:MEMBER :APPEND) (:MEMBER) (:MEMBER) T NIL NIL) \
         !! There are no Prolog goals (membr …); did you mean MEMBER?\n"
    );
}
