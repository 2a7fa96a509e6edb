//! Tests of designators: each evaluates a text and compares what is printed.

mod actions;
mod resolution;

use super::MotionRequest;
use super::schema::{self, Key, Kind, Text, TypeRow};
use super::value::Class;
use lisp::image::Image;
use lisp::print;
use lisp::reader::{Outcome, Reader};
use lisp::value::Value;
use lisp::value::symbol::known;
use lisp::vm::fiber::Fiber;
use lisp::vm::machine::{Event, Machine};

/// An image in which designators need no package prefix and a plan seems to be running.
pub fn image() -> Image {
    let mut image = Image::new();
    crate::install(&mut image);
    crate::designator::install(&mut image);
    crate::pose::install(&mut image);
    let prelude = "(defpackage :d (:use :common-lisp :desig :exe :prolog :cut))
                   (in-package :d)";
    let task =
        crate::packages::symbol(&mut image, "CRAM-LANGUAGE-IMPLEMENTATION", "*CURRENT-TASK*");
    image.define_special(task, Value::T);
    evaluate_in(&mut image, prelude);
    evaluate_in(&mut image, ACTIONS);
    for (name, keys) in MOTIONS {
        schema::define(&image, motion(name, keys));
    }
    image
}

/// Some types of actions; their plans are not defined.
const ACTIONS: &str = "
    (def-action going ((target place \"where to\" :aliases (location pose))) (:plan go))
    (def-action moving-torso ((joint-angle number)) (:plan move-torso))
    (def-action looking (&optional (target place) (direction keywords))
      (:one-of target direction) (:plan look))
    (def-action gripping ((gripper keywords \"\" :aliases (arm)) &optional (effort number))
      (:plan grip))
    (def-action picking-up ((object detected-object)) (:plan pick-up))";

/// Some types of motions, each with a required key.
const MOTIONS: &[(&str, Key)] = &[
    ("GOING", key("TARGET", Kind::Place, "where to")),
    (
        "MOVING-TORSO",
        key("JOINT-ANGLE", Kind::Number, "the height"),
    ),
    ("OPENING", key("GRIPPER", Kind::Keywords, "which hand")),
];

const fn key(name: &'static str, kind: Kind, doc: &'static str) -> Key {
    Key {
        name: Text::Borrowed(name),
        aliases: Vec::new(),
        kind,
        is_required: true,
        doc: Text::Borrowed(doc),
    }
}

fn motion(name: &'static str, key: &Key) -> TypeRow {
    let mut key = key.clone();
    if name == "GOING" {
        key.aliases = vec![Text::Borrowed("POSE")];
    }
    TypeRow {
        class: Class::Motion,
        name: Text::Borrowed(name),
        variant: None,
        aliases: Vec::new(),
        plan: known::NIL,
        keys: vec![key],
        one_of: Vec::new(),
        is_known_by_keys: false,
        doc: Text::Borrowed(""),
        example: None,
    }
}

/// The printed values of the last form; `!!` and the report of a condition; `??` and the requested
/// motion.
pub fn evaluate_in(image: &mut Image, text: &str) -> String {
    let source = image.sources.add("test", text);
    let mut reader = Reader::new(image, source);
    let mut result = String::new();
    loop {
        match reader.next(image) {
            Ok(Outcome::Form(form, _)) => result = evaluate_form(image, form),
            Ok(_) => return result,
            Err(error) => panic!("{error}"),
        }
        if result.starts_with("!!") || result.starts_with("??") {
            return result;
        }
    }
}

fn evaluate_form(image: &mut Image, form: Value) -> String {
    let mut fiber = Fiber::default();
    let mut machine = Machine::new(image, &mut fiber);
    let value = match machine.start(known::EVAL.into(), vec![form]) {
        Event::Done(value) => value,
        Event::Unhandled(condition) => {
            machine.unwind_all();
            return format!("!! {}", print::report::report(image, &condition));
        }
        Event::Request(request) => {
            machine.unwind_all();
            let Ok(request) = request.downcast::<MotionRequest>() else {
                return "?? not a motion".to_owned();
            };
            let properties: Vec<String> = request
                .properties
                .iter()
                .map(|(key, value)| format!("{key} {}", print::to_string(image, value, true)))
                .collect();
            return format!("?? {} {}", request.motion_type, properties.join(" "));
        }
        _ => return "stopped".to_owned(),
    };
    let shown: Vec<String> = value
        .into_values()
        .iter()
        .map(|v| print::to_string(image, v, true))
        .collect();
    shown.join(" ; ")
}

fn check(cases: &[(&str, &str)]) {
    for (text, expected) in cases {
        assert_eq!(evaluate_in(&mut image(), text), *expected, "{text}");
    }
}

#[test]
fn a_designator_prints_its_properties_line_by_line() {
    check(&[
        (
            "(let ((?arm :left)) (an action (type picking-up) (arm ?arm) (object (an object (type bottle)))))",
            "#<A ACTION\n    (TYPE PICKING-UP)\n    (ARM LEFT)\n    (OBJECT #<A OBJECT\n                (TYPE BOTTLE)>)>",
        ),
        (
            "(all objects (type bottle))",
            "#<ALL OBJECT\n    (TYPE BOTTLE)>",
        ),
        ("(an action (l (1 2 a)))", "#<A ACTION\n    (L (1 2 :A))>"),
        ("(a motion (x 1.5d0))", "#<A MOTION\n    (X 1.5d0)>"),
        ("(an action)", "#<A ACTION>"),
        ("(a motion (x \"s\"))", "#<A MOTION\n    (X \"s\")>"),
        (
            "(let ((desig:*designator-pprint-description* nil)) (prin1-to-string (an action (x 1))))",
            "\"#<>\"",
        ),
    ]);
}

#[test]
fn designators_in_lists_start_on_lines_of_their_own() {
    check(&[
        (
            "(list (an object (type a)) (an object (type b)) 3)",
            "(#<A OBJECT\n    (TYPE A)>\n #<A OBJECT\n    (TYPE B)>\n 3)",
        ),
        (
            "(list 1 2 (an object (type a)))",
            "(1 2 #<A OBJECT\n    (TYPE A)>)",
        ),
    ]);
}

#[test]
fn values_are_parsed_and_never_called() {
    check(&[
        (
            "(defparameter bottle :cup) (desig-prop-value (an object (type bottle)) :type)",
            ":CUP",
        ),
        (
            "(desig-prop-value (an object (x (list a 2))) :x)",
            "(:LIST :A 2)",
        ),
        ("(desig-prop-value (an object (x '(1))) :x)", "(:QUOTE (1))"),
        ("(desig-prop-value (an object (x nil)) :x)", "NIL"),
        ("(desig-prop-value (an object (x (1 . a))) :x)", "(1 . :A)"),
        (
            "(an object (x ?unknown))",
            "!! The variable ?UNKNOWN is unbound.",
        ),
        (
            "(desig-prop-value (desig-prop-value (an action (x (some object (type a)))) :x) :type)",
            ":A",
        ),
        (
            "(properties (let ((?a nil) (?b 2)) (an action (when ?a (x ?a)) (desig:when ?b (y ?b)))))",
            "((:Y 2))",
        ),
        (
            "(properties (an action (k 1 2) (\"s\" 3)))",
            "((:K 1 2) (\"s\" 3))",
        ),
    ]);
}

#[test]
fn malformed_designators_say_what_is_wrong() {
    check(&[
        ("(a foo (type x))", "!! Designator type `FOO' undefined"),
        (
            "(an action foo)",
            "!! FOO is not a property: a list (key value) was expected.",
        ),
        (
            "(let ((?property '(:type :bottle)) (?none nil)) (desig-prop-value (an object ?property ?none) :type))",
            ":BOTTLE",
        ),
        (
            "(let ((?property :type)) (an object ?property))",
            "!! :TYPE is not a property: a list (:key value) was expected.",
        ),
        (
            "(make-designator :object '(:a 1))",
            "!! :A is not a property: a list (:key value) was expected.",
        ),
        (
            "(let ((x (an object))) (equate x x))",
            "!! Cannot equate designators that are already equal.",
        ),
    ]);
    let shown = evaluate_in(&mut image(), "(a)");
    assert!(
        shown.starts_with("!! (A) is malformed: type is missing."),
        "{shown}"
    );
}

#[test]
fn equated_designators_form_a_chain() {
    check(&[
        (
            "(let* ((x (an object (type a))) (y (an object (type b))) (z (equate x y)))
               (list (eq z y) (eq (current-desig x) y) (eq (first-desig y) x) (desig-equal x y)
                     (eq (parent y) x) (eq (successor x) y) (parent x)))",
            "(T T T T T T NIL)",
        ),
        (
            "(let* ((x (an object)) (y (make-designator :object '((:type :b)) x)))
               (desig-prop-value (current-desig x) :type))",
            ":B",
        ),
    ]);
}

#[test]
fn references_that_fail_say_why() {
    check(&[
        (
            "(reference (an object (type bottle)))",
            "!! Designator `#<A OBJECT\n    (TYPE BOTTLE)>' does not reference an object.\nIt must be detected first.",
        ),
        (
            "(reference (an action (type pickng-up)))",
            "!! Cannot resolve action designator #<A ACTION\n    (TYPE PICKNG-UP)>.\nThere is no action of type PICKNG-UP; did you mean PICKING-UP?",
        ),
        (
            "(reference (a location (on table)))",
            "!! Unable to resolve designator `#<A LOCATION\n    (ON TABLE)>'\nNothing generates such a location: write (a location (pose ?pose)).",
        ),
        (
            "(perform (an action (type going) (targt 1)))",
            "!! Designator #<A ACTION\n    (TYPE GOING)\n    (TARGT 1)> could not be resolved.\nThe action GOING needs (target …): where to; did you mean TARGET by TARGT?",
        ),
        (
            "(perform (a motion (type dancing)))",
            "!! No matching process module found for #<A MOTION\n    (TYPE DANCING)>\nThere is no motion of type DANCING.",
        ),
        (
            "(perform (a motion (type going)))",
            "!! Designator #<A MOTION\n    (TYPE GOING)> could not be resolved.\nCannot perform motion.\nThe motion GOING needs (target …): where to.",
        ),
        (
            "(setf cram-language-implementation::*current-task* nil) (perform (a motion (type going)))",
            "!! There is no plan for PERFORM to be a part of: write it inside (with-simulated-robot …).",
        ),
    ]);
}

#[test]
fn property_values_of_wrong_types_are_named() {
    check(&[
        (
            "(let ((?o nil)) (perform (an action (type picking-up) (object ?o))))",
            "!! [ACTION SPEC:PROPERTY]: NIL had to be of type OBJECT-DESIGNATOR\nThe object is NIL: was the object detected first?",
        ),
        (
            "(let ((?p (pp-tut:make-pose \"map\" '((1 2 0) (0 0 0 1))))) (perform (a motion (type going) (target ?p))))",
            "!! [MOTION SPEC:PROPERTY]: #<\"map\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))> had to be of type LOCATION-DESIGNATOR\nWrite (target (a location (pose ?pose))).",
        ),
        (
            "(perform (a motion (type going) (target (a location (pose '((0 1 0) (0 0 0 1)))))))",
            "!! [LOCATION SPEC:PROPERTY]: (:QUOTE ((0 1 0) (0 0 0 1))) had to be of type POSE-STAMPED\nNothing is quoted or called inside a designator: bind a variable such as ?pose and write (pose ?pose).",
        ),
        (
            "(perform (an action (type picking-up) (object (object (type cup)))))",
            "!! [ACTION SPEC:PROPERTY]: (:OBJECT (:TYPE :CUP)) had to be of type OBJECT-DESIGNATOR\nWrite (object (an object …)).",
        ),
        (
            "(perform (a motion (type going) (target (location (pose nil)))))",
            "!! [MOTION SPEC:PROPERTY]: (:LOCATION (:POSE NIL)) had to be of type LOCATION-DESIGNATOR\nWrite (target (a location …)).",
        ),
        (
            "(perform (a motion (type moving-torso) (joint-angle (max 1 2))))",
            "!! [MOTION SPEC:PROPERTY]: (:MAX 1 2) had to be of type NUMBER\nNothing is quoted or called inside a designator: bind a variable such as ?joint-angle and write (joint-angle ?joint-angle).",
        ),
        (
            "(perform (a motion (type moving-torso) (joint-angle up)))",
            "!! [MOTION SPEC:PROPERTY]: :UP had to be of type NUMBER",
        ),
    ]);
}

#[test]
fn motions_become_requests() {
    check(&[
        (
            "(perform (a motion (type moving-torso) (joint-angle 0.3)))",
            "?? MOVING-TORSO JOINT-ANGLE 0.3",
        ),
        (
            "(let ((?p (pp-tut:make-pose \"map\" '((1 2 0) (0 0 0 1))))) (perform (a motion (type going) (pose ?p))))",
            "?? GOING TARGET #<A LOCATION\n    (POSE #<\"map\" ((1.00000 2.00000 0.00000) (0.00000 0.00000 0.00000 1.00000))>)>",
        ),
        (
            "(perform (a motion (type opening) (gripper left)))",
            "?? OPENING GRIPPER :LEFT",
        ),
    ]);
}

#[test]
fn designators_nested_without_end_print_and_are_freed() {
    check(&[(
        "(let ((d nil)) (dotimes (i 200000) (let ((?d d)) (setf d (an object (in ?d)))))
           (list (> (length (prin1-to-string d)) 100) (setf d nil)))",
        "(T NIL)",
    )]);
    let shown = evaluate_in(
        &mut image(),
        "(let ((d (make-designator :object (list (list :k 1)))))
           (setf (second (first (description d))) d)
           d)",
    );
    assert!(shown.contains("#<A OBJECT …>"), "{shown}");
}

#[test]
fn with_designators_binds_them_in_order() {
    check(&[(
        "(with-designators ((cup :object '((:type :cup)))
                            (grasp :action `((:type :grasping) (:object ,cup))))
           (desig-prop-value (desig-prop-value grasp :object) :type))",
        ":CUP",
    )]);
}
