//! The torso: limits, and what is in its way.

use super::fixture::Kitchen;
use crate::motion::{CollisionMode, MotionFailure, MotionOutcome, TcpPath};
use crate::robot::Side;
use spatial::pose::{angle_between, distance_between, from_xyz_rpy};

const ARRIVED: Result<MotionOutcome, MotionFailure> = Ok(MotionOutcome::Arrived);

fn height(kitchen: &Kitchen) -> f64 {
    let torso = &kitchen.world.models().description.torso;
    torso.height(&kitchen.world.robot_configuration().joints)
}

/// The robot at the table with its right hand over the bottle, and the torso up.
fn hand_over_bottle() -> Kitchen {
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(-1.6, -0.9, 0.83);
    let bottle = kitchen.in_base("bottle-1").translation;
    let over = from_xyz_rpy([bottle.x, bottle.y, 1.1], [0.0; 3]);
    let reach = kitchen.tcp(Side::Right, over, TcpPath::Free, CollisionMode::AvoidAll);
    assert_eq!(kitchen.run_one(reach), ARRIVED);
    kitchen
}

#[test]
fn a_torso_goal_beyond_the_limits_is_cropped_and_then_reported() {
    let mut kitchen = Kitchen::parked(0.0, 0.5, 0.0, 0.2);
    for (goal, reached) in [(0.5, 0.33), (-0.1, 0.0)] {
        let torso = kitchen.torso(goal);
        let failure = kitchen.run_one(torso).unwrap_err();
        assert_eq!(
            failure.to_string(),
            format!("Torso goal {goal} was out of joint limits\nthe torso goes from 0 to 0.33 m")
        );
        let joint = kitchen.world.models().description.torso.joint.unwrap();
        let height = kitchen.world.robot_configuration().joints.get(joint);
        assert!((height - reached).abs() < 1e-12);
    }
    let torso = kitchen.torso(0.33);
    assert_eq!(kitchen.run_one(torso), ARRIVED);
}

#[test]
fn the_torso_stops_before_a_hand_touches_what_stands_below_it() {
    let mut kitchen = hand_over_bottle();
    let before = kitchen.world.object_pose("bottle-1").unwrap();
    let torso = kitchen.torso(0.0);
    let failure = kitchen.run_one(torso).unwrap_err();
    let MotionFailure::TorsoBlocked { goal, hit, .. } = &failure else {
        panic!("{failure}")
    };
    assert_eq!((*goal, hit.other.object()), (0.0, Some("bottle-1")));
    // As far as possible.
    let stopped = height(&kitchen);
    assert!((0.02..0.28).contains(&stopped), "{stopped}");
    assert!((0.003..0.009).contains(&kitchen.room(kitchen.world.robot_configuration(), 0.05)));
    let after = kitchen.world.object_pose("bottle-1").unwrap();
    assert!(distance_between(&before, &after) < 1e-4 && angle_between(&before, &after) < 1e-3);
    // There is no lower place; up is free.
    let torso = kitchen.torso(0.0);
    let failure = kitchen.run_one(torso).unwrap_err();
    assert!(
        matches!(failure, MotionFailure::TorsoBlocked { .. }),
        "{failure}"
    );
    assert!((height(&kitchen) - stopped).abs() < 1e-9);
    let torso = kitchen.torso(0.3);
    assert_eq!(kitchen.run_one(torso), ARRIVED);
}

#[test]
fn the_torso_arrives_where_an_arm_frees_the_way_meanwhile() {
    let mut kitchen = hand_over_bottle();
    let before = kitchen.world.object_pose("bottle-1").unwrap();
    let mut torso = kitchen.torso(0.0);
    let mut park = kitchen.park(true, true);
    for end in kitchen.run(&mut [&mut torso, &mut park]) {
        assert_eq!(end, ARRIVED);
    }
    assert!(height(&kitchen) < 1e-6);
    let after = kitchen.world.object_pose("bottle-1").unwrap();
    assert!(distance_between(&before, &after) < 1e-4);
}
