//! What the robot touches in the kitchen, and how far it is from everything.

mod world_support;

use planwright::world::{AllowedPairs, RobotConfiguration, World};
use world_support::{carry, models, tucked};

/// Gap (m) and the two nearest bodies.
fn nearest(world: &World, robot: &RobotConfiguration) -> (f64, String) {
    let clearance = world
        .collision_checker()
        .clearance_to_world(robot, &AllowedPairs::none(), 0.6)
        .expect("something is near");
    (
        clearance.distance,
        format!("{} - {}", clearance.moving, clearance.other),
    )
}

#[test]
fn distances_are_those_of_the_kitchen() {
    let models = models();
    let world = World::new(models.clone(), tucked(&models, [0.0; 3], 0.0));
    // Base pose, then the gap for: carry at torso 0 and 0.3, tucked at torso 0 and 0.3.
    let table = [
        ([0.0, 0.0, 0.0], [0.346, 0.448, 0.452, 0.452]),
        ([0.0, 1.0, 0.0], [0.328, 0.350, 0.328, 0.350]),
        ([-1.447, -0.15, -90.0], [0.212, 0.321, 0.206, 0.139]),
        ([-0.15, 2.0, 180.0], [0.158, 0.241, 0.223, 0.151]),
    ];
    for (at, expected) in table {
        let robots = [
            carry(&models, at, 0.0),
            carry(&models, at, 0.3),
            tucked(&models, at, 0.0),
            tucked(&models, at, 0.3),
        ];
        for (robot, expected) in robots.iter().zip(expected) {
            let (gap, pair) = nearest(&world, robot);
            println!(
                "{at:?} {gap:.3} {expected} {pair} {:?}",
                world
                    .collision_checker()
                    .all_hits(robot, &AllowedPairs::none(), 0.0)
            );
        }
    }
}
