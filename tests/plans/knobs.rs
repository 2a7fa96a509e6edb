//! Turning knobs: by a hand that grips them, and what is refused before anything moves.

use super::cook::Cook;

/// What a text prints, or the report of what ended it.
fn said(cook: &mut Cook, text: &str) -> String {
    cook.say(text).unwrap_or_else(|(report, _)| report)
}

const STOVE: &str = "oven_area_oven_knob_stove_2";

/// What turning the second knob of the stove comes to, with further keys.
fn turning(cook: &mut Cook, keys: &str) -> String {
    cook.done(&format!(
        "(with-simulated-robot (perform (an action (type turning-knob) (frame \"{STOVE}\") {keys})))"
    ))
}

fn angle(cook: &Cook) -> f64 {
    let world = cook.session.simulation().world();
    world.kitchen_joint(&format!("{STOVE}_joint")).unwrap()
}

#[test]
fn a_hand_turns_a_knob_on_and_off_and_goes_on_the_way_that_the_hand_turns() {
    let mut cook = Cook::new();
    assert_eq!(angle(&cook), 0.0);
    let said = turning(&mut cook, "(configuration on)");
    assert!(
        said.trim().ends_with("(:ON 1.5707963267948966d0)"),
        "{said}"
    );
    assert!(
        (angle(&cook) - std::f64::consts::FRAC_PI_2).abs() < 1e-3,
        "{}",
        angle(&cook)
    );
    // What is on already is left so.
    let before = cook.session.simulation().world().steps();
    turning(&mut cook, "(configuration on)");
    assert_eq!(cook.session.simulation().world().steps(), before);
    turning(&mut cook, "(angle 3) (arm left)");
    assert!((angle(&cook) - 3.0).abs() < 1e-3, "{}", angle(&cook));
    turning(&mut cook, "(configuration off) (arm right)");
    assert!(angle(&cook).abs() < 1e-3, "{}", angle(&cook));
    let said = cook.done("(knob-state :oven-area-oven-knob-stove-2)");
    assert!(said.contains(":OFF"), "{said}");
}

#[test]
fn the_joint_stays_where_it_is_if_the_fingers_press_too_little() {
    let mut cook = Cook::new();
    cook.done("(setf pp-plans::*handle-effort* 4)");
    let said = said(
        &mut cook,
        &format!(
            "(with-simulated-robot (perform (an action (type turning-knob) (frame \"{STOVE}\") (configuration on))))"
        ),
    );
    assert!(said.contains("could not be turned"), "{said}");
    assert!(angle(&cook).abs() < 0.02, "{}", angle(&cook));
}

#[test]
fn what_cannot_be_turned_is_refused_before_anything_moves() {
    let mut cook = Cook::new();
    let before = cook.session.simulation().world().steps();
    for (action, wanted) in [
        (
            "(frame \"oven_area_oven_knob_stove_9\") (configuration on)",
            "did you mean",
        ),
        (
            "(frame \"oven_area_oven_door\") (configuration on)",
            "is no knob",
        ),
        (
            "(frame \"oven_area_oven_knob_oven\") (angle 4)",
            "its angle is between 0.00 and 3.14 rad",
        ),
        (
            "(frame \"oven_area_oven_knob_oven\") (angle 1) (configuration on)",
            "not both",
        ),
        (
            "(object (an object (type knob))) (configuration on)",
            "does not say which knob it is",
        ),
    ] {
        let said = said(
            &mut cook,
            &format!("(with-simulated-robot (perform (an action (type turning-knob) {action})))"),
        );
        assert!(said.contains(wanted), "{action}: {said}");
        assert_eq!(
            cook.session.simulation().world().steps(),
            before,
            "{action}"
        );
    }
    let said = said(
        &mut cook,
        "(with-simulated-robot (perform (an action (type opening) (arm left)
           (object (an object (type drawer) (urdf-name oven-area-oven-knob-oven))))))",
    );
    assert!(
        said.contains("it is a knob, which (an action (type turning-knob)"),
        "{said}"
    );
}
