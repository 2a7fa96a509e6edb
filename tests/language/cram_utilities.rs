//! Lazy lists, patterns, unification and functors, as CRAM's own tests expect them.

use super::standard::check;

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
            "(prolog:prolog '(member ?x))",
            "!! The Prolog goal MEMBER does not take 1 argument; it is written (MEMBER item list).",
        ),
    ]);
}
