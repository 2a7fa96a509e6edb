//! Things that stand on things: found, fetched, and not thrown down.

use super::cook::Cook;

/// A plate on the island with a cup on it.
fn cup_on_plate() -> Cook {
    let mut cook = Cook::watched();
    cook.done(
        "(btr-utils:spawn-object 'plate-1 :plate :pose '((-0.85 1.5 0.867) (0 0 0 1)))
         (btr-utils:spawn-object 'cup-1 :cup :pose '((-0.85 1.5 0.911) (0 0 0 1)))
         (defun bring (?type ?target)
           (perform (an action (type transporting)
                        (object (an object (type ?type)))
                        (location (a location (on (an object (urdf-name kitchen-island-surface)
                                                             (part-of kitchen)))))
                        (target ?target))))
         (defun on-table ()
           (a location (on (an object (urdf-name table-area-main) (part-of kitchen)))))",
    );
    cook
}

#[test]
fn what_stands_on_a_plate_stands_on_what_carries_the_plate() {
    let mut cook = cup_on_plate();
    let said = cook.done(
        "(list (pp-plans::support-of 'cup-1) (pp-plans::support-of 'plate-1)
                      (pp-plans::carriers-of 'cup-1)
                      (pw:on-surface-p 'cup-1 :kitchen-island-surface)
                      (pw:on-surface-p 'cup-1 'plate-1)
                      (pw:on-surface-p 'plate-1 'cup-1)
                      (coe::riders 'plate-1))",
    );
    let said: String = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(
        said,
        "(\"PLATE-1\" \"kitchen_island_surface\" (\"PLATE-1\" \"kitchen_island_surface\") T T NIL (CUP-1))"
    );
}

#[test]
fn a_cup_on_a_plate_is_found_on_the_island_and_brought_to_the_table() {
    let mut cook = cup_on_plate();
    let plate = cook.pose("PLATE-1");
    cook.done("(with-simulated-robot (bring :cup (on-table)))");
    assert_eq!(
        cook.done("(pp-plans::support-of 'cup-1)"),
        "\"table_area_main\"\n"
    );
    assert!(cook.distance("PLATE-1", &plate) < 0.01);
    cook.assert_no_overlap();
}

#[test]
fn a_plate_with_a_cup_on_it_is_refused_before_it_is_touched() {
    let mut cook = cup_on_plate();
    let (plate, cup) = (cook.pose("PLATE-1"), cook.pose("CUP-1"));
    let report = cook.fails("FETCHING-FAILED", "(bring :plate (on-table))");
    assert_eq!(
        report,
        "PLATE-1 carries CUP-1, which would fall: take it away first."
    );
    let report = cook.fails(
        "MANIPULATION-GOAL-NOT-REACHED",
        "(let ((?plate (perform (an action (type searching) (object (an object (type plate)))))))
           (perform (an action (type picking-up) (object ?plate) (arm left) (grasp top))))",
    );
    assert!(report.starts_with("PLATE-1 carries CUP-1"), "{report}");
    assert!(cook.distance("PLATE-1", &plate) < 0.003);
    assert!(cook.distance("CUP-1", &cup) < 0.003);
}

#[test]
fn a_target_in_the_air_is_refused_before_anything_is_fetched() {
    let mut cook = cup_on_plate();
    let cup = cook.pose("CUP-1");
    let report = cook.fails(
        "DELIVERING-FAILED",
        "(let ((?pose (make-pose \"map\" '((-1.4 -0.85 0.95) (0 0 0 1)))))
           (bring :cup (a location (pose ?pose))))",
    );
    assert!(
        report.starts_with(
            "cup-1 could not be delivered: nothing carries it at its target, table_area_main is 0.19 m below: it would stand \
             there at z 0.7"
        ),
        "{report}"
    );
    assert!(cook.distance("CUP-1", &cup) < 0.003);
}

#[test]
fn a_heavy_tray_that_is_held_by_its_rim_is_more_than_the_pads_transmit() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'tray-1 :tray :pose '((-1.5 -0.85 0.74) (0 0 0 1)) :mass 1.7)",
    );
    let before = cook.pose("TRAY-1");
    let report = cook.fails(
        "FETCHING-FAILED",
        "(perform (an action (type fetching)
                      (object (an object (type tray)
                                 (location (a location (on (an object (urdf-name table-area-main)
                                                                      (part-of kitchen)))))))))",
    );
    assert!(report.contains("tray-1 could not be fetched"), "{report}");
    let account = cook.done("(explain)");
    assert!(
        account.contains("with TRAY-1 too heavy for the fingers by any grasp"),
        "{account}"
    );
    assert!(cook.lean("TRAY-1") < 3.0);
    assert!((cook.pose("TRAY-1").translation.z - before.translation.z).abs() < 0.02);
}

#[test]
fn a_drawer_is_not_moved_through_what_stands_in_it_nor_a_door_through_the_robot() {
    let mut cook = Cook::watched();
    let joint = "sink_area_left_upper_drawer_main_joint";
    cook.done(&format!(
        "(move-kitchen-joint :joint-name \"{joint}\" :joint-angle 0.45)
         (btr-utils:spawn-object 'bottle-1 :bottle :pose '((1.2 0.9 0.84) (0 0 0 1)))"
    ));
    let bottle = cook.pose("BOTTLE-1");
    let report = cook.fails(
        "SIMPLE-ERROR",
        &format!("(move-kitchen-joint :joint-name \"{joint}\" :joint-angle 0.0)"),
    );
    assert!(
        report.contains("BOTTLE-1 and sink_area_surface would be in each other"),
        "{report}"
    );
    assert!(cook.distance("BOTTLE-1", &bottle) < 0.001);
    cook.done("(init-projection) (btr-utils:move-robot '((0.75 -0.9 0) (0 0 0 1)))");
    let report = cook.fails(
        "SIMPLE-ERROR",
        "(move-kitchen-joint :joint-name \"iai_fridge_door_joint\" :joint-angle 1.2)",
    );
    assert!(report.contains("iai_fridge_door_handle"), "{report}");
    cook.assert_no_overlap();
}

/// It sticks out over two sides of the box, and its weight acts over it.
#[test]
fn a_bowl_finds_a_place_on_a_standing_cereal_box() {
    let mut cook = Cook::new();
    cook.done(
        "(btr-utils:spawn-object 'box-1 :cereal-box :pose '((-0.85 1.5 1.01) (0 0 0 1)))
         (defparameter *place*
           (desig:reference (a location (on (an object (type cereal-box) (name box-1)))
                                        (for (an object (type bowl))))))
         (btr-utils:spawn-object 'bowl-1 :bowl :pose *place*)",
    );
    let stood = cook.pose("BOWL-1");
    cook.done("(with-simulated-robot (cpl:sleep 2))");
    assert_eq!(cook.done("(pp-plans::support-of 'bowl-1)"), "\"BOX-1\"\n");
    assert!(cook.distance("BOWL-1", &stood) < 0.002 && cook.lean("BOWL-1") < 1.0);
    // Nothing stands on so small a thing.
    let report = cook.fails(
        "DESIGNATOR-ERROR",
        "(btr-utils:spawn-object 'pen :visualization-box :pose '((-1.4 -0.85 0.78) (0 0 0 1)))
         (desig:reference (a location (on (an object (type visualization-box) (name pen)))
                                      (for (an object (type pot)))))",
    );
    assert!(report.contains("leaves nothing of PEN"), "{report}");
}
