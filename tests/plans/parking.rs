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
