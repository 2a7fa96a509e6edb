//! What is open at the top stays upright in the hands.

use super::cook::Cook;

/// A robot before the table that has picked up things of a type, each with a hand, from the left and from the right.
fn holding(kind: &str, arms: &[&str]) -> Cook {
    let mut cook = Cook::watched();
    for (arm, x) in [("left", -1.25), ("right", -1.65)] {
        if arms.contains(&arm) {
            cook.done(&format!(
                "(btr-utils:spawn-object '{arm}-one :{kind} :pose '(({x} -0.85 0.8) (0 0 0 1)))"
            ));
        }
    }
    cook.done("(with-simulated-robot (get-ready-at *place-at-table*))");
    for arm in arms {
        cook.done(&format!(
            "(with-simulated-robot
               (let* ((?where (get-current-pose-of-object '{arm}-one)) (?there (a location (pose ?where))))
                 (perform (an action (type turning-towards) (target ?there)))
                 (let ((?one (perform (an action (type detecting)
                                         (object (an object (type {kind}) (name {arm}-one)))))))
                   (perform (an action (type picking-up) (object ?one) (arm {arm}))))))"
        ));
    }
    cook
}

const PARKED: &str = "(mapcar (lambda (arm) (if (pp-plans::parked-p arm) t nil)) '(:left :right))";

#[test]
fn an_arm_with_a_bowl_is_parked_with_the_bowl_upright() {
    let mut cook = holding("bowl", &["left"]);
    let said = cook.done("(with-simulated-robot (park-arms))");
    assert!(!said.contains("WARN"), "{said}");
    assert!(cook.lean("LEFT-ONE") < 15.0);
    assert_eq!(cook.done(PARKED), "(T T)\n");
    let before = cook.session.simulation().now();
    cook.done("(with-simulated-robot (park-arms))");
    assert!(cook.session.simulation().now() - before < 0.1, "no motion");
    assert_eq!(cook.done("(pp-plans::upright-in-hand :left)"), "LEFT-ONE\n");
    cook.assert_no_overlap();
}

#[test]
fn two_mugs_are_parked_upright() {
    let mut cook = holding("mug", &["left", "right"]);
    cook.done("(with-simulated-robot (park-arms))");
    for name in ["LEFT-ONE", "RIGHT-ONE"] {
        assert!(cook.lean(name) < 15.0, "{name} {}", cook.lean(name));
    }
    assert_eq!(cook.done(PARKED), "(T T)\n");
    cook.assert_no_overlap();
}

#[test]
fn a_posture_that_is_asked_for_may_tilt_a_bowl_and_says_so() {
    let mut cook = holding("bowl", &["left"]);
    let said = cook.done(
        "(with-simulated-robot
           (park-arms)
           (loop for turn in '(0.4 -0.4 0.3 -0.3)
                 for ?angles = (copy-list (pp-plans::carrying-posture :left))
                 while ?angles
                 do (incf (sixth ?angles) turn)
                    (cpl:with-failure-handling ((cpl:plan-failure () (return)))
                      (perform (an action (type positioning-arm) (left-configuration ?angles))))))",
    );
    assert!(
        said.contains("WARN") && said.contains("LEFT-ONE in the left hand is open at the top"),
        "{said}"
    );
    assert!(cook.lean("LEFT-ONE") > 15.0);
    // What has been in it is gone.
    assert_eq!(cook.done("(pp-plans::upright-in-hand :left)"), "NIL\n");
}

#[test]
fn a_bottle_is_parked_as_before() {
    let mut cook = holding("bottle", &["right"]);
    let said = cook.done("(with-simulated-robot (park-arms))");
    assert!(!said.contains("open at the top"), "{said}");
    let parked = cook.done("(coe:holds '(cpoe:arms-positioned-at :carry :carry))");
    assert_ne!(parked, "NIL\n");
}

/// Nothing of the built-in description names it.
#[test]
fn a_type_of_users_with_a_hollow_is_carried_upright() {
    let mut cook = Cook::new();
    cook.done(
        "(def-object-type jar :mass 0.2 :color '(0.5 0.5 0.5)
           :shapes '((cylinder :radius 0.03 :length 0.008 :at (0 0 -0.05))
                    (ring :count 12 :radius 0.03 :stave (0.005 0.019 0.1))))
         (btr-utils:spawn-object 'jar-1 :jar :pose '((-1.4 -0.85 0.82) (0 0 0 1)))
         (with-simulated-robot
           (get-ready-at *place-at-table*)
           (let* ((?jar (perform (an action (type fetching) (object (an object (type jar)))))))
             (park-arms)))",
    );
    let held = cook.done("(mapcar #'pp-plans::upright-in-hand '(:left :right))");
    assert!(held.contains("JAR-1"), "{held}");
    assert!(cook.lean("JAR-1") < 15.0, "{}", cook.lean("JAR-1"));
}
