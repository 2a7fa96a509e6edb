//! Plan files with one typical mistake each, and what `check` says of it: line, column, what is wrong
//! and what would be right.

use super::found;

#[test]
fn typical_mistakes_are_found() {
    let mut wrong = Vec::new();
    for (text, expected) in PLANS {
        let found = found("a.plan", &format!("(in-package :pp-tut)\n{text}"));
        if found != [*expected] {
            wrong.push(format!(
                "{text}\n  expected {expected}\n  found    {found:#?}"
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

const PLANS: &[(&str, &str)] = &[
    // Failures
    (
        "(defun go-on () (cpl:with-failure-handling ((navigation-low-level-failre (e) (declare (ignore e)) (return))) (park-arms)))",
        "2:46: There is no type NAVIGATION-LOW-LEVEL-FAILRE; did you mean NAVIGATION-LOW-LEVEL-FAILURE?",
    ),
    (
        "(defun go-on () (handler-case (park-arms) (plan-failre () nil)))",
        "2:44: There is no type PLAN-FAILRE; did you mean CRAM-LANGUAGE-IMPLEMENTATION:PLAN-FAILURE?",
    ),
    (
        "(defun give-up () (cpl:fail 'objct-unreachable :description \"far away\"))",
        "2:30: There is no condition OBJCT-UNREACHABLE; did you mean OBJECT-UNREACHABLE?",
    ),
    (
        "(defun give-up () (error (make-condition 'simple-plan-falure)))",
        "2:43: There is no condition SIMPLE-PLAN-FALURE; did you mean CRAM-LANGUAGE-IMPLEMENTATION:SIMPLE-PLAN-FAILURE?",
    ),
    (
        "(define-condition too-far (common-fail:navigation-falure) ())",
        "2:28: Symbol \"NAVIGATION-FALURE\" not found in the CRAM-COMMON-FAILURES package.",
    ),
    (
        "(defun go-on () (cpl:with-retry-counters ((tries 2)) (cpl:with-failure-handling ((cpl:plan-failure (e) (declare (ignore e)) (cpl:do-retry trys (cpl:retry)))) (park-arms))))",
        "2:125: DO-RETRY: there is no retry counter TRYS here. Known is TRIES.",
    ),
    // Arms and grasps
    (
        "(defun open-it () (perform (an action (type opening-gripper) (gripper rihgt))))",
        "2:71: There is no arm RIHGT; did you mean RIGHT?",
    ),
    (
        "(defun pick (?o) (perform (an action (type picking-up) (arm :middle) (object ?o))))",
        "2:61: There is no arm MIDDLE; there are LEFT, RIGHT.",
    ),
    (
        "(defun park () (pp-plans:park-arms :arm :lfet))",
        "2:41: There is no arm LFET; did you mean LEFT?",
    ),
    (
        "(defun park () (pp-plans:park-arms :arms :left))",
        "2:36: CRAM-MOBILE-PICK-PLACE-PLANS:PARK-ARMS has no key :ARMS; did you mean :ARM?",
    ),
    (
        "(defun park () (park-arm right))",
        "2:26: The variable RIGHT is unbound; did you mean the keyword :RIGHT?",
    ),
    (
        "(defun pick (?o) (perform (an action (type picking-up) (arm left) (grasp left-sied) (object ?o))))",
        "2:74: There is no grasp LEFT-SIED; did you mean LEFT-SIDE?",
    ),
    // Objects
    (
        "(defun find-it () (perform (an action (type detecting) (object (an object (type botle))))))",
        "2:81: There is no type of objects BOTLE; did you mean BOTTLE?",
    ),
    (
        "(defun put-it () (spawn-object '((-1.6 -0.9 0.82) (0 0 0 1)) :bottel))",
        "2:62: There is no type of objects BOTTEL; did you mean BOTTLE?",
    ),
    (
        "(defun grasps () (list-defined-grasps :cpu))",
        "2:39: There is no type of objects CPU; did you mean CUP?",
    ),
    (
        "(defun find-it () (perform (an action (type detecting) (object (an object (tpye bottle))))))",
        "2:76: An object has no key TPYE; did you mean TYPE?",
    ),
    (
        "(defun find-it () (perform (an action (type detecting) (object (an objekt (type bottle))))))",
        "2:57: (object …) takes an object, not a list; write (an object (type …)), or ?object for what was detected.",
    ),
    // Furniture and frames
    (
        "(defun counter () (a location (on (an object (urdf-name sink-aera-surface) (part-of kitchen)))))",
        "2:57: There is no furniture SINK-AERA-SURFACE; did you mean SINK-AREA-SURFACE?",
    ),
    (
        "(defun table () (a location (on kitchen-iland-surface)))",
        "2:33: There is no furniture KITCHEN-ILAND-SURFACE; did you mean KITCHEN-ISLAND-SURFACE?",
    ),
    (
        "(defun origin () (make-pose \"maap\" '((0 0 0) (0 0 0 1))))",
        "2:29: There is no frame \"maap\"; did you mean \"map\"?",
    ),
    (
        "(defun origin () (cl-tf:make-pose-stamped \"base_footpint\" 0.0 (cl-tf:make-identity-vector) (cl-tf:make-identity-rotation)))",
        "2:43: There is no frame \"base_footpint\"; did you mean \"base_footprint\"?",
    ),
    (
        "(defun fridge () (move-kitchen-joint :joint-name \"iai_fridge_dor_joint\" :joint-angle 0.3))",
        "2:50: There is no joint of the kitchen \"iai_fridge_dor_joint\"; did you mean \"iai_fridge_door_joint\"?",
    ),
    (
        "(defun look () (perform (an action (type looking) (direction dwon))))",
        "2:62: There is no direction DWON; did you mean DOWN?",
    ),
    (
        "(defun beside (?o) (a location (on ?o) (side lefft)))",
        "2:46: There is no side LEFFT; did you mean LEFT?",
    ),
    // Variables
    (
        "(defun drive (pose) (perform (an action (type going) (target (a location (pose pose))))))",
        "2:75: (pose …) takes a pose with a frame, not the name POSE; only variables whose names begin with a question mark are evaluated here: bind ?POSE instead of POSE.",
    ),
    (
        "(defun pick (?bottle) (perform (an action (type picking-up) (arm left) (object bottle))) ?bottle)",
        "2:80: (object …) takes an object that was detected, not the name BOTTLE; did you mean ?BOTTLE?",
    ),
    (
        "(defun pick (arm ?o) (perform (an action (type picking-up) (arm arm) (object ?o))))",
        "2:61: There is no arm ARM; only variables whose names begin with a question mark are evaluated here: bind ?ARM instead of ARM.",
    ),
    (
        "(defun pick (?bottle) (perform (an action (type picking-up) (arm left) (object ?botle))) ?bottle)",
        "2:80: The variable ?BOTLE is unbound; did you mean ?BOTTLE?",
    ),
    // Keys and their values
    (
        "(defun drive () (perform (an action (type going) (target 5))))",
        "2:51: (target …) takes a location or a pose, not the number 5; write (a location (pose ?pose)).",
    ),
    (
        "(defun drive (?p) (perform (an action (type going) (target (an object (type cup) (pose ?p))))))",
        "2:53: (target …) takes a location or a pose, not an object; write (a location (pose ?pose)).",
    ),
    (
        "(defun drive () (perform (an action (type going) (target (a location (pose (a location (on kitchen-island-surface))))))))",
        "2:71: (pose …) takes a pose with a frame, not a location; (make-pose \"map\" '((x y z) (x y z w))) makes a pose, which a variable such as ?pose holds.",
    ),
    (
        "(defun lift () (perform (a motion (type moving-torso) (joint-angle high))))",
        "2:68: (joint-angle …) takes a number, not the name HIGH; names stand for themselves in a designator, but for variables such as ?high.",
    ),
    (
        "(defun open-it () (perform (an action (type opening-gripper) (gripper 1))))",
        "2:63: (gripper …) takes a keyword, or a list of them, not the number 1.",
    ),
    (
        "(defun pick (?o) (perform (an action (type picking-up) (arm \"left\") (object ?o))))",
        "2:61: (arm …) takes a keyword, or a list of them, not the string \"left\"; names in a designator have no quotes: did you mean LEFT?",
    ),
    (
        "(defun lift () (perform (a motion (type moving-torso) (joint-angle \"0.2\"))))",
        "2:68: (joint-angle …) takes a number, not the string \"0.2\"; a number has no quotes: did you mean 0.2?",
    ),
    (
        "(defun look () (perform (an action (type 'looking) (direction down))))",
        "2:42: Nothing is quoted inside a designator; did you mean LOOKING?",
    ),
    (
        "(defun wait () (perform (an action (tpye waiting) (duration 1))))",
        "2:37: The action has no key TPYE; did you mean TYPE?",
    ),
    (
        "(defun give-up () (park-arms) (cpl:retry))",
        "2:32: (retry) has a meaning only in the handlers of with-failure-handling.",
    ),
    (
        "(defun drive (?p) (perform (an action (type gonig) (target (a location (pose ?p))))))",
        "2:45: There is no action of type GONIG; did you mean GOING?",
    ),
    (
        "(defun drive (?p) (perform (an action (type going) (traget (a location (pose ?p))))))",
        "2:53: The action GOING has no key TRAGET; did you mean TARGET?",
    ),
    (
        "(defun drive () (perform (an action (type going))))",
        "2:30: The action GOING needs (target …): where to.",
    ),
    (
        "(defun reach (?p) (perform (an action (type reaching) (left-poses ?p) (collision-mode allow-al))))",
        "2:87: (collision-mode …) takes one of avoid-all, allow-hand, allow-fingers, allow-arm, allow-attached, allow-all, not the name ALLOW-AL; did you mean ALLOW-ALL?",
    ),
    // The language
    (
        "(defun open (drawer) drawer)",
        "2:1: OPEN belongs to the locked package COMMON-LISP: to define it as a function here would change what the language and the plans mean by it.",
    ),
    (
        "(defun twice (x) (* x 2)) (defun thrice (x) (+ x (twise x)))",
        "2:51: The function TWISE is not defined; did you mean TWICE?",
    ),
    (
        "(defun twice (x) (* x 2)) (defun four () (twice 2 2))",
        "2:42: TWICE takes 1 argument, but is called with 2.",
    ),
    (
        "(defun tell (x) (format t \"~a is ~a~%\" x))",
        "2:17: The control string needs 2 arguments, but there is 1.",
    ),
    (
        "(defun tell (x y) (format t \"~a~%\" x y))",
        "2:19: The control string uses at most 1 argument, but there are 2.",
    ),
    (
        "(defun sum (x y) (+ x x))",
        "2:15: The variable Y is never used.",
    ),
    (
        "(defun wait () (loop (cpl:with-failure-handling ((cpl:plan-failure (e) (declare (ignore e)) (cpl:retry))) (park-arms) (return))))",
        "2:119: This leaves only WITH-FAILURE-HANDLING, and the LOOP around it never ends: write (block NAME (loop …)) and (return-from NAME …).",
    ),
    (
        "(defun early (x) (return-from early x) (park-arms))",
        "2:40: This is never reached: the form before it never returns.",
    ),
    (
        "(defun make () (make-instance 'standart-object))",
        "2:32: There is no class STANDART-OBJECT; did you mean STANDARD-OBJECT?",
    ),
    (
        "(defun sorted (l) (sort l #'< :kei #'first))",
        "2:31: SORT has no key :KEI; did you mean :KEY?",
    ),
    (
        "(defun going-there () (going :target 1))",
        "2:24: The function GOING is not defined; going is an action: (perform (an action (type going) …)).",
    ),
];
