//! Hands with something open at the top stay level on their way.

use super::fixture::{Kitchen, Outcome};
use crate::motion::{
    CollisionMode, Motion, MotionStatus, MoveJoints, TcpPath, carries, carrying_posture,
};
use crate::robot::Side;
use crate::world::tilt::tilt_at;
use spatial::pose::from_xyz_rpy;
use std::f64::consts::FRAC_PI_2;

/// A robot in the open whose hand points down, with a bowl in it by the rim.
fn with_bowl(side: Side, lean: f64) -> Kitchen {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.3);
    let y = if side == Side::Left { 0.25 } else { -0.25 };
    let down = from_xyz_rpy([0.6, y, 1.0], [0.0, FRAC_PI_2, 0.0]);
    let reach = kitchen.tcp(side, down, TcpPath::Free, CollisionMode::AvoidAll);
    kitchen.run_one(reach).unwrap_or_else(|f| panic!("{f}"));
    let at = from_xyz_rpy([0.67, y, 0.99], [0.0, lean, 0.0]);
    kitchen
        .world
        .spawn("bowl", "bowl", &at, None, None)
        .unwrap();
    kitchen.world.hold("bowl", side, 100.0).unwrap();
    kitchen.declare_grasp(side, "bowl");
    kitchen
}

/// Carries a motion out; the greatest tilt (degrees) of the bowl on the way.
fn tilt_during(kitchen: &mut Kitchen, mut motion: impl Motion) -> (Outcome, f64) {
    let mut most = 0.0f64;
    for _ in 0..240 * 60 {
        match motion.tick(&mut kitchen.world) {
            MotionStatus::Running => {}
            MotionStatus::Done(outcome) => return (Ok(outcome), most),
            MotionStatus::Failed(failure) => return (Err(*failure), most),
        }
        kitchen.world.step();
        let tilt = tilt_at(&kitchen.world.object_pose("bowl").unwrap());
        most = most.max(tilt.to_degrees());
    }
    panic!("the motion does not end");
}

fn to(side: Side, positions: Vec<f64>) -> MoveJoints {
    match side {
        Side::Left => MoveJoints::new(Some(positions), None),
        Side::Right => MoveJoints::new(None, Some(positions)),
    }
}

#[test]
fn a_bowl_is_brought_to_the_body_level_and_out_again() {
    for side in Side::BOTH {
        let mut kitchen = with_bowl(side, 0.0);
        let arm = kitchen.world.models().description.arm(side).clone();
        let out = arm.positions(&kitchen.world.robot_configuration().joints);
        let posture = carrying_posture(&kitchen.world, side).expect("there is one");
        assert!(!carries(&kitchen.world, side, 0.02));
        for goal in [posture, out] {
            let (end, tilt) = tilt_during(&mut kitchen, to(side, goal.to_vec()));
            end.unwrap_or_else(|f| panic!("{f}"));
            assert!(tilt > 0.0 && tilt < 14.0, "{tilt}");
            assert_eq!(carries(&kitchen.world, side, 0.02), goal == posture);
        }
        // A posture that tilts it is gone to if it is asked for.
        let mut tilted = out.to_vec();
        tilted[5] += if out[5] < -1.0 { 0.4 } else { -0.4 };
        let (end, tilt) = tilt_during(&mut kitchen, to(side, tilted));
        end.unwrap_or_else(|f| panic!("{f}"));
        assert!(tilt > 20.0, "{tilt}");
        assert_eq!(kitchen.world.tilts_since(0).count(), 1);
    }
}

#[test]
fn what_lies_in_the_hand_may_turn() {
    let kitchen = with_bowl(Side::Left, 1.2);
    assert!(kitchen.world.upright_in_hand(Side::Left).is_none());
    assert_eq!(carrying_posture(&kitchen.world, Side::Left), None);
    let kitchen = with_bowl(Side::Left, 0.2);
    assert!(kitchen.world.upright_in_hand(Side::Left).is_some());
}

#[test]
fn a_bottle_is_not_open_at_the_top() {
    let mut kitchen = with_bowl(Side::Left, 0.0);
    kitchen.world.remove("bowl").unwrap();
    let at = from_xyz_rpy([0.6, 0.25, 0.99], [0.0; 3]);
    kitchen
        .world
        .spawn("bottle", "bottle", &at, None, None)
        .unwrap();
    kitchen.world.hold("bottle", Side::Left, 100.0).unwrap();
    assert!(kitchen.world.upright_in_hand(Side::Left).is_none());
}
