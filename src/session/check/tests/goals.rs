//! Prolog goals: mistakes in them, and what is right though it may not look so.

use super::found;

fn check(cases: &[(&str, &[&str])]) {
    let mut wrong = Vec::new();
    for (text, expected) in cases {
        let found = found("a.plan", &format!("(in-package :btr)\n{text}"));
        if found != *expected {
            wrong.push(format!(
                "{text}\n  expected {expected:#?}\n  found    {found:#?}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn functors_that_there_are_not_are_found_with_what_may_be_meant() {
    check(&[
        (
            "(defun f () (prolog:prolog '(and (bullet-world ?w) (visibel ?w ?r ?o))))",
            &["2:53: There is no Prolog functor VISIBEL; did you mean VISIBLE?"],
        ),
        (
            "(defun f (?r) (cut:force-ll (prolog:prolog `(or (visible ?w ,?r ?o) (not (xyzzy ?o))))))",
            &["2:75: There is no Prolog functor XYZZY."],
        ),
        (
            "(defun f () (prolog-?w '(suported-by ?w ?top ?bottom)))",
            &["2:26: There is no Prolog functor SUPORTED-BY; did you mean SUPPORTED-BY?"],
        ),
        (
            "(defun f () (coe:holds '(cpoe::object-in-hnd ?o :left)))",
            &["2:26: There is no Prolog functor OBJECT-IN-HND; did you mean OBJECT-IN-HAND?"],
        ),
        (
            "(defun f () (pw:ask '(and (fact run :run ?run) (findall ?x (fct draw :run ?run :value ?x) ?xs))))",
            &["2:61: There is no Prolog functor FCT; did you mean FACT?"],
        ),
        (
            "(prolog:def-fact-group tidiness (tidy)\n  (prolog:<- (tidy ?w ?x)\n    (item-typ ?w ?x :cup)))",
            &["4:6: There is no Prolog functor ITEM-TYP; did you mean ITEM-TYPE?"],
        ),
        (
            "(defun f () (prolog:prolog '(prolog:lisp-pred oddp 1)) (prolog:prolog (list 'lips-fun '+ 1 '?x)))",
            &["2:78: There is no Prolog functor LIPS-FUN; did you mean LISP-FUN?"],
        ),
    ]);
}

#[test]
fn goals_of_actions_are_looked_at() {
    let moving = |goal: &str| {
        format!(
            "(defun f (?object)\n  (perform (an action (type picking-up) (object ?object)\n                      (goal {goal}))))"
        )
    };
    let cases = [
        ("(cpoe:object-in-hand ?object :left)", None),
        ("(object-in-hand ?object :left)", None),
        ("(and (torso-at 0.2) (not (gripper-closed :left)))", None),
        ("?object", None),
        (
            "(cpoe::object-in-hnd ?object :left)",
            Some("4:30: There is no Prolog functor OBJECT-IN-HND; did you mean OBJECT-IN-HAND?"),
        ),
        ("(cpoe:torso-at)", Some("TORSO-AT")),
    ];
    for (goal, expected) in cases {
        let found = found("a.plan", &format!("(in-package :pp-tut)\n{}", moving(goal)));
        match expected {
            None => assert_eq!(found, Vec::<String>::new(), "{goal}"),
            Some(part) => assert!(
                found.len() == 1 && found[0].contains(part),
                "{goal}: {found:#?}"
            ),
        }
    }
}

#[test]
fn wrong_numbers_of_arguments_are_found() {
    check(&[
        (
            "(defun f () (prolog-?w '(item-type ?w ?x)))",
            &[
                "2:26: The Prolog goal ITEM-TYPE does not take 2 arguments; it is written (ITEM-TYPE ?W ?NAME ?TYPE).",
            ],
        ),
        (
            "(defun f () (prolog:prolog '(prolog:member ?x)))",
            &[
                "2:30: The Prolog goal MEMBER does not take 1 argument; it is written (MEMBER item LIST).",
            ],
        ),
        (
            "(defun f () (coe:holds '(cpoe:torso-at ?x 0.1 ?y)))",
            &[
                "2:26: The Prolog goal CRAM-PLAN-OCCASIONS-EVENTS:TORSO-AT does not take 3 arguments; it has 1 to 2.",
            ],
        ),
        (
            "(prolog:def-fact-group g () (prolog:<- (likes robot tea)) (prolog:<- (happy ?x) (likes ?x)))",
            &[
                "2:82: The Prolog goal LIKES does not take 1 argument; it is written (LIKES ROBOT TEA).",
            ],
        ),
    ]);
}

#[test]
fn variables_that_cannot_be_bound_yet_are_found_where_something_must_be_given() {
    check(&[
        (
            "(defun f () (prolog-?w '(near ?w ?a ?b ?distance)))",
            &[
                "2:40: The variable ?DISTANCE is not bound here: in the goal (NEAR …), argument 4 must be given.",
            ],
        ),
        (
            "(defun f () (coe:holds '(cpoe:location-accessible ?location)))",
            &[
                "2:51: The variable ?LOCATION is not bound here: in the goal (CRAM-PLAN-OCCASIONS-EVENTS:LOCATION-ACCESSIBLE …), argument 1 must be given.",
            ],
        ),
        (
            "(defun f () (pw:ask '(and (fact ?relation :run 1))))",
            &[
                "2:33: The variable ?RELATION is not bound here: in the goal (CRAM-OCCASIONS-EVENTS::FACT …), argument 1 must be given.",
            ],
        ),
        (
            "(defun f () (prolog:prolog '(and (prolog:not (prolog:== ?x 1)) (< ?x 2))))",
            &[
                "2:67: The variable ?X is not bound here: in the goal (< …), argument 1 must be given.",
            ],
        ),
        (
            "(prolog:def-fact-group g () (prolog:<- (close ?w ?a) (near ?w ?a ?b ?d) (prolog:== ?d 1)))",
            &[
                "2:69: The variable ?D is not bound here: in the goal (NEAR …), argument 4 must be given.",
            ],
        ),
    ]);
}

#[test]
fn what_may_be_bound_or_defined_elsewhere_is_left_alone() {
    let right = [
        // An earlier goal, whoever asks, or bindings that are known already.
        "(defun f () (prolog-?w '(prolog:member ?d (0.1 0.2)) '(near ?w ?a ?b ?d)))",
        "(prolog:def-fact-group g () (prolog:<- (close ?w ?a ?b ?d) (near ?w ?a ?b ?d)))",
        "(defun f (d) (prolog:prolog '(near ?w ?a ?b ?d) `((?d . ,d))))",
        "(defun f () (prolog:prolog '(and (or (prolog:== ?x 1) (prolog:== ?y 1)) (< ?x 2))))",
        // What is computed may be anything, and bind anything.
        "(defun f (goal) (prolog:prolog goal) (prolog:prolog `(and ,goal (< ?x 2))) (prolog:prolog `(near ?w ?a ?b ,goal)))",
        "(defun f (goals) (prolog:prolog `(and ,@goals (< ?x 2))) (prolog:prolog (cons 'and goals)))",
        "(defun f (args) (prolog:prolog `(near ,@args)) (prolog:prolog `(near . ,args)) (prolog:prolog (list* 'near args)))",
        "(defun f (functor) (prolog:prolog `(,functor 1 2)) (prolog:prolog '(?functor 1)) (prolog:prolog '(and ?goal (< ?x 1))))",
        // Functors of the text itself, wherever it defines them, and of any package.
        "(defun f () (prolog:prolog '(mine 1))) (prolog:def-fact-group g () (prolog:<- (mine 1)))",
        "(defun f () (prolog:prolog '(mine 1)) (eval '(prolog:def-fact-group g () (prolog:<- (mine 1)))))",
        "(defun f () (prolog:prolog '(mine 1 2 3))) (prolog:def-prolog-handler mine (bindings &rest all) (declare (ignore bindings)) all)",
        "(defmacro def-mine (name) `(prolog:def-fact-group ,name () (prolog:<- (,name 1)))) (def-mine yours) (defun f () (prolog:prolog '(yours 1)))",
        "(load \"others.plan\") (defun f () (prolog:prolog '(theirs 1)))",
        "(defun f () (prolog:prolog '(cl-user::contact ?w ?a ?b)))",
        // Goals inside of others, and quoted terms that are no goals.
        "(defun f () (prolog-?w '(with-copied-world ?w (assert (object-pose ?w bottle-1 ((0 0 1) (0 0 0 1)))) (simulate ?w 2))))",
        "(defun f () (prolog:prolog '(coe:holds (cpoe:object-in-hand ?o ?hand) (throughout ?from ?to))))",
        "(defun f () (prolog:prolog '(prolog:forall (item ?w ?x) (prolog:-> (stable ?w ?x) (prolog:true) (prolog:fail)))))",
        "(defun f () (prolog:prolog '(prolog:lisp-fun list (nonsense) ?x)) (list '(nonsense 1)))",
        "(defpackage :mine (:use :common-lisp)) (in-package :mine) (defun prolog (goal) goal) (defun f () (prolog '(nonsense ?x)))",
    ];
    let cases: Vec<(&str, &[&str])> = right.iter().map(|text| (*text, &[][..])).collect();
    check(&cases);
}

#[test]
fn goals_of_any_shape_are_looked_at_without_harm() {
    let deep = format!("{}(xyzzy){}", "(not ".repeat(5000), ")".repeat(5000));
    for goal in [
        "()",
        "nil",
        "5",
        "\"text\"",
        "?x",
        "(1 2)",
        "((a) b)",
        "(and . b)",
        "(and a . ?rest)",
        "(or)",
        "(prolog:->)",
        "(holds)",
        "(prolog:findall)",
        "(#(1) 2)",
        &deep,
    ] {
        let text = format!("(in-package :btr) (defun f () (prolog:prolog '{goal}))");
        found("a.plan", &text);
    }
}
