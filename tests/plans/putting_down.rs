//! Where things end that the robot puts down: on something, or in its hand.

use super::cook::Cook;

/// The robot in front of the island, with the bottle in its right hand.
fn at_island() -> Cook {
    let mut cook = Cook::watched_at_table_with_bottle();
    cook.take_bottle();
    cook.done("(with-simulated-robot (go-to *place-at-island*))");
    cook
}

fn place(x: f64, y: f64, z: f64) -> String {
    format!(
        "(let ((?spot (make-pose \"map\" '(({x} {y} {z}) (0 0 0 1)))))
           (perform (an action (type placing) (arm right) (target (a location (pose ?spot))))))"
    )
}

#[test]
fn beside_the_island_the_hand_keeps_what_it_holds() {
    let mut cook = at_island();
    let report = cook.fails("MANIPULATION-GOAL-NOT-REACHED", &place(-0.55, 2.0, 0.96));
    assert!(
        report.starts_with("nothing carries BOTTLE-1 at (-0.550 2.000 0.960) or within 5 cm")
            && report.contains(" cm below"),
        "{report}"
    );
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
    assert!(cook.pose("BOTTLE-1").translation.z > 0.8);
}

#[test]
fn far_above_the_island_the_hand_keeps_what_it_holds() {
    let mut cook = at_island();
    let report = cook.fails("MANIPULATION-GOAL-NOT-REACHED", &place(-0.8, 2.0, 1.1));
    assert!(report.contains("kitchen_island_surface is 13."), "{report}");
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
}

#[test]
fn a_bottle_is_not_put_down_where_more_than_half_of_it_is_over_the_edge() {
    let mut cook = at_island();
    let report = cook.fails("MANIPULATION-GOAL-NOT-REACHED", &place(-0.655, 2.0, 0.96));
    assert!(
        report.starts_with("BOTTLE-1 would not stand at"),
        "{report}"
    );
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
    // Less than half of it may be.
    cook.done(&format!(
        "(with-simulated-robot {})",
        place(-0.69, 2.0, 0.96)
    ));
    assert!(cook.lean("BOTTLE-1") < 3.0);
    assert_eq!(cook.in_right_hand(), "NIL");
}

#[test]
fn heights_that_are_given_roughly_are_met_by_what_is_there() {
    for z in [0.90, 0.96, 1.0] {
        let mut cook = at_island();
        cook.done(&format!("(with-simulated-robot {})", place(-0.8, 2.0, z)));
        let t = cook.pose("BOTTLE-1").translation;
        assert!((t.x + 0.8).hypot(t.y - 2.0) < 0.02, "{t}");
        assert!(cook.lean("BOTTLE-1") < 3.0);
        cook.assert_no_overlap();
    }
}

#[test]
fn a_round_object_that_is_put_down_with_another_heading_is_logged() {
    let mut cook = at_island();
    let said = cook.done(&format!(
        "(with-simulated-robot {})",
        place(-0.8, 2.0, 0.96)
    ));
    let turned = spatial::pose::yaw(&cook.pose("BOTTLE-1")).to_degrees();
    let line = said.lines().find(|line| line.contains("is round"));
    match line {
        Some(line) => assert!(
            line.contains(&format!("{turned:.0} degrees")),
            "{line} {turned}"
        ),
        None => assert!(
            turned.abs() < 3.0,
            "turned by {turned} degrees without a word"
        ),
    }
}

/// Hands used to open as far as they go, which takes 4 cm on both sides.
#[test]
fn a_spoon_is_put_down_closer_to_a_bowl_than_a_wide_open_hand_would_fit() {
    let mut cook = Cook::watched();
    cook.done(
        "(init-projection)
         (btr-utils:spawn-object 'bowl-1 :bowl :pose '((-0.9 1.5 0.9) (0 0 0 1)))
         (btr-utils:spawn-object 'spoon-1 :spoon :pose '((1.4 0.6 0.87) (0 0 0 1)))",
    );
    let bowl = cook.pose("BOWL-1");
    cook.done(
        "(with-simulated-robot
           (let ((?pose (make-pose \"map\" '((-0.9 1.66 0.865) (0 0 0 1))))
                 (?counter (an object (urdf-name sink-area-surface) (part-of kitchen))))
             (perform (an action (type transporting)
                          (object (an object (type spoon) (name spoon-1)))
                          (location (a location (on ?counter)))
                          (target (a location (pose ?pose)))))))",
    );
    let t = cook.pose("SPOON-1").translation;
    assert!((t.x + 0.9).hypot(t.y - 1.66) < 0.02, "{t}");
    assert!(cook.distance("BOWL-1", &bowl) < 0.001);
    assert_eq!(
        cook.done("(every (lambda (arm) (< (rob-int::hand-opening arm) 0.06)) '(:left :right))"),
        "T\n"
    );
    cook.assert_no_overlap();
}
