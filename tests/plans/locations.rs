//! Symbolic locations: where things and the robot could be.

use std::collections::BTreeSet;

use super::cook::Cook;
use spatial::{Pose, pose};

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
fn a_search_that_others_have_set_aside_goes_on_without_repeating_itself() {
    let mut cook = Cook::new();
    let shown = cook.done(&format!(
        "(defun places (n l)
           (loop for next = l then (next-solution next) repeat n
                 collect (reference next)))
         (defun near-p (a b)
           (and (< (cl-transforms:v-dist (cl-transforms:origin a) (cl-transforms:origin b)) 0.01)
                (< (cl-transforms:angle-between-quaternions (cl-transforms:orientation a)
                                                            (cl-transforms:orientation b))
                   0.1)))
         (defparameter *l* (a location {TABLE} (for (an object (type cup)))))
         (defparameter *before* (places 10 *l*))
         (loop repeat 20 do (reference (a location {TABLE} (for (an object (type bowl))))))
         (let ((all (append *before* (rest (places 20 (desig:current-desig *l*))))))
           (list (length all)
                 (length (remove-duplicates all :test #'near-p))))"
    ));
    assert!(shown.ends_with("(29 29)\n"), "{shown}");
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
    let mut cook = Cook::watched_at_table_with_bottle();
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

#[test]
fn things_are_put_beside_near_and_far_from_others() {
    let mut cook = Cook::new();
    cook.done("(btr-utils:spawn-object 'plate-1 :plate :pose '((-0.8 1.7 0.9) (0 0 0 1)))");
    let plate = cook.pose("PLATE-1").translation.vector;
    let at = |cook: &mut Cook, keys: &str| {
        let cup = "(for (an object (type cup)))";
        let at = reference(cook, &format!("(a location {ISLAND} {cup} {keys})"));
        at.translation.vector - plate
    };
    let plate = "(an object (name plate-1))";
    // The plate is nearest to the back edge, +x: there left is -y, and behind is -x.
    assert!(at(&mut cook, &format!("(left-of {plate})")).y < 0.0);
    assert!(at(&mut cook, &format!("(right-of {plate})")).y > 0.0);
    let behind = at(&mut cook, &format!("(behind {plate}) (threshold 0.9)"));
    assert!(
        behind.x < 0.0 && behind.y.abs() < 0.5 * behind.x.abs(),
        "{behind:?}"
    );
    let near = at(&mut cook, &format!("(near {plate})")).xy().norm();
    let far = at(&mut cook, &format!("(far-from {plate})")).xy().norm();
    assert!(near < 0.4 && far > near, "{near} {far}");
    // Where it stands is found without being told.
    let beside = reference(
        &mut cook,
        &format!("(a location (left-of {plate}) (for (an object (type cup))))"),
    );
    assert!((beside.translation.z - 0.9).abs() < 0.1);
}

#[test]
fn things_are_put_into_drawers_and_onto_boards() {
    let mut cook = Cook::new();
    let drawer = "(in (an object (type drawer) (urdf-name sink-area-left-middle-drawer-main)))";
    let at = reference(
        &mut cook,
        &format!("(a location {drawer} (for (an object (type cup))))"),
    );
    let t = at.translation;
    assert!((0.38..0.55).contains(&t.z), "{t:?}");
    assert!(
        (1.25..1.8).contains(&t.x) && (0.5..1.29).contains(&t.y),
        "{t:?}"
    );
    let boards = "(in (an object (urdf-name oven-area-area-right-drawer-main)))";
    let mut height = |level: &str| {
        let at = reference(&mut cook, &format!("(a location {boards} {level})"));
        at.translation.z
    };
    let [top, second, bottom] =
        ["(level topmost)", "(level 2)", "(level bottommost)"].map(&mut height);
    assert!((top - 1.15).abs() < 0.03, "{top}");
    assert!((second - 0.49).abs() < 0.03, "{second}");
    assert!((bottom - 0.19).abs() < 0.04, "{bottom}");
    // Without a level it may be any of them, and each is one of the places.
    let offered = cook.done(&format!(
        "(loop repeat 12 for l = (a location {boards}) then (next-solution l)
               collect (cl-tf:z (cl-tf:origin (reference l))))"
    ));
    let heights = offered.split(['(', ')', ' ', '\n']);
    let heights = heights.filter_map(|z| z.trim_end_matches("d0").parse::<f64>().ok());
    let different: BTreeSet<i64> = heights.map(|z| (z / 0.1) as i64).collect();
    assert_eq!(different.len(), 4, "{offered}");
    let is_place = format!(
        "(let ((place (reference (a location {boards} (level 3)))))
           (coe::fulfils-p (a location {boards}) place))"
    );
    assert_eq!(cook.done(&is_place), "T\n");
    let why = refusal(&mut cook, &format!("(a location {boards} (level 7))"));
    assert!(why.ends_with("levels."), "{why}");
    let tall = "(for (an object (type cereal)))";
    let why = refusal(
        &mut cook,
        &format!(
            "(a location (in (an object (urdf-name sink-area-left-upper-drawer-main))) {tall})"
        ),
    );
    assert!(why.contains("were rejected"), "{why}");
}

#[test]
fn a_table_is_set_in_slots() {
    let mut cook = Cook::new();
    let shown = cook.done(&format!(
        "(loop repeat 4
               for l = (a location {ISLAND} (for (an object (type plate)))
                                   (context table-setting) (object-count 4))
                 then (next-solution l)
               for ?p = (reference l)
               for i from 1
               do (btr-utils:spawn-object (intern (format nil \"PLATE-~a\" i)) :plate :pose ?p)
               collect (cl-transforms:x (cl-transforms:origin ?p)))"
    ));
    // Two at each long edge.
    let xs: Vec<f64> = shown
        .split(['(', ')', ' ', '\n'])
        .filter_map(|n| n.trim_end_matches("d0").parse().ok())
        .collect();
    assert_eq!(xs.len(), 4, "{shown}");
    assert!(xs.iter().all(|x| (x + 1.07).abs() > 0.03), "{xs:?}");
}

#[test]
fn a_held_object_is_put_down_at_a_symbolic_target() {
    let mut cook = Cook::watched_at_table_with_bottle();
    cook.take_bottle();
    let why = refusal(
        &mut cook,
        "(let ((?o *bottle*)) (a location (reachable-for pr2) (object ?o)))",
    );
    assert_eq!(
        why,
        "BOTTLE-1 is in the right hand: add (location …), where it is to be put."
    );
    cook.done(&format!(
        "(defparameter *there* (let ((?o *bottle*)) (a location {TABLE} (side right) (for ?o))))
         (with-simulated-robot
           (park-arms)
           (let ((?l (let ((?t *there*) (?o *bottle*))
                       (a location (reachable-for pr2) (location ?t) (object ?o)))))
             (perform (an action (type going) (target ?l))))
           (let ((?t *there*))
             (perform (an action (type placing) (arm right) (target ?t)))))"
    ));
    let wanted = reference(&mut cook, "*there*");
    assert!(cook.distance("BOTTLE-1", &wanted) < 0.05);
    assert!(cook.lean("BOTTLE-1") < 3.0);
    cook.assert_no_overlap();
}

#[test]
fn the_robot_stands_where_it_sees_past_what_is_in_the_way() {
    let mut cook = Cook::at_table_with_bottle();
    let here = cook.done("(get-robot-transformation)");
    let here = read_pose(&here).translation.vector;
    // A box between the robot and the bottle.
    cook.done("(btr-utils:spawn-object 'cereal-1 :cereal :pose '((-1.58 -0.76 0.85) (0 0 0.7071 0.7071)))");
    let at = reference(
        &mut cook,
        "(let ((?o *bottle*)) (a location (visible-for pr2) (object ?o)))",
    );
    assert!((at.translation.vector - here).norm() > 0.1, "{at:?}");
    let found = cook.done(
        "(let ((?l (let ((?o *bottle*)) (a location (visible-for pr2) (object ?o)))))
           (with-simulated-robot
             (park-arms)
             (perform (an action (type going) (target ?l)))
             (let ((?o *bottle*)) (perform (an action (type looking) (object ?o))))
             (desig-prop-value (perform (a motion (type detecting) (object (an object (type bottle))))) :name)))",
    );
    assert!(found.contains("BOTTLE-1"), "{found}");
}

#[test]
fn the_map_of_a_location_is_shown() {
    let mut cook = Cook::new();
    let said = cook.done(&format!(
        "(defparameter *l* (a location {ISLAND} (side left)))
         (reference *l*)
         (visualize-costmap *l*)
         (describe *l*)"
    ));
    assert!(said.contains("Area to look in: 0.9"), "{said}");
    assert!(said.contains("Poses offered: 1"), "{said}");
    let signs = |cook: &Cook| {
        let scene = cook.session.simulation().scene();
        let names = scene.bodies.iter().map(|b| b.owner.name.to_string());
        names
            .filter(|n| n.contains("pose") || n.contains("map"))
            .count()
    };
    assert_eq!(signs(&cook), 2);
    cook.done("(btr:clear-costmap-vis-object)");
    assert_eq!(signs(&cook), 0);
}

#[test]
fn a_location_can_be_forgotten_and_redefined() {
    let mut cook = Cook::new();
    let bottle = "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))";
    cook.done(bottle);
    cook.done(&format!(
        "(defparameter *l* (a location {TABLE} (for (an object (type cup)))))
         (defparameter *p* (reference *l*))
         (next-solution *l*)
         (desig:reset *l*)"
    ));
    assert_eq!(cook.done("(null (desig:successor *l*))"), "T\n");
    cook.done("(reference *l*)");
    // A parameter is a fact that programs may redefine.
    cook.done(
        "(prolog:def-fact-group my-robot ()
           (prolog:<- (costmap:costmap-in-reach-distance 0.3))
           (prolog:<- (costmap:costmap-reach-minimal-distance 0.25)))",
    );
    let why = refusal(
        &mut cook,
        "(let ((?p (make-pose \"map\" '((-1.4 -1.05 0.72) (0 0 0 1)))))
           (a location (reachable-for pr2) (location (a location (pose ?p)))))",
    );
    assert!(why.contains("rejected"), "{why}");
}
