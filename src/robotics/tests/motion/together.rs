//! Base, torso and arms moving at the same time from anywhere to anywhere: whatever comes of
//! it, nothing ever overlaps by more than 2 mm, and a free place is reached.

use super::fixture::Kitchen;
use crate::motion::{MotionFailure, MoveJoints};
use crate::robot::Side;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

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
