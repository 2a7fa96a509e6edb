//! The robot in the physics engine, where only what is near an object follows it.

use crate::tests::world::fixture::{at, carry, models, spawn};
use crate::world::{AllowedPairs, World};
use spatial::pose::from_xy_yaw;

/// Drives the base straight from where it is to (x, y) in that many steps, from rest to rest, and
/// returns the greatest overlap (m) of the robot with anything.
fn drive(world: &mut World, [x, y]: [f64; 2], steps: u32) -> f64 {
    let mut robot = world.robot_configuration().clone();
    let from = robot.base.translation.vector;
    let mut deepest = 0.0f64;
    for i in 1..=steps {
        let s = f64::from(i) / f64::from(steps);
        let s = s * s * (3.0 - 2.0 * s);
        robot.base = from_xy_yaw(from.x + (x - from.x) * s, from.y + (y - from.y) * s, 0.0);
        world.set_robot_configuration(&robot);
        world.step();
        let hit = world.deepest_penetration(&AllowedPairs::none(), 0.0);
        deepest = hit.map_or(deepest, |hit| deepest.max(hit.depth));
    }
    deepest
}

/// A robot in free space that has driven 0.8 m, away from where it began.
fn robot_that_has_left() -> World {
    let models = models();
    let robot = carry(&models, [0.3, -0.1, 0.0], 0.2);
    let mut world = World::new(models, robot);
    drive(&mut world, [-0.5, -0.1], 480);
    world
}

#[test]
fn nothing_is_awake_while_the_robot_is_far_from_everything() {
    let mut world = robot_that_has_left();
    assert_eq!(world.awake(), 0);
    spawn(&mut world, "CUBE-1", "cube", &at(0.6, 1.2, 0.035));
    assert!(world.come_to_rest("CUBE-1", 5.0).unwrap());
    world.step();
    drive(&mut world, [-0.5, 0.0], 240);
    assert_eq!(world.awake(), 0);
}

#[test]
fn an_object_falls_through_where_the_robot_was() {
    let mut world = robot_that_has_left();
    spawn(&mut world, "CUBE-1", "cube", &at(0.35, -0.1, 1.5));
    world.settle(5.0);
    let there = world.object_pose("CUBE-1").unwrap().translation;
    assert!((there.z - 0.035).abs() < 1e-3, "{there}");
}

#[test]
fn an_object_falls_on_the_robot_where_it_is() {
    let mut world = robot_that_has_left();
    spawn(&mut world, "CUBE-1", "cube", &at(-0.55, -0.1, 2.0));
    let mut lowest = f64::INFINITY;
    for _ in 0..240 {
        world.step();
        lowest = lowest.min(world.object_pose("CUBE-1").unwrap().translation.z);
        let hit = world.deepest_penetration(&AllowedPairs::none(), 0.01);
        assert!(hit.is_none(), "{hit:?}");
    }
    assert!(lowest > 0.3, "it fell to {lowest} m");
}

#[test]
fn a_robot_that_comes_from_afar_pushes_what_is_in_its_way() {
    let mut world = robot_that_has_left();
    spawn(&mut world, "CUBE-1", "cube", &at(0.3, -0.1, 0.035));
    assert!(world.come_to_rest("CUBE-1", 5.0).unwrap());
    let before = world.object_pose("CUBE-1").unwrap().translation.x;
    let deepest = drive(&mut world, [0.2, -0.1], 960);
    let after = world.object_pose("CUBE-1").unwrap().translation.x;
    assert!(after > before + 0.1, "from {before} m to {after} m");
    assert!(deepest < 0.002, "{deepest} m");
    // It was pushed, not thrown.
    let base = world.robot_configuration().base.translation.x;
    assert!(after < base + 0.6, "{after} m before {base} m");
}

#[test]
fn a_restored_world_knows_what_has_stayed_behind() {
    let mut world = robot_that_has_left();
    spawn(&mut world, "CUBE-1", "cube", &at(0.0, -0.1, 0.035));
    let before = world.snapshot();
    let mut again = world.clone();
    drive(&mut again, [0.3, 0.1], 480);
    again.restore(&before);
    drive(&mut world, [0.1, -0.1], 480);
    drive(&mut again, [0.1, -0.1], 480);
    assert_eq!(world.hash(), again.hash());
}
