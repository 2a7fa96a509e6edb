//! Base, torso and arms moving at the same time from anywhere to anywhere: whatever comes of
//! it, nothing ever overlaps by more than 2 mm, and a free place is reached. A hand that opens on the way has the room.

use super::fixture::Kitchen;
use crate::motion::jobs::gripper::GripperCommand;
use crate::motion::{CollisionMode, MotionFailure, MoveJoints, TcpPath};
use crate::robot::Side;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use spatial::pose::from_xyz_rpy;

#[test]
fn any_motions_together_keep_the_robot_out_of_everything() {
    let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.0);
    let mut rng = Pcg64::seed_from_u64(7);
    let mut random = move || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let mut reached = 0;
    for _ in 0..12 {
        let (x, y) = (-3.4 + random() * 4.2, -0.6 + random() * 3.3);
        let yaw = random() * 360.0 - 180.0;
        let height = random() * 0.33;
        let name = if random() < 0.5 { "park" } else { "tucked" };
        let posture = |side: Side| {
            let arm = kitchen.world.models().description.arm(side);
            Some(arm.posture(name).unwrap().to_vec())
        };
        let mut arms = MoveJoints::new(posture(Side::Left), posture(Side::Right));
        let (mut drive, mut torso) = (kitchen.drive(x, y, yaw), kitchen.torso(height));
        let ends = kitchen.run(&mut [&mut drive, &mut torso, &mut arms]);
        match &ends[0] {
            Ok(_) => reached += 1,
            Err(MotionFailure::GoalOccupied { .. }) => {}
            Err(other) => panic!("to ({x:.2} {y:.2} {yaw:.0}): {other}"),
        }
    }
    assert!(reached > 5, "{reached}");
}

/// An arm that had been planned with closed fingers was stopped by its own forearm while they opened.
#[test]
fn a_hand_that_opens_on_the_way_stops_neither_its_arm_nor_its_fingers() {
    let mut rng = Pcg64::seed_from_u64(3);
    let mut random = move || (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    let mut between = |least: f64, most: f64| least + (most - least) * random();
    let mut arrived = 0;
    for _ in 0..60 {
        let side = match between(0.0, 1.0) < 0.5 {
            true => Side::Left,
            false => Side::Right,
        };
        let out = if side == Side::Left { 0.3 } else { -0.3 };
        let at = [
            between(0.4, 0.75),
            out + between(-0.3, 0.3),
            between(0.6, 1.1),
        ];
        let pose = from_xyz_rpy(
            at,
            [between(-1.6, 1.6), between(-1.6, 1.6), between(-1.6, 1.6)],
        );
        let mut kitchen = Kitchen::parked(0.0, 0.0, 0.0, 0.2);
        let mut open = kitchen.gripper(side, GripperCommand::Position(0.10));
        let mut reach = kitchen.tcp(side, pose, TcpPath::Free, CollisionMode::AvoidAll);
        let ends = kitchen.run(&mut [&mut open, &mut reach]);
        match &ends[1] {
            Ok(_) => arrived += 1,
            Err(MotionFailure::PoseUnreachable(_)) => continue,
            Err(other) => panic!("{side} to {pose:?}: {other}"),
        }
        assert!(ends[0].is_ok(), "{side} to {pose:?}: {:?}", ends[0]);
    }
    assert!(arrived > 20, "{arrived}");
}
