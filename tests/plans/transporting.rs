//! Fetching, delivering and transporting objects.

use super::cook::Cook;

const PLACES: &str = "
    (defun pose (x y z)
      (make-pose \"map\" `((,x ,y ,z) (0 0 0 1))))
    (defun transport (?object ?target &optional ?location)
      (with-simulated-robot
        (perform (an action (type transporting)
                     (object ?object)
                     (desig:when ?location (location (a location (pose ?location))))
                     (target (a location (pose ?target)))))))
    (defparameter *on-the-island* (pose -0.8 1.6 0.97))
    (defparameter *on-the-counter* (pose 1.45 0.7 0.96))";

/// A kitchen with a bottle on the counter.
fn cook() -> Cook {
    with_bottle_on_counter(Cook::new())
}

fn with_bottle_on_counter(mut cook: Cook) -> Cook {
    cook.done(PLACES);
    cook.done("(btr-utils:spawn-object 'bottle-1 :bottle :pose '((1.45 0.7 0.96) (0 0 0 1)))");
    cook
}

#[test]
fn a_bottle_is_transported_and_not_again() {
    let mut cook = with_bottle_on_counter(Cook::watched());
    cook.done("(defparameter *bottle* (an object (type bottle)))");
    let transport = "(transport *bottle* *on-the-island* *on-the-counter*)";
    let said = cook.done(transport);
    for line in ["Found bottle-1.", "Fetched bottle-1."] {
        assert!(said.contains(line), "{said}");
    }
    assert!(!said.contains("WARN"), "{said}");
    let at = "(cut:lazy-car (coe:holds `(cpoe:object-at-location
                ,*bottle* ,(let ((?there *on-the-island*)) (a location (pose ?there))) 0.05)))";
    assert_eq!(
        cook.done(&format!("(coe:holds `(cpoe:object-in-hand bottle-1)) {at}")),
        "NIL\nNIL\n"
    );
    assert!((cook.pose("BOTTLE-1").translation.y - 1.6).abs() < 0.02);
    let before = cook.session.simulation().now();
    let said = cook.done(transport);
    assert!(said.contains("bottle-1 is at its target already"), "{said}");
    assert_eq!(cook.session.simulation().now(), before, "no motion");
    cook.assert_no_overlap();
}

#[test]
fn a_bowl_that_somebody_has_taken_out_of_its_drawer_is_brought_to_its_place() {
    let mut cook = Cook::watched();
    cook.done("(btr-utils:spawn-object 'bowl-1 :bowl :pose '((-1.5 -0.85 0.79) (0 0 0 1)))");
    let said = cook.done(
        "(with-simulated-robot
           (perform (an action (type transporting) (object (an object (type bowl)))
                        (context table-setting))))",
    );
    // It is looked for where it belongs first.
    assert!(said.contains("drawer"), "{said}");
    // The table is set on the island.
    let bowl = cook.pose("BOWL-1").translation;
    assert!((bowl.x - -0.9).abs() < 0.3 && bowl.y > 1.0, "{bowl}");
    cook.assert_no_overlap();
}

/// A world that is saved after fetching becomes the same one by delivering, each time, and saving it
/// makes no difference.
#[test]
fn a_world_saved_in_the_middle_ends_as_without_that() {
    let fetch = "(defparameter *found* (with-simulated-robot
          (let ((?place *on-the-counter*))
            (perform (an action (type searching) (object (an object (type bottle)))
                         (location (a location (pose ?place))))))))
        (defun fetch (?object)
          (with-simulated-robot (perform (an action (type fetching) (object ?object)))))
        (defun deliver (?object ?target)
          (with-simulated-robot
            (perform (an action (type delivering) (object ?object)
                         (target (a location (pose ?target)))))))
        (fetch *found*)";
    let deliver = "(deliver *found* *on-the-island*)";
    let mut plain = cook();
    plain.done(fetch);
    plain.done(deliver);
    let mut saving = cook();
    saving.done(fetch);
    saving.done("(pw:snapshot 'middle)");
    let middle = saving.session.world_hash();
    saving.done(deliver);
    let end = saving.session.world_hash();
    assert_eq!(plain.session.world_hash(), end, "saving is no change");
    assert_ne!(middle, end);
    saving.done("(pw:restore 'middle)");
    assert_eq!(saving.session.world_hash(), middle);
    saving.done(deliver);
    assert_eq!(saving.session.world_hash(), end, "delivered once more");
}

#[test]
fn a_second_object_of_the_same_description_is_another_one() {
    let mut cook = cook();
    cook.done(
        "(btr-utils:spawn-object 'bottle-2 :bottle :pose '((1.45 1.0 0.96) (0 0 0 1)))
         (loop for at in (list *on-the-counter* (pose 1.45 1.0 0.96))
               for to in (list *on-the-island* (pose -0.8 1.2 0.96))
               do (transport (an object (type bottle)) to at))",
    );
    for (name, y) in [("BOTTLE-1", 1.6), ("BOTTLE-2", 1.2)] {
        assert!((cook.pose(name).translation.y - y).abs() < 0.05, "{name}");
        assert!(cook.pose(name).translation.x < -0.5, "{name}");
    }
}

#[test]
fn nothing_is_fetched_with_full_hands() {
    let mut cook = cook();
    cook.done(
        "(btr-utils:spawn-object 'bottle-2 :bottle :pose '((1.45 1.0 0.96) (0 0 0 1)))
         (btr-utils:spawn-object 'bottle-3 :bottle :pose '((1.45 0.35 0.96) (0 0 0 1)))
         (defun fetch (at &optional (?arms '(:right :left)))
           (with-simulated-robot
             (let ((?object (an object (type bottle)))
                   (?at at))
               (perform (an action (type searching) (object ?object)
                            (location (a location (pose ?at)))))
               (perform (an action (type fetching) (object ?object) (arms ?arms))))))
         (fetch *on-the-counter* :left)
         (fetch (pose 1.45 0.35 0.96) :right)",
    );
    let before = cook.done("(roslisp::ros-time)");
    let report = cook.fails(
        "FETCHING-FAILED",
        "(let ((?object (an object (type bottle) (name bottle-2))))
           (perform (an action (type fetching) (object ?object))))",
    );
    assert_eq!(
        report,
        "bottle-2 cannot be fetched: the right hand holds bottle-3, the left hand holds bottle-1."
    );
    assert_eq!(cook.done("(roslisp::ros-time)"), before, "no motion");
}

#[test]
fn what_no_hand_holds_cannot_be_delivered() {
    let report = cook().fails(
        "DELIVERING-FAILED",
        "(let ((?object (an object (type bottle) (name bottle-1)))
               (?there *on-the-island*))
           (perform (an action (type delivering) (object ?object)
                        (target (a location (pose ?there))))))",
    );
    assert_eq!(report, "No hand holds bottle-1.");
}

#[test]
fn what_cannot_be_delivered_is_put_back() {
    let mut cook = cook();
    let (report, condition) = cook
        .say("(transport (an object (type bottle)) (pose -0.8 1.6 2.5) *on-the-counter*)")
        .unwrap_err();
    assert!(condition.contains("DELIVERING-FAILED"), "{condition}");
    assert!(
        report.starts_with("bottle-1 could not be delivered"),
        "{report}"
    );
    let back = cook.pose("BOTTLE-1").translation;
    assert!(
        (back.x - 1.45).abs() < 0.05 && (back.y - 0.7).abs() < 0.05,
        "{back}"
    );
    assert_eq!(cook.done("(pp-plans::objects-in-hand :right)"), "NIL\n");
    let told = cook.done("(explain)");
    assert!(told.contains("bottle-1 could not be delivered"), "{told}");
}

/// Nobody knows where it was taken from.
#[test]
fn what_was_held_before_stays_in_the_hand_if_it_cannot_be_delivered() {
    let mut cook = cook();
    cook.done(
        "(with-simulated-robot
           (let ((?object (an object (type bottle)))
                 (?at *on-the-counter*))
             (perform (an action (type searching) (object ?object)
                          (location (a location (pose ?at)))))
             (perform (an action (type fetching) (object ?object)))))",
    );
    let report = cook.fails(
        "DELIVERING-FAILED",
        "(let* ((?object (an object (type bottle) (name bottle-1)))
                (?there (pose -0.8 1.6 2.5))
                (?target (a location (pose ?there))))
           (perform (an action (type transporting) (object ?object) (target ?target))))",
    );
    assert!(
        report.starts_with("bottle-1 could not be delivered"),
        "{report}"
    );
    assert_eq!(cook.in_right_hand(), "(BOTTLE-1)");
}

#[test]
fn a_goal_of_the_users_own_skips_the_action() {
    let mut cook = cook();
    let before = cook.done("(roslisp::ros-time)");
    let said = cook.done(
        "(with-simulated-robot
           (let* ((?object (an object (type bottle) (name bottle-1)))
                  (?there *on-the-counter*)
                  (?target (a location (pose ?there))))
             (perform (an action (type delivering) (object ?object) (target ?target)
                          (goal (cpoe:object-at-location ?object ?target))))))",
    );
    assert!(said.contains("(PERFORM GOAL) INFO"), "{said}");
    assert_eq!(cook.done("(roslisp::ros-time)"), before);
}

#[test]
fn a_target_that_is_not_there_is_refused_before_anything_moves() {
    let mut cook = cook();
    let before = cook.done("(roslisp::ros-time)");
    let (report, _) = cook
        .say(
            "(with-simulated-robot
               (perform (an action (type transporting) (object (an object (type bottle)))
                            (target (a location (on (an object (urdf-name kitchen-iland-surface)
                                                               (part-of kitchen))))))))",
        )
        .unwrap_err();
    assert!(
        report.contains("did you mean kitchen-island-surface?"),
        "{report}"
    );
    assert_eq!(cook.done("(roslisp::ros-time)"), before, "no motion");
}

#[test]
fn a_neighbour_that_is_pushed_while_fetching_makes_it_fail() {
    let mut cook = cook();
    // As if the hand had pushed it: what fetching does then is seen by the same comparison.
    cook.done(
        "(btr-utils:spawn-object 'cup-1 :cup :pose '((1.45 0.3 0.9) (0 0 0 1)))
         (defun push-the-cup (event)
           (declare (ignore event))
           (btr-utils:move-object 'cup-1 (pose 1.45 0.25 0.9)))
         (defmethod coe:on-event :after ((event cpoe:object-attached-robot))
           (push-the-cup event))",
    );
    let report = cook.fails(
        "FETCHING-FAILED",
        "(let ((?object (an object (type bottle)))
               (?at *on-the-counter*))
           (perform (an action (type searching) (object ?object)
                        (location (a location (pose ?at)))))
           (perform (an action (type fetching) (object ?object))))",
    );
    assert!(report.contains("hand, but fetching it"), "{report}");
    assert!(report.contains("CUP-1"), "{report}");
}

#[test]
fn a_place_at_which_something_stands_can_be_looked_at() {
    let said = cook().done(
        "(let* ((?at (pose 1.45 0.7 0.96))
                (?there (a location (pose ?at))))
           (reference (a location (visible-for pr2) (location ?there))))",
    );
    assert!(said.contains("map"), "{said}");
}

#[test]
fn a_bottle_is_put_down_although_its_target_is_just_inside_of_the_surface() {
    let mut cook = cook();
    for height in [0.9590, 0.9600, 0.9608, 0.9650, 0.9800] {
        cook.done(&format!(
            "(init-projection)
             (btr-utils:spawn-object 'bottle-1 :bottle :pose '((1.45 0.7 0.96) (0 0 0 1)))
             (transport (an object (type bottle)) (pose -0.8 1.6 {height}) *on-the-counter*)"
        ));
        let t = cook.pose("BOTTLE-1").translation;
        assert!((t.x + 0.8).hypot(t.y - 1.6) < 0.02, "{height}: {t}");
    }
}

#[test]
fn a_plate_is_grasped_from_where_it_can_be_so_that_it_can_also_be_put_down() {
    let mut cook = Cook::new();
    cook.done("(spawn-object '((-1.013 -1.342 0.8) (0 0 -0.15389 0.98809)) :plate 'plate-1)");
    // By the side that is nearest, it could be put down at the edge of the island only.
    cook.done(
        "(with-simulated-robot
           (perform (an action (type transporting)
                      (object (an object (type plate)))
                      (location (a location (on (an object (urdf-name table-area-main)
                                                           (part-of kitchen)))))
                      (target (a location (on (an object (urdf-name kitchen-island-surface)
                                                         (part-of kitchen)))
                                          (for (an object (type plate))))))))",
    );
    assert!(cook.pose("PLATE-1").translation.z > 0.85);
}

#[test]
fn a_mug_that_only_its_rim_can_be_taken_by_is_not_pressed_down() {
    let mut cook = Cook::new();
    cook.done("(spawn-object '((1.6526 1.2023 0.9116) (0 0 0.98696 0.16099)) :mug 'mug-1)");
    let said = cook.done(&from_the_counter("mug"));
    assert!(!said.contains("pressed"), "{said}");
    assert!(cook.pose("MUG-1").translation.x < -0.6, "{said}");
}

#[test]
fn a_mug_in_the_corner_is_fetched_from_one_of_the_few_places_that_let_an_arm_reach_it() {
    let mut cook = Cook::new();
    cook.done("(spawn-object '((1.7477 0.8731 0.9116) (0 0 0.67312 -0.73953)) :mug 'mug-1)");
    let said = cook.done(&from_the_counter("mug"));
    assert!(cook.pose("MUG-1").translation.x < -0.6, "{said}");
}

#[test]
fn what_can_be_reached_only_from_where_it_is_out_of_sight_is_fetched() {
    let mut cook = Cook::new();
    cook.done(
        "(spawn-object '((1.6526 1.2023 0.97) (0 0 0.98696 0.16099)) :bottle 'bottle-1)
         (loop for (x y) in '((0.775 0.925) (0.925 1.075) (0.925 0.775) (0.625 1.075)
                              (0.625 0.775) (0.95 0.5) (0.7 0.5) (0.95 0.25) (0.7 0.25))
               for number from 1
               do (spawn-object (list (list x y 0.1019) '(0 0 0 1)) :breakfast-cereal
                                (intern (format nil \"BOX-~a\" number))))",
    );
    let said = cook.done(&from_the_counter("bottle"));
    assert!(said.contains("candidates were rejected"), "{said}");
    assert!(cook.pose("BOTTLE-1").translation.x < -0.6, "{said}");
}

#[test]
fn a_cup_in_the_corner_is_fetched_from_beside_what_stands_in_the_best_places() {
    let mut cook = Cook::new();
    cook.done(
        "(spawn-object '((1.6523 1.2023 0.97) (0 0 0.98696 0.16099)) :cup 'cup-1)
         (loop for (x y) in '((0.725 1.075) (0.875 1.225) (0.875 0.925) (0.575 1.225) (0.575 0.925))
               for number from 1
               do (spawn-object (list (list x y 0.1019) '(0 0 0 1)) :breakfast-cereal
                                (intern (format nil \"BOX-~a\" number))))",
    );
    let said = cook.done(&from_the_counter("cup"));
    assert!(cook.pose("CUP-1").translation.x < -0.6, "{said}");
}

/// Transports an object of a type from anywhere on the counter to the island.
fn from_the_counter(kind: &str) -> String {
    transporting(kind, "sink-area-surface", "kitchen-island-surface")
}

fn transporting(kind: &str, from: &str, to: &str) -> String {
    format!(
        "(with-simulated-robot
           (perform (an action (type transporting)
                      (object (an object (type {kind})))
                      (location (a location (on (an object (urdf-name {from})
                                                           (part-of kitchen)))))
                      (target (a location (on (an object (urdf-name {to})
                                                         (part-of kitchen)))
                                          (for (an object (type {kind}))))))))"
    )
}

/// A spoon and five boxes on the floor, around a point.
fn with_boxes(spoon: &str, [x, y]: [f64; 2]) -> Cook {
    let mut cook = Cook::new();
    cook.done(&format!("(spawn-object '({spoon}) :spoon 'spoon-1)"));
    let around = [
        [0.0, 0.0],
        [0.15, 0.15],
        [0.15, -0.15],
        [-0.15, 0.15],
        [-0.15, -0.15],
    ];
    for (number, [dx, dy]) in (1..).zip(around) {
        let (x, y) = (x + dx, y + dy);
        cook.done(&format!(
            "(spawn-object '(({x} {y} 0.15) (0 0 0 1)) :breakfast-cereal 'box-{number})"
        ));
    }
    cook
}

/// Only between the poses that are tried first does the robot fit there.
#[test]
fn a_spoon_is_fetched_from_between_the_usual_places_to_stand() {
    let spoon = "(1.65732 -0.11157 0.86159) (0.00086 0.00487 0.15402 -0.98805)";
    let mut cook = with_boxes(spoon, [0.775, -0.125]);
    let said = cook.done(&from_the_counter("spoon"));
    assert!(cook.pose("SPOON-1").translation.x < -0.6, "{said}");
}

/// The way leads through gaps that are hardly wider than the robot.
#[test]
fn boxes_beside_the_way_are_not_pushed() {
    let spoon = "(-1.26937 0.75627 0.86558) (0.00310 -0.00391 0.58329 0.81225)";
    let mut cook = with_boxes(spoon, [-1.525, 0.225]);
    let names = (1..=5).map(|i| format!("BOX-{i}"));
    let stood: Vec<_> = names.map(|name| (cook.pose(&name), name)).collect();
    let form = transporting("spoon", "kitchen-island-surface", "table-area-main");
    let said = cook.done(&form);
    assert!(cook.pose("SPOON-1").translation.y < -0.6, "{said}");
    for (pose, name) in stood {
        assert!(cook.distance(&name, &pose) < 1e-3, "{name}");
    }
}
