//! What published code of CRAM builds on: packages, method combinations, data by type, rules of costmaps,
//! ROS within one process. And questions to the world, which change nothing.

use session::dialogue::{Evaluate, Event};
use session::{Session, SessionOptions};

/// Packages of CRAM, one a line: name, nicknames, the packages that it uses, what it takes from others in
/// place of theirs, and what it shadows, separated by bars.
const PACKAGES: &str = include_str!("cram_packages.txt");

fn session() -> Session {
    Session::new(&SessionOptions::default()).expect("a session starts")
}

/// What a text prints and returns, or the report of what ended it.
fn said(session: &mut Session, text: &str) -> String {
    let mut said = String::new();
    session.evaluate("test", text, &mut |event| match event {
        Event::Output(text) => said.push_str(&text),
        Event::Values(values) => said.push_str(&values.join(" ; ")),
        Event::Aborted(abort) => said.push_str(&format!("!! {}", abort.report)),
        _ => {}
    });
    said.trim().to_owned()
}

fn quoted<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.map(|name| format!("{name:?} ")).collect()
}

#[test]
fn packages_have_the_nicknames_and_uses_of_cram_and_can_be_used_together() {
    let mut session = session();
    let mut wrong = Vec::new();
    for (number, line) in PACKAGES.lines().enumerate() {
        let parts: Vec<&str> = line.split('|').collect();
        let [name, nicknames, uses, taken, shadowed] = parts[..] else {
            panic!("{line}");
        };
        let nicknames = quoted(nicknames.split_whitespace());
        let used = quoted(uses.split_whitespace());
        let check = format!(
            "(let ((package (find-package {name:?})))
               (append (remove-if (lambda (n) (eq (find-package n) package)) '({nicknames}))
                       (remove-if (lambda (n) (member (find-package n) (package-use-list package)))
                                  '({used}))))"
        );
        let missing = said(&mut session, &check);
        if missing != "NIL" {
            wrong.push(format!("{name} lacks {missing}"));
        }
        // One that uses the same.
        let taken: String = taken
            .split_whitespace()
            .filter_map(|taken| taken.split_once(':'))
            .map(|(from, names)| {
                let names = quoted(names.split(','));
                format!("(:shadowing-import-from {from:?} {names})")
            })
            .collect();
        let shadowed = quoted(shadowed.split_whitespace());
        let other = said(
            &mut session,
            &format!(
                "(package-name (defpackage \"LIKE-{number}\" (:use \"COMMON-LISP\" {used}) {taken} (:shadow {shadowed})))"
            ),
        );
        if !other.contains("LIKE-") {
            wrong.push(format!("{name}: {other}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn numbers_qualify_methods() {
    let mut session = session();
    let mut ask = |text: &str| said(&mut session, text);
    ask(
        "(defgeneric weight (x) (:method-combination cut:first-in-order-and-around)
           (:method :usual 20 ((x t)) :any))
         (defmethod weight :usual 20 ((x (eql :cup))) :cup)
         (defmethod weight :mine 3 ((x symbol)) (list :symbol x))
         (defmethod weight :around ((x string)) (list :around (call-next-method)))",
    );
    assert_eq!(ask("(weight 1)"), ":ANY");
    assert_eq!(ask("(weight :cup)"), "(:SYMBOL :CUP)");
    assert_eq!(ask("(weight \"cup\")"), "(:AROUND :ANY)");
    // The same qualifiers replace a method.
    ask("(defmethod weight :mine 3 ((x symbol)) :replaced)");
    assert_eq!(ask("(weight :cup)"), ":REPLACED");
    assert_eq!(
        ask("(method-qualifiers (find-method #'weight '(:mine 3) (list (find-class 'symbol))))"),
        "(:MINE 3)"
    );
    ask("(remove-method #'weight (find-method #'weight '(:mine 3) (list (find-class 'symbol))))");
    assert_eq!(ask("(weight :cup)"), ":CUP");
    // A number alone, and where the combination takes none.
    ask("(defgeneric plain (x)) (defmethod plain 3 ((x t)) x)");
    assert!(
        ask("(plain 1)").contains("(3) cannot be used with the method combination type STANDARD"),
        "{}",
        ask("(plain 1)")
    );
    let none =
        ask("(defgeneric none (x) (:method-combination cut:first-in-order-and-around)) (none 1)");
    assert!(none.contains("!!"), "{none}");
    // Hooks run all, the numbered ones first.
    ask("(defvar *order* '())
         (defgeneric hooked (x) (:method-combination cut:ordered-hooks))
         (defmethod hooked late 7 (x) (push 7 *order*))
         (defmethod hooked early 1 (x) (push 1 *order*))
         (defmethod hooked whenever (x) (push :whenever *order*))
         (hooked 1)");
    assert_eq!(ask("(reverse *order*)"), "(1 7 :WHENEVER)");
    // Without methods they return NIL.
    let unhooked = ask("(cut:define-hook unhooked (x)) (unhooked 1)");
    assert!(unhooked.ends_with("NIL"), "{unhooked}");
}

#[test]
fn events_run_numbered_methods_in_order_besides_what_is_built_in() {
    let mut session = session();
    let text = "(defvar *seen* '())
        (defmethod coe:on-event second-thing 2 ((event cpoe:robot-state-changed)) (push 2 *seen*))
        (defmethod coe:on-event first-thing 1 ((event cpoe:robot-state-changed)) (push 1 *seen*))
        (defmethod coe:on-event ((event cpoe:robot-state-changed)) (push :last *seen*))
        (coe:on-event (make-instance 'cpoe:robot-state-changed))
        (reverse *seen*)";
    assert!(said(&mut session, text).ends_with("(1 2 :LAST)"));
}

#[test]
fn data_of_types_is_that_of_users_first_and_of_types_above() {
    let mut session = session();
    let mut ask = |text: &str| said(&mut session, text);
    let built_in = ask("(man-int:get-action-gripping-effort :bottle)");
    assert!(
        built_in.parse::<f64>().is_ok() || built_in.ends_with("d0"),
        "{built_in}"
    );
    ask(
        "(defmethod man-int:get-action-gripping-effort :heuristics 20 ((type (eql :glassware))) 7)
         (prolog:def-fact-group my-types (man-int:object-type-direct-subtype)
           (prolog:<- (man-int:object-type-direct-subtype :glassware :beaker)))",
    );
    assert_eq!(ask("(man-int:get-action-gripping-effort :beaker)"), "7");
    assert_eq!(
        ask("(man-int:get-action-gripping-effort :bottle)"),
        built_in
    );
    ask("(defmethod man-int:get-action-gripping-effort :mine 2 ((type (eql :bottle))) 11)");
    assert_eq!(ask("(man-int:get-action-gripping-effort :bottle)"), "11");
}

#[test]
fn rules_of_costmaps_rule_places_out() {
    let mut session = session();
    let verdicts = said(
        &mut session,
        "(in-package :cl-user)
         (defun left-half () (lambda (x y) (if (> y 0) 1.0 0.0)))
         (prolog:def-fact-group my-costmap (costmap:desig-costmap)
           (prolog:<- (costmap:desig-costmap ?designator ?costmap)
             (rob-int:reachability-designator ?designator)
             (costmap:costmap ?costmap)
             (costmap:costmap-add-function left-half (left-half) ?costmap)))
         (let ((location (desig:make-designator :location '((:reachable-for :pr2))))
               (table (desig:make-designator :location '((:on :table)))))
           (flet ((at (y location)
                    (costmap::costmap-rule-validator
                     location (cl-transforms:make-pose (cl-transforms:make-3d-vector 0 y 0)
                                                       (cl-transforms:make-identity-rotation)))))
             (list (at 1 location) (at -1 location) (at -1 table))))",
    );
    assert!(
        verdicts.ends_with("(:UNKNOWN \"the costmap left-half rules it out\" :UNKNOWN)"),
        "{verdicts}"
    );
}

#[test]
fn messages_go_to_those_who_listen_in_this_process() {
    let mut session = session();
    let mut ask = |text: &str| said(&mut session, text);
    ask("(defvar *heard* '())
         (roslisp:subscribe \"chat\" \"std_msgs/String\" (lambda (m) (push (roslisp:msg-slot-value m :data) *heard*)))
         (defvar *topic* (roslisp:advertise \"chat\" \"std_msgs/String\"))");
    assert_eq!(
        ask("(roslisp:publish *topic* (roslisp:make-message \"std_msgs/String\" :data \"hello\"))"),
        "1"
    );
    assert_eq!(ask("*heard*"), "(\"hello\")");
    assert_eq!(ask("(roslisp:publish \"no\" 1)"), "!! Unknown topic no");
    assert_eq!(
        ask("(roslisp:with-fields ((x (x linear)) data)
                (roslisp:make-message \"t\" (:x :linear) 3 :data 4) (list x data))"),
        "(3 4)"
    );
    assert!(ask("(roslisp:get-param \"nothing\")").starts_with("!! There is no parameter"));
    assert_eq!(ask("(roslisp:get-param \"nothing\" 3)"), "3");
    assert!(ask("(giskard:giskard-pm)").contains("there is no Giskard here"));
}

/// Goals with nothing given but the world, for every functor of the world.
const OPEN_GOALS: &[&str] = &[
    "(object ?w ?a)",
    "(%object ?w ?a ?b)",
    "(item ?w ?a)",
    "(item-type ?w ?a ?b)",
    "(object-type ?w ?a ?b)",
    "(object-pose ?w ?a ?b)",
    "(pose ?w ?a ?b)",
    "(pose ?w ?a ?b ?c)",
    "(object-bottom-pose ?w ?a ?b)",
    "(contact ?w ?a ?b)",
    "(contact ?w ?a ?b ?c)",
    "(link-contacts ?w ?a ?b ?c)",
    "(object-not-in-collision ?w ?a)",
    "(above ?w ?a ?b)",
    "(above ?w ?a ?b ?c)",
    "(below ?w ?a ?b)",
    "(supported-by ?w ?a ?b)",
    "(supported-by ?w ?a ?b ?c)",
    "(on ?w ?a ?b)",
    "(in ?w ?a ?b)",
    "(in ?w ?a ?b ?c)",
    "(near ?w ?a ?b)",
    "(near ?w ?a ?b ?d)",
    "(left-of ?w ?a ?b)",
    "(right-of ?w ?a ?b)",
    "(behind ?w ?a ?b)",
    "(in-front-of ?w ?a ?b)",
    "(stable ?w ?a)",
    "(stable ?w)",
    "(stable-items ?w ?a)",
    "(container ?w ?a ?b)",
    "(visible ?w ?a ?b)",
    "(visible-from ?w ?a ?b)",
    "(occluding-objects ?w ?a ?b ?c)",
    "(occluding-object ?w ?a ?b ?c)",
    "(object-grasp ?w ?a ?b ?c)",
    "(valid-grasp ?w ?a ?b ?c)",
    "(reachable ?w ?a ?b)",
    "(reachable ?w ?a ?b ?c)",
    "(reachable ?w ?a ?b ?c ?d)",
    "(pose-reachable ?w ?a ?b ?c)",
    "(point-reachable ?w ?a ?b ?c)",
    "(blocking ?w ?a ?b ?c)",
    "(blocking ?w ?a ?b ?c ?d)",
    "(link ?w ?a ?b)",
    "(link-pose ?w ?a ?b ?c)",
    "(joint-state ?w ?a ?b ?c)",
    "(attached ?w ?a ?b ?c)",
    "(attached ?w ?a ?b ?c ?d)",
    "(n-poses-on ?w ?a ?b ?c ?d)",
    "(desig-poses ?w ?a ?b ?c ?d)",
    "(with-copied-world ?w (item ?w ?a) (retract (object ?w ?a)) (not (item ?w ?a)))",
    "(with-copied-world ?w (assert (object-pose ?w bottle-1 ((0 0 2) (0 0 0 1)))) (simulate ?w 0.5) (lisp-fun error \"no\" ?a))",
    "(with-stored-world ?w (assert (joint-state ?w :kitchen ((\"iai_fridge_door_joint\" 0.5)))) (joint-state ?w :kitchen \"iai_fridge_door_joint\" ?a))",
];

/// Occasions with variables in all places.
const OPEN_OCCASIONS: &[&str] = &[
    "(object-in-hand ?a ?b ?c ?d)",
    "(object-at-location ?a ?b)",
    "(object-placed ?a ?b)",
    "(robot-at-location ?a)",
    "(torso-at ?a)",
    "(gripper-joint-at ?a ?b)",
    "(gripper-opened ?a)",
    "(gripper-closed ?a)",
    "(arms-positioned-at ?a ?b)",
    "(tool-frames-at ?a ?b)",
    "(looking-at ?a)",
    "(container-state ?a ?b)",
    "(location-reset ?a)",
    "(location-accessible ?a)",
];

const WORLD: &str = "(in-package :btr)
    (pp-tut:init-projection)
    (btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))
    (btr-utils:spawn-object 'cup-1 :cup :pose '((-1.45 -1.1 0.78) (0 0 0 1)))
    (btr-utils:spawn-object 'bowl-1 :bowl :pose '((1.4 0.8 0.87) (0 0 0 1)))";

#[test]
fn questions_change_nothing_and_say_what_must_be_given() {
    let mut session = session();
    said(&mut session, WORLD);
    let before = said(&mut session, "(pw:world-hash)");
    let asked = OPEN_GOALS
        .iter()
        .map(|goal| (goal, format!("(cut:force-ll (prolog-?w '{goal}))")))
        .chain(OPEN_OCCASIONS.iter().map(|occasion| {
            let text = format!("(cut:force-ll (coe:holds '{occasion}))");
            (occasion, text)
        }));
    for (goal, text) in asked {
        let answer = said(&mut session, &text);
        assert!(!answer.contains("is not of type"), "{goal}: {answer}");
        if answer.starts_with("!!") {
            assert!(
                answer.contains("must be given") || answer.contains("no"),
                "{goal}: {answer}"
            );
        }
        assert_eq!(said(&mut session, "(pw:world-hash)"), before, "{goal}");
    }
    // In a world of nothing but the robot, too.
    said(&mut session, "(pp-tut:init-projection)");
    for goal in OPEN_GOALS {
        let answer = said(&mut session, &format!("(cut:force-ll (prolog-?w '{goal}))"));
        assert!(!answer.contains("is not of type"), "{goal}: {answer}");
    }
}

#[test]
fn fact_groups_of_users_add_answers() {
    let mut session = session();
    said(&mut session, WORLD);
    let text = "(prolog:def-fact-group known (visible)
          (prolog:<- (visible ?w ?r :moon)
            (bullet-world ?w)))
        (mapcar (lambda (answer) (cut:var-value '?o answer))
                (cut:force-ll (prolog-?w '(visible ?w ?r ?o))))";
    assert!(said(&mut session, text).ends_with("(BOWL-1 :MOON)"));
    // And found by their names from other packages.
    let text = "(in-package :cl-user)
        (mapcar (lambda (answer) (symbol-name (cut:var-value '?o answer)))
                (cut:force-ll (prolog:prolog '(supported-by ?w ?o :kitchen))))";
    let found = said(&mut session, text);
    assert!(
        found.ends_with("(\"BOTTLE-1\" \"CUP-1\" \"BOWL-1\")"),
        "{found}"
    );
}

#[test]
fn edits_by_goals_can_be_taken_back_and_keep_to_limits() {
    let mut session = session();
    said(&mut session, WORLD);
    let before = said(&mut session, "(pw:world-hash)");
    said(
        &mut session,
        "(prolog-?w '(assert (object-pose ?w bottle-1 ((-1.5 -0.9 0.82) (0 0 0 1)))))",
    );
    assert_ne!(said(&mut session, "(pw:world-hash)"), before);
    said(&mut session, "(pw:rewind)");
    assert_eq!(said(&mut session, "(pw:world-hash)"), before);
    let torso = said(
        &mut session,
        "(setf (joint-state (get-robot-object) \"torso_lift_joint\") 7.0)
         (joint-state (get-robot-object) \"torso_lift_joint\")",
    );
    assert!(
        torso.contains("it is at its limit") && torso.ends_with("0.33d0"),
        "{torso}"
    );
    assert!(
        said(&mut session, "(prolog-?w '(assert (temperature ?w 3)))")
            .contains("asserted can be object, object-pose")
    );
    assert!(
        said(
            &mut session,
            "(add-object nil :point-cloud 'x '((0 0 1) (0 0 0 1)))"
        )
        .contains("the kinds are")
    );
}

#[test]
fn rules_that_ground_a_motion_are_tried_one_by_one() {
    let mut session = session();
    let mut ask = |text: &str| said(&mut session, text);
    ask("(defvar *asked* '())
         (defun note (what) (push what *asked*) what)
         (prolog:def-fact-group hopping (desig:motion-grounding)
           (prolog:<- (desig:motion-grounding ?m (hop ?how))
             (desig:desig-prop ?m (:type :hopping))
             (prolog:lisp-fun note :first ?how))
           (prolog:<- (desig:motion-grounding ?m (hop ?how))
             (desig:desig-prop ?m (:type :hopping))
             (prolog:lisp-fun note :second ?how))
           (prolog:<- (desig:motion-grounding ?m (hop ?how))
             (desig:desig-prop ?m (:type :hopping))
             (prolog:lisp-fun error \"Too far.\" ?how)))
         (defvar *motion* (desig:a motion (type hopping)))");
    assert_eq!(
        ask("(list (desig:reference *motion*) *asked*)"),
        "((HOP :FIRST) (:FIRST))"
    );
    assert_eq!(
        ask("(desig:reference (desig:next-solution *motion*))"),
        "(HOP :SECOND)"
    );
    let third = ask("(desig:next-solution (desig:next-solution *motion*))");
    assert!(third.contains("Too far."), "{third}");
}

#[test]
fn methods_of_users_say_where_things_are_and_belong() {
    let mut session = session();
    let mut ask = |text: &str| said(&mut session, text);
    ask(
        "(defmethod man-int:get-object-likely-location :heuristics 20
             ((type (eql :cup)) environment human (context (eql :tea)))
           (desig:a location (on (desig:an object (urdf-name sink-area-surface) (part-of kitchen)))))",
    );
    let place = ask("(man-int::likely-location-for :cup :tea)");
    assert!(place.contains("SINK-AREA-SURFACE"), "{place}");
    assert_eq!(ask("(man-int::likely-location-for :bowl :tea)"), "NIL");
}

#[test]
fn what_another_kitchen_has_is_named() {
    let mut session = session();
    let mut ask = |text: &str| said(&mut session, text);
    let told = ask(
        "(setf (btr:joint-state (btr:get-environment-object) \"sink_area_dish_washer_tray_main\") 0.0)",
    );
    assert!(
        told.contains("The kitchen has no joint sink_area_dish_washer_tray_main"),
        "{told}"
    );
    let wrong = ask("(setf (btr:joint-state (btr:get-environment-object) \"no_such_joint\") 0.5)");
    assert!(wrong.contains("no moving joint no_such_joint"), "{wrong}");
    let elsewhere = ask(
        "(btr-belief:vary-kitchen-urdf '((\"kitchen_island_footprint_joint\" ((-1.363 0.59 0) (0 0 0 1)))
                                         (\"dining_area_footprint_joint\" ((-3.38 0.28 0) (0 0 0 1)))))",
    );
    assert!(
        elsewhere.contains("it has no dining_area_footprint"),
        "{elsewhere}"
    );
    assert!(!elsewhere.contains("kitchen_island"), "{elsewhere}");
}
