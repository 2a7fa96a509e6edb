//! Tests of designators: each evaluates a text and compares what is printed.

use super::MotionRequest;
use super::schema::{self, Key, Kind, Text, TypeRow};
use super::value::Class;
use crate::lisp::compile;
use crate::lisp::image::Image;
use crate::lisp::image::notes::NoteKind;
use crate::lisp::print;
use crate::lisp::reader::{Outcome, Reader};
use crate::lisp::value::Value;
use crate::lisp::value::symbol::known;
use crate::lisp::vm::fiber::Fiber;
use crate::lisp::vm::machine::{Event, Machine};

/// An image in which designators need no package prefix and a plan seems to be running.
pub(crate) fn image() -> Image {
    let mut image = Image::new();
    crate::plan::install(&mut image);
    crate::plan::designator::install(&mut image);
    crate::plan::pose::install(&mut image);
    let prelude = "(defpackage :d (:use :common-lisp :desig :exe :prolog :cut))
                   (in-package :d)";
    let task =
        crate::plan::packages::symbol(&mut image, "CRAM-LANGUAGE-IMPLEMENTATION", "*CURRENT-TASK*");
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
pub(crate) fn evaluate_in(image: &mut Image, text: &str) -> String {
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
            "#<A ACTION\n    (TYPE PICKING-UP)\n    (ARM LEFT)\n    (OBJECT #<A OBJECT\n    (TYPE BOTTLE)>)>",
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
        shown.starts_with("!! Error while parsing arguments to DEFMACRO A: too few elements in ()"),
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
fn actions_call_plans() {
    check(&[
        (
            "(defun grip (&rest args) args)
             (perform (an action (type gripping) (arm left) (effort 5)))",
            "(:GRIPPER :LEFT :EFFORT 5)",
        ),
        (
            "(perform (an action (type moving-torso) (joint-angle 0.3)))",
            "!! Action designator `#<A ACTION\n    (TYPE MOVING-TORSO)\n    (JOINT-ANGLE 0.3)>' resolved to cram function `MOVE-TORSO', but it isn't defined. Cannot perform action.",
        ),
    ]);
}

#[test]
fn rules_of_plans_ground_actions() {
    check(&[
        (
            "(defun my-plan (x) (list :done x))
             (def-fact-group mine (desig:action-grounding)
               (<- (desig:action-grounding ?designator (my-plan ?x))
                 (spec:property ?designator (:type :my-type))
                 (spec:property ?designator (:x ?x))))
             (perform (an action (type my-type) (x 3)))",
            "(:DONE 3)",
        ),
        (
            "(defun my-plan (&key ((:x ?x)) &allow-other-keys) (list :done ?x))
             (def-fact-group mine (desig:action-grounding)
               (<- (desig:action-grounding ?designator (my-plan ?designator))
                 (spec:property ?designator (:type :my-type))))
             (perform (an action (type my-type) (x 3)))",
            "(:DONE 3)",
        ),
        (
            "(def-fact-group mine (desig:action-grounding)
               (<- (desig:action-grounding ?d (plan ?y))
                 (or (desig:desig-prop ?d (:type :a)) (desig:desig-prop ?d (:type :b)))
                 (desig:desig-prop ?d (:x ?x))
                 (not (equal ?x 0))
                 (lisp-fun + ?x 1 ?y)))
             (list (reference (an action (type b) (x 3)))
                   (handler-case (reference (an action (type b) (x 0)))
                     (desig:designator-error () :unresolved)))",
            "((PLAN 4) :UNRESOLVED)",
        ),
        (
            "(def-fact-group mine (desig:action-grounding)
               (<- (desig:action-grounding ?d (plan ?x)) (member ?x (1 2 3))))
             (let* ((a (an action (type x))) (b (next-solution a)))
               (list (reference a) (reference b) (reference (next-solution b))
                     (next-solution (next-solution b)) (desig-equal a b)))",
            "((PLAN 1) (PLAN 2) (PLAN 3) NIL T)",
        ),
    ]);
}

#[test]
fn prolog_proves() {
    check(&[
        ("(prolog '(member ?x (1 2)))", "(((?X . 1)) ((?X . 2)))"),
        ("(prolog '(and))", "(NIL)"),
        ("(prolog '(fail))", "NIL"),
        ("(force-ll (prolog '(and (member ?x (1 2 3)) (lisp-pred oddp ?x))))", "(((?X . 1)) ((?X . 3)))"),
        ("(prolog '(and (== ?x ?y) (== ?y 3)))", "(((?Y . 3) (?X . 3)))"),
        ("(prolog '(findall ?x (member ?x (1 2)) ?l))", "(((?L 1 2)))"),
        ("(prolog '(setof ?x (member ?x (1 2 1)) ?l))", "(((?L 1 2)))"),
        ("(prolog '(once (member ?x (1 2))))", "(((?X . 1)))"),
        ("(prolog '(-> (member ?x (1 2)) (== ?y ?x) (== ?y 0)))", "(((?Y . 1) (?X . 1)))"),
        ("(prolog '(-> (member ?x ()) (== ?y ?x) (== ?y 0)))", "(((?Y . 0)))"),
        ("(prolog '(*-> (member ?x (1 2)) (== ?y ?x) (== ?y 0)))", "(((?Y . 1) (?X . 1)) ((?Y . 2) (?X . 2)))"),
        ("(prolog '(forall (member ?x (1 3)) (lisp-pred oddp ?x)))", "(NIL)"),
        ("(prolog '(append ?a ?b (1)))", "(((?B 1) (?A)) ((?B) (?A 1)))"),
        (
            "(def-fact-group g () (<- (p 1)) (<- (p 2) !) (<- (p 3)) (<- (q ?x) (p ?x)))
             (mapcar (lambda (b) (var-value '?x b)) (force-ll (prolog '(q ?x))))",
            "(1 2)",
        ),
        (
            "(def-prolog-handler twice (bindings x y) (declare (ignore bindings)) (list (list (cons y (* 2 x)))))
             (force-ll (prolog '(and (member ?x (1 2)) (twice ?x ?y))))",
            "(((?Y . 2) (?X . 1)) ((?Y . 4) (?X . 2)))",
        ),
        (
            "(def-fact-group g () (<- (loop ?x) (loop ?x)) (<- (loop 1)))
             (handler-case (prolog '(loop ?x)) (error () :error))",
            ":ERROR",
        ),
    ]);
}

#[test]
fn locations_are_generated_and_validated() {
    check(&[
        (
            "(let ((?p (pp-tut:make-pose \"odd\" '((1 2 0) (0 0 0 1))))) (eq ?p (reference (a location (pose ?p)))))",
            "T",
        ),
        (
            "(register-location-generator 5 (lambda (d) (declare (ignore d)) (list 1 2 3 4)))
             (register-location-validation-function 5 (lambda (d p) (declare (ignore d)) (if (evenp p) :accept :maybe-reject)))
             (let* ((a (a location (x 1))) (b (progn (reference a) (next-solution a))))
               (list (reference a) (reference b) (next-solution b) (reference a)))",
            "(2 4 NIL 2)",
        ),
        (
            "(register-location-generator 6 (lambda (d) (declare (ignore d)) (list 3)))
             (register-location-generator 5 (lambda (d) (declare (ignore d)) nil))
             (register-location-validation-function 5 (lambda (d p) (declare (ignore d p)) :unknown))
             (reference (a location (x 1)))",
            "3",
        ),
        (
            "(defvar *n* 0)
             (register-location-generator 5 (lambda (d) (declare (ignore d)) (make-list 100)))
             (register-location-validation-function 5 (lambda (d p) (declare (ignore d p)) (incf *n*) :reject))
             (list (handler-case (reference (a location (x 1))) (desig:designator-error () :none)) *n*)",
            "(:NONE 30)",
        ),
    ]);
}

#[test]
fn perceived_objects_keep_what_was_asked_for() {
    let mut image = image();
    let query = crate::plan::designator::value::make(
        &mut image,
        Class::Object,
        &[("COLOR", Value::Int(1))],
    );
    let (name, kind) = (image.keyword("BOTTLE-1"), image.keyword("BOTTLE"));
    let pose = crate::spatial::Pose::translation(1.0, 0.0, 0.5);
    let found = crate::plan::designator::object::perceived(
        &mut image,
        &query,
        name.into(),
        kind.into(),
        &pose,
        &pose,
    );
    let sym = image.make_symbol("FOUND");
    image.define_special(sym, found);
    let package = image.current_package();
    image.packages.import(&mut image.symbols, package, sym);
    assert_eq!(
        evaluate_in(&mut image, "(mapcar #'first (properties found))"),
        "(:TYPE :NAME :POSE :COLOR)"
    );
    assert_eq!(
        evaluate_in(&mut image, "(object-identifier (reference found))"),
        ":BOTTLE-1"
    );
    assert_eq!(
        evaluate_in(
            &mut image,
            "(second (assoc :transform (desig-prop-value found :pose)))"
        ),
        "#<\"base_footprint\" \"bottle_1\" ((1.00000 0.00000 0.50000) (0.00000 0.00000 0.00000 1.00000))>"
    );
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

/// The mistakes that the compiler notes in a text.
fn mistakes(text: &str) -> Vec<String> {
    let mut image = image();
    let source = image.sources.add("test", text);
    let mut reader = Reader::new(&image, source);
    image.notes = Some(Vec::new());
    while let Ok(Some((form, _))) = reader.next_form(&mut image) {
        assert!(compile::compile_form(&mut image, &form).is_ok(), "{text}");
    }
    let notes = image.notes.take().unwrap_or_default().into_iter();
    notes
        .filter_map(|note| match note.kind {
            NoteKind::Mistake { text, .. } => Some(text),
            _ => None,
        })
        .collect()
}

#[test]
fn mistakes_in_forms_are_found_without_running_them() {
    for (text, expected) in [
        (
            "(defun f (?p) (an action (type going) (target (a location (pose ?p)))))",
            "",
        ),
        (
            "(defun f () (an action (type goign)))",
            "There is no action of type GOIGN; did you mean GOING?",
        ),
        (
            "(an action (type going) (targt 1))",
            "The action GOING has no key TARGT; did you mean TARGET?",
        ),
        (
            "(a motion (type going))",
            "The motion GOING needs (target …): where to.",
        ),
        (
            "(an action (type looking))",
            "The action LOOKING needs one of target, direction.",
        ),
        (
            "(a location (pose '(1 2)))",
            "Nothing is quoted inside a designator: bind a variable such as ?pose and write (pose ?pose).",
        ),
        (
            "(a location (pose (pp-tut:make-pose \"map\" x)))",
            "(make-pose …) is not called inside a designator: bind a variable such as ?pose and write (pose ?pose).",
        ),
        ("'(an action (type goign))", ""),
        ("(let ((?type :x)) (an action (type ?type)))", ""),
        ("(an action (type looking) (when ?d (direction ?d)))", ""),
        ("`(an action (type going) ,@more)", ""),
    ] {
        assert_eq!(mistakes(text).join("\n"), expected, "{text}");
    }
}

#[test]
fn an_action_is_defined_with_its_keys() {
    check(&[
        (
            "(def-action waving ((arm (member left right)) &optional (times number)) (:plan wave))
             (defun wave (&rest args) args)
             (list (perform (an action (type waving) (arm left) (times 2)))
                   (reference (an action (type waving) (arm right))))",
            "((:ARM :LEFT :TIMES 2) (WAVE :ARM :RIGHT))",
        ),
        (
            "(def-action waving ((arm (member left right))) (:plan wave))
             (perform (an action (type waving) (arm middle)))",
            "!! [ACTION SPEC:PROPERTY]: :MIDDLE had to be of type (MEMBER LEFT RIGHT)",
        ),
        (
            "(def-action waving (arm) (:plan wave))
             (perform (an action (type waving)))",
            "!! Designator #<A ACTION\n    (TYPE WAVING)> could not be resolved.\nThe action WAVING needs (arm …).",
        ),
        (
            "(def-action waving ((object object)) (:variant thing) (:plan wave-thing))
             (def-action waving (arm) (:plan wave))
             (list (reference (an action (type waving) (arm right)))
                   (first (reference (an action (type waving) (object (an object))))))",
            "((WAVE :ARM :RIGHT) WAVE-THING)",
        ),
        (
            "(def-action waving (arm) (:plan wave))
             (perform (an action (type waving) (arm left) (object (an object (type flag)))))",
            "!! Designator #<A ACTION\n    (TYPE WAVING)\n    (ARM LEFT)\n    (OBJECT #<A OBJECT\n    (TYPE FLAG)>)> could not be resolved.\nThe action WAVING cannot act on an object: it was given #<A OBJECT\n    (TYPE FLAG)>.",
        ),
    ]);
}

#[test]
fn a_malformed_definition_of_an_action_says_what_is_wrong() {
    check(&[
        (
            "(def-action)",
            "!! NIL is not the name of a type of actions: (def-action type ((key kind \"what it means\")…) \"what it does\" (:option …)… body…) was expected.",
        ),
        (
            "(def-action waving arm (wave))",
            "!! DEF-ACTION WAVING has no list of keys, but ARM: (def-action type ((key kind \"what it means\")…) \"what it does\" (:option …)… body…) was expected.",
        ),
        (
            "(def-action waving (arm))",
            "!! DEF-ACTION WAVING has no body: write what the action does, or (:plan function) with the name of a function that does it.",
        ),
        (
            "(def-action waving ((arm armm)) 1)",
            "!! In the key (ARM ARMM): ARMM is not a kind; there are LOCATION, PLACE, OBJECT, DETECTED-OBJECT, OBJECTS, NUMBER, KEYWORDS, KEYWORD, SYMBOL, STRING, LIST, POSES, POSE, KEYWORD-OR-OBJECT, ACTION, T, and (MEMBER …).",
        ),
        (
            "(def-action waving ((times numbr)) 1)",
            "!! In the key (TIMES NUMBR): NUMBR is not a kind; did you mean NUMBER?",
        ),
        (
            "(def-action waving ((arm (or left right))) 1)",
            "!! In the key (ARM (OR LEFT RIGHT)): (OR LEFT RIGHT) is not a kind: (member name…) was expected.",
        ),
        (
            "(def-action waving ((arm number \"which\" :default 1)) 1)",
            "!! In the key (ARM NUMBER \"which\" :DEFAULT 1): a key that must be given has no default; those that need not be given come after &OPTIONAL.",
        ),
        (
            "(def-action waving ((arm number :alias (side))) 1)",
            "!! In the key (ARM NUMBER :ALIAS (SIDE)): :ALIAS is neither a kind, a documentation string, :aliases nor :default.",
        ),
        (
            "(def-action waving (arm (side number \"\" :aliases (arm))) 1)",
            "!! ARM is the name of two keys of the action.",
        ),
        (
            "(def-action waving (arm &key side) 1)",
            "!! &KEY does not belong into the keys of an action: keys after &OPTIONAL need not be given.",
        ),
        (
            "(def-action waving (arm) (:alias greeting) 1)",
            "!! DEF-ACTION has no option :ALIAS; did you mean ALIASES? There are :aliases, :one-of, :plan, :variant, :example.",
        ),
        (
            "(def-action waving (arm side) (:one-of arm sid) 1)",
            "!! SID of (:ONE-OF ARM SID) is not one of the keys; did you mean SIDE?",
        ),
        (
            "(def-action waving (arm) (:plan) 1)",
            "!! The option (:PLAN) takes one name, as in (:plan name).",
        ),
        (
            "(def-action waving (arm) (:example (an action (type wavng))) 1)",
            "!! (:EXAMPLE (AN ACTION (TYPE WAVNG))) is not an example: (:example (an action (type waving) …)) was expected.",
        ),
        (
            "(def-action search (arm) 1)",
            "!! The plan of DEF-ACTION SEARCH would redefine the function SEARCH of Common Lisp: give it another name with (:plan name).",
        ),
    ]);
}
