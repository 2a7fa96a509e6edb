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
        "WARNING: The Prolog goal MEMBER does not take 1 argument; it is written (MEMBER item list).\n\
         WARNING: Trying to prove goal (MEMBR 1 2) with undefined functor MEMBR. Did you mean MEMBER?\n\
         WARNING: The Prolog goal LINKED does not take 0 arguments; it is written (LINKED A B) or (LINKED A . ?REST).\n"
    );
}
