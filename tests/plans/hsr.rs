//! The HSR: an arm of five joints, whose base turns towards what the hand grasps.

use std::cell::Cell;
use std::rc::Rc;

use super::cook::Cook;
use robotics::world::World;
use robotics::world::tilt::tilt_at;
use session::SessionOptions;
use spatial::pose::{distance_between, from_xyz_rpy};

fn hsr() -> SessionOptions {
    let mut options = SessionOptions::default();
    options.set_shipped_robot("hsr").unwrap();
    options
}

const BOTTLE: &str =
    "(btr-utils:spawn-object 'bottle-1 :bottle :pose '((-1.6 -0.9 0.82) (0 0 0 1)))";

#[test]
fn the_hsr_brings_a_bottle_to_the_island() {
    let mut cook = Cook::watched_with(&hsr());
    cook.done(BOTTLE);
    cook.done(
        "(with-simulated-robot
           (let ((?spot (make-pose \"map\" '((-0.8 2 0.96) (0 0 0 1)))))
             (perform (an action (type transporting) (object (an object (type bottle)))
                                 (target (a location (pose ?spot)))))
             (park-arms)))",
    );
    let there = from_xyz_rpy([-0.8, 2.0, 0.96], [0.0; 3]);
    let away = distance_between(&cook.pose("BOTTLE-1"), &there);
    assert!(away < 0.01, "{away}");
    assert_eq!(cook.done("(pw:arms-parked-p)").trim(), "T");
    cook.assert_no_overlap();
}

#[test]
fn the_hsr_carries_a_cup_upright() {
    let mut cook = Cook::with(&hsr());
    let greatest = Rc::new(Cell::new(0.0_f64));
    let seen = Rc::clone(&greatest);
    cook.session.set_observer(Box::new(move |world: &World| {
        let held = world.object("CUP-1").is_ok_and(|cup| cup.hold().is_some());
        if let (true, Ok(pose)) = (held, world.object_pose("CUP-1")) {
            seen.set(seen.get().max(tilt_at(&pose).to_degrees()));
        }
    }));
    cook.done("(btr-utils:spawn-object 'cup-1 :cup :pose '((-1.5 -0.85 0.78) (0 0 0 1)))");
    cook.done(
        "(with-simulated-robot
           (let ((?spot (make-pose \"map\" '((-0.8 1.6 0.92) (0 0 0 1)))))
             (perform (an action (type transporting) (object (an object (type cup)))
                                 (target (a location (pose ?spot)))))))",
    );
    let support = cook.done("(pp-plans::support-of 'cup-1)");
    assert_eq!(support.trim(), "\"kitchen_island_surface\"");
    let greatest = greatest.get();
    assert!(greatest > 0.0 && greatest < 15.0, "{greatest}");
}

/// From a stand beside the plane of its arm it grasps nothing, however near that is.
#[test]
fn a_stand_from_which_the_arm_does_not_point_at_the_object_is_refused() {
    let mut cook = Cook::with(&hsr());
    cook.done(BOTTLE);
    cook.done(
        "(with-simulated-robot
           (let ((?stand (make-pose \"map\" '((-1.4 -0.35 0) (0 0 -0.70710678 0.70710678))))
                 (?there (make-pose \"map\" '((-1.6 -0.9 0.82) (0 0 0 1)))))
             (perform (an action (type going) (target (a location (pose ?stand)))))
             (perform (a motion (type looking) (target (a location (pose ?there)))))))
         (defparameter *bottle*
           (with-simulated-robot
             (perform (a motion (type detecting) (object (an object (type bottle)))))))",
    );
    let report = cook.fails(
        "MANIPULATION-POSE-UNREACHABLE",
        "(let ((?bottle *bottle*)) (perform (an action (type picking-up) (object ?bottle))))",
    );
    assert!(report.contains("24 of 24: out of reach"), "{report}");
}
