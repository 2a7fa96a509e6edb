//! Drives that are cancelled or suspended: the base brakes as fast as it may, and no faster.

use std::cell::RefCell;
use std::rc::Rc;

use nalgebra::Vector2;

use super::cook::Cook;
use robotics::world::World;
use robotics::world::physics::STEP_SECONDS;
use session::dialogue::Repeat;

/// Where the base was (m) after each step.
#[derive(Clone, Default)]
struct Ride(Rc<RefCell<Vec<Vector2<f64>>>>);

impl Ride {
    /// A robot that is about to drive two metres, and what its base does from then on.
    fn begin() -> (Cook, Ride) {
        let mut cook = Cook::new();
        cook.done(
            "(with-simulated-robot (get-ready-at (make-pose \"map\" '((0 0 0) (0 0 0 1)))))
             (defparameter *far* (make-pose \"map\" '((0 2 0) (0 0 0 1))))",
        );
        let ride = Ride::default();
        let places = ride.0.clone();
        cook.session.set_observer(Box::new(move |world: &World| {
            let base = world.robot_configuration().base.translation.vector;
            places.borrow_mut().push(base.xy());
        }));
        (cook, ride)
    }

    /// Speeds (m/s) of the base.
    fn speeds(&self) -> Vec<f64> {
        let places = self.0.borrow();
        let ways = places.windows(2).map(|pair| (pair[1] - pair[0]).norm());
        ways.map(|way| way / STEP_SECONDS).collect()
    }

    /// The base has driven fast and stands, and has never accelerated more than it can.
    fn assert_gentle(&self, cook: &Cook) {
        let speeds = self.speeds();
        let fastest = speeds.iter().copied().fold(0.0, f64::max);
        assert!(fastest > 0.3, "it was not faster than {fastest} m/s");
        assert_eq!(speeds.last(), Some(&0.0));
        let world = cook.session.simulation().world();
        let limit = world.models().description.base.drive.acceleration;
        let changes = speeds.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let most = changes.fold(0.0, f64::max) / STEP_SECONDS;
        assert!(most < 1.02 * limit, "{most} m/s² instead of {limit} m/s²");
    }
}

#[test]
fn a_branch_that_evaporates_brakes_before_anything_else_happens() {
    let (mut cook, ride) = Ride::begin();
    cook.done(
        "(with-simulated-robot
           (cpl:pursue (go-to *far*) (cpl:sleep 1.5))
           (perform (a motion (type waiting) (duration 0.5))))",
    );
    let speeds = ride.speeds();
    let begun = speeds.iter().position(|speed| *speed > 0.0).unwrap();
    let driven = speeds[begun..].iter().take_while(|speed| **speed > 0.0);
    let driven = driven.count();
    // 1.5 s, and half a second of braking.
    assert!((400..520).contains(&driven), "{driven} steps");
    let waited = speeds.len() - begun - driven;
    assert!((118..=122).contains(&waited), "{waited} steps");
    ride.assert_gentle(&cook);
}

#[test]
fn a_suspended_drive_brakes_and_then_goes_on_to_its_goal() {
    let (mut cook, ride) = Ride::begin();
    cook.done(
        "(with-simulated-robot
           (cpl:with-tags
             (cpl:par
               (:tag drive (go-to *far*))
               (cpl:seq
                 (cpl:sleep 1.5)
                 (cpl:with-task-suspended (drive)
                   (perform (a motion (type waiting) (duration 1))))))))
         (cpl:sleep 0.1)
         (with-simulated-robot (perform (a motion (type waiting) (duration 0.1))))",
    );
    let base = cook.session.simulation().world().robot_configuration().base;
    assert!((base.translation.y - 2.0).abs() < 1e-6);
    let speeds = ride.speeds();
    let fast = speeds.iter().position(|speed| *speed > 0.3).unwrap();
    let stood = speeds[fast..].iter().position(|speed| *speed == 0.0);
    let stood = fast + stood.unwrap();
    let again = speeds[stood..].iter().any(|speed| *speed > 0.3);
    assert!(again, "it has not been suspended on the way");
    ride.assert_gentle(&cook);
}

#[test]
fn an_interrupted_drive_has_come_to_a_stop_when_the_prompt_is_back() {
    let (mut cook, ride) = Ride::begin();
    cook.session.interrupt_next_at(400);
    let (report, _) = cook
        .say("(with-simulated-robot (go-to *far*))")
        .unwrap_err();
    assert_eq!(report, "Interrupted.");
    ride.assert_gentle(&cook);
    let base = cook.session.simulation().world().robot_configuration().base;
    assert!((0.3..1.9).contains(&base.translation.y), "{base}");
    // What comes next finds nothing that still moves.
    cook.done("(with-simulated-robot (go-to *far*))");
    let base = cook.session.simulation().world().robot_configuration().base;
    assert!((base.translation.y - 2.0).abs() < 1e-6);
}
