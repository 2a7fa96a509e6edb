//! Parking the arms, also where there is no room for it.

use super::cook::Cook;

/// Evaluates to the poses of the base (x, y) at which the arms may be parked.
const PLACES: &str = "(mapcar (lambda (pose)
                                (list (round (* 100 (cl-tf:x (cl-tf:origin pose))))
                                      (round (* 100 (cl-tf:y (cl-tf:origin pose))))))
                              (subseq (pp-plans::places-aside) 0 2))";

/// The hand may be in a cupboard, and nothing else than straight back leads out of it.
#[test]
fn a_hand_that_cannot_be_parked_is_taken_straight_back_first() {
    let mut cook = Cook::new();
    cook.done("(init-projection) (with-simulated-robot (pp-plans::park-arms))");
    assert_eq!(cook.done(PLACES), "((-15 0) (-30 0))\n");
    cook.done(
        "(with-simulated-robot
           (let ((?pose (make-pose \"base_footprint\" '((0.6 0.3 1.0) (0 0 0.38268 0.92388)))))
             (perform (an action (type reaching) (left-poses ?pose)))))",
    );
    // The hand points to the left, forward by 45 degrees.
    assert_eq!(cook.done(PLACES), "((-14 -14) (-28 -28))\n");
}

/// With the torso where it is, a shoulder would touch the edge of the counter. Nothing leads out of
/// there with an arm that is stretched out.
#[test]
fn arms_are_parked_beside_a_counter_with_the_torso_higher() {
    let mut cook = Cook::new();
    cook.done(
        "(init-projection)
         (with-simulated-robot
           (pp-plans::park-arms)
           (perform (a motion (type moving-torso) (joint-angle 0.09)))
           (let ((?over-drawer '(-0.033 0.078 -1.345 -0.65 -1.798 -1.644 -1.313)))
             (perform (an action (type positioning-arm) (right-configuration ?over-drawer)))))
         (btr-utils:move-robot '((0.825 0.325 0) (0 0 0.67219 0.74038)))",
    );
    let base = |cook: &Cook| {
        let world = cook.session.simulation().world();
        world.robot_configuration().base
    };
    let stood = base(&cook);
    let parked = "(pp-plans::parked-p :right)";
    cook.done("(with-simulated-robot (pp-plans::park-arms))");
    assert_eq!(cook.done(parked), "NIL\n");
    cook.done("(with-simulated-robot (pp-plans::park-arms-nearby))");
    assert_ne!(cook.done(parked), "NIL\n");
    assert_eq!(base(&cook), stood);
    cook.assert_no_overlap();
}
