//! Symbolic locations: where things and the robot could be.

use super::cook::Cook;
use crate::spatial::{Pose, pose};

/// The pose that a text evaluates to, from its printed form.
fn read_pose(shown: &str) -> Pose {
    let numbers: Vec<f64> = shown
        .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
        .filter_map(|part| part.parse().ok())
        .collect();
    let [.., x, y, z, i, j, k, w] = numbers[..] else {
        panic!("{shown} is no pose");
    };
    pose::from_xyz_quaternion([x, y, z], [i, j, k, w]).unwrap()
}

fn reference(cook: &mut Cook, location: &str) -> Pose {
    read_pose(&cook.done(&format!("(reference {location})")))
}

/// Why a location cannot be resolved, without the designator.
fn refusal(cook: &mut Cook, location: &str) -> String {
    let (report, _) = cook
        .say(&format!("(reference {location})"))
        .expect_err(location);
    let end = report.find(">'\n").map_or(0, |at| at + 3);
    report[end..].to_owned()
}

const ISLAND: &str = "(on (an object (urdf-name kitchen-island-surface) (part-of kitchen)))";
const TABLE: &str = "(on (an object (urdf-name table-area-main)))";

#[test]
fn sides_are_those_of_the_link() {
    let mut cook = Cook::new();
    let bowl = "(for (an object (type bowl)))";
    let at = reference(
        &mut cook,
        &format!("(a location {ISLAND} (side (back right)) {bowl})"),
    );
    // The middle of the island is at (-1.07 1.72), and its frame is not turned.
    let t = at.translation;
    assert!(t.x > -1.07 && t.y < 1.72, "{t:?}");
    let sink = "(on (an object (urdf-name sink_area_surface)))";
    let at = reference(
        &mut cook,
        &format!("(a location {sink} (side right) (side back) {bowl})"),
    );
    // The sink's is turned by 180 degrees.
    let t = at.translation;
    assert!(t.x > 1.535 - 1e-9 || t.y > 0.29, "{t:?}");
    assert!(t.x < 1.536 && t.y > 0.28, "{t:?}");
}

#[test]
fn what_is_put_at_a_location_stays_there() {
    let mut cook = Cook::new();
    for (kind, on) in [("bowl", ISLAND), ("bottle", TABLE), ("cereal", TABLE)] {
        let at = reference(
            &mut cook,
            &format!("(a location {on} (for (an object (type {kind}))))"),
        );
        let numbers = {
            let (t, q) = (at.translation, at.rotation);
            format!(
                "(({} {} {}) ({} {} {} {}))",
                t.x, t.y, t.z, q.i, q.j, q.k, q.w
            )
        };
        cook.done(&format!(
            "(btr-utils:spawn-object 'thing-1 :{kind} :pose '{numbers}) (with-simulated-robot (cpl:sleep 1))"
        ));
        assert!(cook.distance("THING-1", &at) < 0.02, "{kind}");
        assert!(cook.lean("THING-1") < 3.0, "{kind}");
        cook.done("(btr-utils:kill-object 'thing-1)");
    }
}

#[test]
fn solutions_do_not_repeat_and_follow_the_world() {
    let mut cook = Cook::new();
    let shown = cook.done(&format!(
        "(defparameter *l* (a location {TABLE} (for (an object (type cup)))))
         (defparameter *first* (reference *l*))
         (loop for l = *l* then (next-solution l) repeat 40 while l
               collect (cl-transforms:x (cl-transforms:origin (reference l))) into xs
               collect (cl-transforms:y (cl-transforms:origin (reference l))) into ys
               finally (return (loop for (x . rest) on xs for (y . more) on ys
                                     always (loop for u in rest for v in more
                                                  never (and (= x u) (= y v))))))"
    ));
    assert!(shown.ends_with("T\n"), "{shown}");
    // A cup where the search would go on is avoided, although the map was made before.
    cook.done(
        "(loop for i below 8 for l = (next-solution *l*) then (next-solution l)
               for ?p = (reference l)
               do (btr-utils:spawn-object (intern (format nil \"CUP-~a\" i)) :cup :pose ?p))",
    );
    assert_eq!(cook.session.simulation().world().objects().len(), 8);
    for i in 0..8 {
        assert!(cook.lean(&format!("CUP-{i}")) < 3.0);
    }
}

#[test]
fn a_location_that_cannot_be_says_why() {
    let mut cook = Cook::new();
    let both = format!("(a location {ISLAND} (side left) (side right) (range-invert 0.3))");
    // A line remains where left meets right, which has no area.
    assert!(refusal(&mut cook, &both).contains("(side left) and (side right) leave nothing of"));
    assert_eq!(
        refusal(
            &mut cook,
            &format!("(a location {ISLAND} (range 0.3) (range-invert 0.5))")
        ),
        "(range 0.3) and (range-invert 0.5) leave nothing of kitchen_island_surface: 0.00 m²."
    );
    assert_eq!(
        refusal(
            &mut cook,
            "(a location (on (an object (urdf-name kitchen-iland-surface))))"
        ),
        "The kitchen has no furniture named KITCHEN-ILAND-SURFACE; did you mean kitchen-island-surface?"
    );
    assert_eq!(
        refusal(&mut cook, &format!("(a location {ISLAND} (side lft))")),
        "(side lft): one of left, right, front, back was expected; did you mean left?"
    );
    assert_eq!(
        refusal(
            &mut cook,
            &format!("(a location {ISLAND} (for (an object (type bwl))))")
        ),
        "there is no object type bwl; did you mean bowl?"
    );
    assert_eq!(
        refusal(&mut cook, "(a location)"),
        "Nothing generates such a location: write (a location (pose ?pose))."
    );
}

#[test]
fn the_robot_can_pick_up_from_where_it_is_sent() {
    let mut cook = Cook::at_table_with_bottle();
    let here = cook.done("(get-robot-transformation)");
    // It stands well already.
    let at = reference(
        &mut cook,
        "(let ((?o *bottle*)) (a location (reachable-for pr2) (arm right) (object ?o)))",
    );
    assert!((at.translation.vector - read_pose(&here).translation.vector).norm() < 1e-4);
    cook.done(
        "(with-simulated-robot (park-arms)
           (let* ((?o *bottle*)
                  (?l (next-solution (a location (reachable-for pr2) (arm left) (object ?o))))
                  (?grasp :front))
             (perform (an action (type going) (target ?l)))))",
    );
    let reaches = "(some (lambda (g) (grasp-reachable-p 'bottle-1 :left g))
                         (pp-plans::grasps-of-object *bottle* :left))";
    assert_eq!(cook.done(reaches), "T\n");
    cook.assert_no_overlap();
}

#[test]
fn users_generators_and_validators_are_in_the_same_chain() {
    let mut cook = Cook::new();
    cook.done(
        "(defun near-corner (location pose)
           (declare (ignore location))
           (if (< (cl-transforms:x (cl-transforms:origin pose)) -1.2) :accept \"too far east\"))
         (desig:register-location-validation-function 5 'near-corner)",
    );
    let at = reference(&mut cook, &format!("(a location {ISLAND})"));
    assert!(at.translation.x < -1.2);
    cook.done("(setf desig:*location-generator-max-retries* 3)");
    let why = refusal(
        &mut cook,
        "(a location (on (an object (urdf-name sink-area-surface))))",
    );
    assert_eq!(why, "3 candidates were rejected: 3 too far east.");
    cook.done("(desig:delete-location-validation-function 'near-corner)");
    cook.done(
        "(defun on-the-wall (location)
           (declare (ignore location))
           (list (make-pose \"map\" '((1.876 0 1) (0 0 0 1)))))
         (desig:register-location-generator 5 'on-the-wall)
         (setf desig:*location-generator-max-retries* 30)",
    );
    // The exact tests apply to poses from anywhere.
    let at = reference(&mut cook, &format!("(a location {ISLAND})"));
    assert!(at.translation.x < 0.0);
}

#[test]
fn the_same_session_gives_the_same_locations() {
    let run = || {
        let mut cook = Cook::new();
        cook.done(&format!(
            "(list (reference (a location {TABLE} (for (an object (type cup)))))
                   (reference (a location {ISLAND} (range 0.5))))"
        ))
    };
    assert_eq!(run(), run());
}
