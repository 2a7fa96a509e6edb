//! Occasions: what holds in the world, as queries and as goals of actions.

use super::cook::Cook;

/// What an occasion's bindings are.
fn holds(cook: &mut Cook, occasion: &str) -> String {
    value(cook, &format!("(coe:holds `{occasion})"))
}

/// The value of a text.
fn value(cook: &mut Cook, text: &str) -> String {
    cook.done(text).trim().to_owned()
}

#[test]
fn what_is_in_a_hand_is_bound_to_variables() {
    let mut cook = Cook::at_table_with_bottle();
    assert_eq!(holds(&mut cook, "(cpoe:object-in-hand bottle-1)"), "NIL");
    cook.take_bottle();
    for (occasion, wanted) in [
        ("(cpoe:object-in-hand bottle-1)", "(NIL)"),
        ("(cpoe:object-in-hand :bottle-1 :right)", "(NIL)"),
        ("(cpoe:object-in-hand bottle-1 :left-or-right)", "(NIL)"),
        ("(cpoe:object-in-hand bottle-1 :left)", "NIL"),
        ("(cpoe:object-in-hand cup-1)", "NIL"),
        (
            "(cpoe:object-in-hand bottle-1 ?hand)",
            "(((?HAND . :RIGHT)))",
        ),
    ] {
        assert_eq!(holds(&mut cook, occasion), wanted, "{occasion}");
    }
    let object = value(
        &mut cook,
        "(desig:desig-prop-value
           (cut:var-value '?what (cut:lazy-car (coe:holds '(cpoe:object-in-hand ?what)))) :type)",
    );
    assert_eq!(object, ":BOTTLE", "it is what was perceived last");
    assert_eq!(
        value(&mut cook, "(prolog '(man-int:robot-free-hand :pr2 ?arm))"),
        "(((?ARM . :LEFT)))"
    );
}

#[test]
fn an_object_is_at_a_location_within_a_tolerance_unless_a_hand_holds_it() {
    let mut cook = Cook::at_table_with_bottle();
    let at = "(let* ((?pose (btr-utils:object-pose 'bottle-1))
                     (?near (cl-tf:make-pose-stamped \"map\" 0.0
                              (cl-tf:v+ (cl-tf:origin ?pose) (cl-tf:make-3d-vector 0.04 0 0))
                              (cl-tf:make-identity-rotation)))
                     (?here (a location (pose ?near))))
                (list (coe:holds `(cpoe:object-at-location bottle-1 ,?here))
                      (coe:holds `(cpoe:object-placed bottle-1 ,?here 0.03))
                      (coe:holds `(cpoe:object-at-location no-such-thing ,?here))))";
    assert_eq!(value(&mut cook, at), "((NIL) NIL NIL)");
    cook.take_bottle();
    assert_eq!(value(&mut cook, at), "(NIL NIL NIL)");
}

#[test]
fn the_robot_is_asked_for_its_posture() {
    let mut cook = Cook::at_table_with_bottle();
    cook.done(
        "(with-simulated-robot
           (park-arms)
           (perform (a motion (type moving-torso) (joint-angle 0.33)))
           (perform (an action (type opening) (gripper left)))
           (perform (an action (type looking) (direction forward))))",
    );
    for (occasion, wanted) in [
        ("(cpoe:torso-at :upper-limit)", true),
        ("(cpoe:torso-at 0.3)", false),
        ("(cpoe:torso-at 0.3 0.1)", true),
        ("(cpoe:arms-positioned-at :carry :carry)", true),
        ("(cpoe:arms-positioned-at nil :tucked)", false),
        ("(cpoe:gripper-opened :left)", true),
        ("(cpoe:gripper-opened (:left :right))", false),
        ("(cpoe:gripper-joint-at :left 0.0)", false),
        ("(cpoe:looking-at :forward)", true),
        ("(cpoe:looking-at bottle-1)", false),
    ] {
        let said = holds(&mut cook, occasion);
        assert_eq!(said, if wanted { "(NIL)" } else { "NIL" }, "{occasion}");
    }
}

#[test]
fn an_occasion_that_there_is_not_is_an_error_that_names_those_there_are() {
    let mut cook = Cook::at_table_with_bottle();
    let (said, _) = cook.say("(coe:holds '(object-in-hnd ?x))").unwrap_err();
    assert!(
        said.contains("There is no occasion OBJECT-IN-HND"),
        "{said}"
    );
    assert!(said.contains("object-in-hand"), "{said}");
    let perceived = "(coe:on-event (make-instance 'cpoe:object-perceived-event))";
    let (said, _) = cook.say(perceived).unwrap_err();
    assert!(
        said.contains("OBJECT-PERCEIVED-EVENT requires object-designator"),
        "{said}"
    );
}

#[test]
fn a_goal_that_holds_takes_no_motion() {
    let mut cook = Cook::at_table_with_bottle();
    for action in [
        "(an action (type moving-torso) (joint-angle 0.2) (goal (cpoe:torso-at 0.2)))",
        "(an action (type setting-gripper) (gripper left) (position 0.05)
            (goal (cpoe:gripper-joint-at :left 0.05)))",
        "(an action (type opening) (gripper left) (goal (cpoe:gripper-opened :left)))",
        "(an action (type looking) (direction forward) (goal (cpoe:looking-at :forward)))",
        "(an action (type parking-arms) (goal (cpoe:arms-positioned-at :carry :carry)))",
    ] {
        let timed = format!(
            "(let ((before (roslisp::ros-time)))
               (with-simulated-robot (perform {action}))
               (> (- (roslisp::ros-time) before) 0.01))"
        );
        cook.done(&timed);
        let said = value(&mut cook, &timed);
        assert!(said.contains("holds already.\nNIL"), "{action}: {said}");
    }
}
