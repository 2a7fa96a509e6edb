//! Action designators: their definitions, the plans that they call, and mistakes in both.

use super::{check, image};
use lisp::compile;
use lisp::image::notes::NoteKind;
use lisp::reader::Reader;

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
            "!! Designator #<A ACTION\n    (TYPE WAVING)\n    (ARM LEFT)\n    (OBJECT #<A OBJECT\n                (TYPE FLAG)>)> could not be resolved.\nThe action WAVING cannot act on an object: it was given #<A OBJECT\n    (TYPE FLAG)>.",
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
