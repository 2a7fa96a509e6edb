//! Kitchens of others' simulators: what stands in them is used like other furniture.

use super::cook::Cook;
use session::SessionOptions;

/// A counter with drawers and a cupboard below it, and an island that is turned to it.
const LAYOUT: &str = "
room:
  walls:
    - {name: wall, type: wall, size: [1.5, 1.5, 0.02], pos: [1.5, 0, 1.5]}
  floor:
    - {name: floor, type: floor, size: [1.5, 2, 0.02], pos: [1.5, -2, 0]}
main_group:
  row:
    - {name: counter, type: counter, size: [1.4, 0.65, 0.92], pos: [1.5, -0.325, 0.46]}
    - name: stack
      type: stack
      pos: [1.1, -0.3, 0.47]
      size: [0.6, 0.6, 0.84]
      levels: [drawer, drawer, drawer]
      percentages: [0.4, 0.35, 0.25]
    - name: cupboard
      type: stack
      align_to: stack
      side: right
      alignment: top_back
      size: [0.6, 0.6, 0.84]
      levels: [single_cabinet]
      percentages: [1]
island_group:
  group_origin: [0, 0]
  group_pos: [1.5, -3]
  group_z_rot: 3.1416
  row:
    - {name: island, type: counter, base_opening: [false, true], size: [1.4, 0.7, 0.92], pos: [0, 0, 0.46]}
";

#[test]
fn a_layout_is_a_kitchen_in_which_things_are_opened_and_carried() {
    let mut options = SessionOptions::default();
    options.set_layout("kitchen.yaml", LAYOUT).unwrap();
    let mut cook = Cook::with(&options);
    let remarks = cook.session.remarks();
    assert!(remarks.is_empty(), "{remarks:?}");
    assert_eq!(
        cook.done("(mapcar #'first (list-containers))"),
        "(:STACK-MAIN-GROUP-1-MAIN :STACK-MAIN-GROUP-2-MAIN :STACK-MAIN-GROUP-3-MAIN\n :CUPBOARD-MAIN-GROUP-1-DOOR)\n"
    );
    for container in ["stack-main-group-3-main", "cupboard-main-group-1-door"] {
        let go = |verb: &str| {
            format!(
                "(with-simulated-robot
                   (perform (an action (type {verb})
                                (location (a location (in (an object (urdf-name {container}) (part-of kitchen))))))))"
            )
        };
        let position = format!("(third (assoc :{container} (list-containers)))");
        cook.done(&go("accessing"));
        assert_eq!(
            cook.done(&format!("(> {position} 0.3)")),
            "T\n",
            "{container}"
        );
        cook.done(&go("sealing"));
        assert_eq!(
            cook.done(&format!("(< {position} 0.02)")),
            "T\n",
            "{container}"
        );
    }
    cook.done(
        "(let ((?place (a location (on (an object (urdf-name counter-main-group) (part-of kitchen))) (side front))))
           (btr-utils:spawn-object 'bottle-1 :bottle :pose (desig:reference ?place)))
         (with-simulated-robot
           (perform (an action (type transporting) (object (an object (type bottle)))
                        (target (a location (on (an object (urdf-name island-island-group) (part-of kitchen))))))))",
    );
    assert_eq!(
        cook.done("(and (on-surface-p 'bottle-1 'island-island-group) t)"),
        "T\n"
    );
}

/// A counter, and beside it a fridge with one door, 0.78 m wide, which no arm opens as far as it goes from one place to
/// stand.
const FRIDGE: &str = "
room:
  walls:
    - {name: wall, type: wall, size: [2.5, 1.5, 0.02], pos: [1.5, 0, 1.5]}
  floor:
    - {name: floor, type: floor, size: [2.5, 2, 0.02], pos: [1.5, -2, 0]}
main_group:
  row:
    - {name: counter, type: counter, size: [1.4, 0.65, 0.92], pos: [0.8, -0.325, 0.46]}
    - {name: fridge, type: fridge_bottom_freezer, align_to: counter, side: right, alignment: bottom_back}
";

#[test]
fn a_door_too_wide_for_an_arm_is_opened_in_part_for_what_is_behind_it() {
    let mut options = SessionOptions::default();
    options.set_layout("kitchen.yaml", FRIDGE).unwrap();
    let mut cook = Cook::with(&options);
    cook.done(
        "(defun in-fridge ()
           (a location (in (an object (urdf-name fridge-main-group-main) (part-of kitchen)))
                       (for (an object (type milk))) (side front)))
         (defun opening ()
           (third (assoc :fridge-main-group-main-door (list-containers))))
         (btr-utils:spawn-object 'milk-1 :milk :pose (desig:reference (in-fridge)))",
    );
    // Somebody who wants it open gets it open, or the reason why not.
    let refused = cook.fails(
        "ENVIRONMENT-MANIPULATION-IMPOSSIBLE",
        "(let ((?place (in-fridge))) (perform (an action (type accessing) (location ?place))))",
    );
    assert!(
        refused.starts_with("fridge-main-group-main-door cannot be brought from 0.000 to 1.571"),
        "{refused}"
    );
    assert_eq!(cook.done("(opening)"), "0.0d0\n");
    // Who wants what is behind it gets that.
    cook.done(
        "(defparameter *widest* 0)
         (with-simulated-robot
           (let ((?place (in-fridge))
                 (?counter (a location (on (an object (urdf-name counter-main-group) (part-of kitchen))))))
             (cpl:pursue
               (loop (cpl:sleep 0.5) (setf *widest* (max *widest* (opening))))
               (perform (an action (type transporting)
                            (object (an object (type milk) (location ?place)))
                            (target ?counter))))))",
    );
    assert_eq!(
        cook.done("(list (and (on-surface-p 'milk-1 'counter-main-group) t) (< 0.7 *widest* 1.3) (< (opening) 0.02))"),
        "(T T T)\n"
    );
}

#[test]
fn what_is_wrong_with_a_layout_is_told_with_file_and_line() {
    let mut options = SessionOptions::default();
    let wrong = LAYOUT.replace("align_to: stack", "align_to: stak");
    let error = options.set_layout("kitchen.yaml", &wrong).unwrap_err();
    assert_eq!(
        error.to_string(),
        "kitchen.yaml: line 18: there is no stak before this in main_group; did you mean stack?"
    );
    assert!(options.world.is_none());
}
