//! Wrong inputs and their diagnostics.

mod goals;
mod many_mistakes;
mod no_false_alarms;
mod typical_mistakes;
mod warnings;

use std::fs;
use std::path::Path;

use crate::dialogue::Evaluate;
use crate::{Session, SessionOptions};

thread_local! {
    /// The session that those for texts are copies of.
    static FRESH: Session = Session::new(&SessionOptions::default()).unwrap();
}

/// A fresh session.
fn fresh() -> Session {
    FRESH.with(|session| session.copied().unwrap())
}

/// What is found in a text by a fresh session.
fn found(name: &str, text: &str) -> Vec<String> {
    found_in(&mut fresh(), name, text)
}

fn found_in(session: &mut Session, name: &str, text: &str) -> Vec<String> {
    session
        .check(name, text)
        .into_iter()
        .map(|f| match f.place {
            Some(p) => format!("{}:{}: {}", p.line, p.column, f.message),
            None => f.message,
        })
        .collect()
}

#[test]
fn mistakes_are_told_with_their_places() {
    let mut wrong = Vec::new();
    for (text, expected) in TABLE {
        let found = found("a.plan", text).join("\n");
        if found != *expected {
            wrong.push(format!("{text}\n  expected {expected}\n  found    {found}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_plans_that_come_with_the_program_have_no_mistakes() {
    for folder in ["plans/lib", "plans/tutorial"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../..")
            .join(folder);
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let name = path.display().to_string();
            // The library defines what is locked afterwards.
            let mut found = found(&name, &text);
            found.retain(|finding| !finding.contains("belongs to the locked package"));
            assert_eq!(found, [""; 0], "{name}");
        }
    }
}

const TABLE: &[(&str, &str)] = &[
    ("(print b)", "1:8: The variable B is unbound."),
    (
        "(in-package :pp-tut) (let ((?p 1)) (a motion (type goiing) (pose ?p)))",
        "1:52: There is no motion of type GOIING; did you mean GOING?",
    ),
    (
        "(in-package :pp-tut) (let ((?p 1)) (an action (type goin) (target (a location (pose ?p)))))",
        "1:53: There is no action of type GOIN; did you mean GOING?",
    ),
    (
        "(in-package :pp-tut) (let ((?o 1)) (an action (type picking-up) (arm left) (objct ?o)))",
        "1:77: The action PICKING-UP has no key OBJCT; did you mean OBJECT?",
    ),
    (
        "(in-package :pp-tut) (defun f (?bottle) (an action (type picking-up) (object ?botle) (arm left)) ?bottle)",
        "1:78: The variable ?BOTLE is unbound; did you mean ?BOTTLE?",
    ),
    (
        "(defun f (x y) (list x y)) (f 1)",
        "1:28: F takes 2 arguments, but is called with 1.",
    ),
    (
        "(car 1 2)",
        "1:1: CAR takes 1 argument, but is called with 2.",
    ),
    (
        "(frobnicate 1)",
        "1:2: The function FROBNICATE is not defined.",
    ),
    (
        "(lenght (list 1))",
        "1:2: The function LENGHT is not defined; did you mean LENGTH?",
    ),
    (
        "(mapcar #'evnp (list 1 2))",
        "1:11: The function EVNP is not defined; did you mean EVENP?",
    ),
    (
        "(g 1) (defun g (&optional a b) (list a b)) (g 1 2 3)",
        "1:44: G takes at most 2 arguments, but is called with 3.",
    ),
    ("(nopackage:foo)", "1:2: Package NOPACKAGE does not exist."),
    (
        "(pp-tut:nosuch)",
        "1:2: Symbol \"NOSUCH\" not found in the CRAM-PICK-PLACE-TUTORIAL package.",
    ),
    (
        "(defvar *speed* 1) (print *sped*)",
        "1:27: The variable *SPED* is unbound; did you mean *SPEED*?",
    ),
    (
        "(defmacro twice (x) `(progn ,x ,x)) (twice (nosuch 1))",
        "1:45: The function NOSUCH is not defined.",
    ),
    (
        "(list 1",
        "1:1: end of file in a list that starts on line 1",
    ),
    (
        "(defun one () 1) (one 1 2)",
        "1:18: ONE takes no arguments, but is called with 2.",
    ),
    // Names defined in other ways, or later, are known.
    (
        "(defclass a () ((x :accessor a-x))) (defun h (o) (a-x o) (helper)) \
         (setf *q* 1) (print *q*) (let ((y 1)) (declare (special y)) y) \
         (labels ((k (n) n)) (k 1)) (defmacro d (n) `(defun ,n () 1)) (d helper)",
        "",
    ),
    (
        "(in-package :pp-tut) (def-fact-group mine (desig:action-grounding) \
         (<- (desig:action-grounding ?d (dance ?d)) (desig:desig-prop ?d (:type :dancing)))) \
         (defun dance (d) d) (an action (type dancing) (speed 1))",
        "",
    ),
    ("(load \"other.plan\") (from-there from-there)", ""),
    // Actions that the text defines are known, above their definitions and below.
    (
        "(in-package :pp-tut) (an action (type waving) (arm left)) \
         (def-action waving ((arm (member left right)) &optional (times number)) (list ?arm ?times)) \
         (an action (type waving) (arm left) (times 2))",
        "",
    ),
    (
        "(in-package :pp-tut) (def-action waving ((arm keywords \"which\")) (list ?arm)) \
         (an action (type waving) (amr left)) (an action (type wavng) (arm left)) \
         (an action (type waving))",
        "1:105: The action WAVING has no key AMR; did you mean ARM?\n\
         1:133: There is no action of type WAVNG; did you mean WAVING?\n\
         1:156: The action WAVING needs (arm …): which.",
    ),
    (
        "(in-package :pp-tut) (def-action waving ((arm side)) ?arm)",
        "1:42: In the key (ARM SIDE): SIDE is not a kind; there are LOCATION, PLACE, OBJECT, \
         DETECTED-OBJECT, OBJECTS, NUMBER, KEYWORDS, KEYWORD, SYMBOL, STRING, LIST, POSES, POSE, \
         KEYWORD-OR-OBJECT, ACTION, T, and (MEMBER …).",
    ),
];
