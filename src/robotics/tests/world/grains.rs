//! Grains in vessels, in hands and on the floor.

use super::fixture::{at, carry, models, spawn, world};
use crate::robot::Side;
use crate::world::content::tilt_of;
use crate::world::{Packer, World, WorldError};
use spatial::pose::from_xyz_rpy;

const RICE: [f32; 4] = [1.0; 4];

fn counts(world: &World, name: &str) -> usize {
    world.grains_in(name).unwrap().iter().map(|(_, n)| n).sum()
}

fn pass(world: &mut World, seconds: f64) {
    for _ in 0..(seconds * 240.0) as u32 {
        world.step();
    }
}

/// A cup on the island with so many grains.
fn filled_cup(count: usize) -> World {
    let mut world = world();
    spawn(&mut world, "cup", "cup", &at(-0.8, 1.8, 0.95));
    world.fill_with_grains("cup", "rice", count, RICE).unwrap();
    world
}

/// A cup with so many grains, held 20 cm above a bowl on the floor, and the wrist's roll.
fn held_cup(count: usize) -> World {
    let models = models();
    let robot = carry(&models, [0.0, 0.0, 0.0], 0.15);
    let palm = models.description.arm(Side::Right).gripper.palm;
    let mut world = World::new(models, robot);
    let hand = world.link_pose(palm).translation;
    let bowl = from_xyz_rpy([hand.x + 0.25, hand.y, 0.05], [0.0; 3]);
    world.spawn("bowl", "bowl", &bowl, None, None).unwrap();
    world.settle(5.0);
    let cup = from_xyz_rpy([hand.x + 0.18, hand.y, hand.z], [0.0; 3]);
    world.spawn("cup", "cup", &cup, None, None).unwrap();
    world.attach("cup", palm).unwrap();
    world.fill_with_grains("cup", "rice", count, RICE).unwrap();
    world
}

#[test]
fn grains_lie_still_in_a_cup_and_cost_nothing_then() {
    let mut world = filled_cup(80);
    pass(&mut world, 3.0);
    assert_eq!(world.grains_in("cup").unwrap(), [("rice", 80)]);
    assert!(world.is_at_rest() && world.sleeps());
    assert_eq!(world.awake(), 0);
    // They stand on nothing but the cup, and that on the island.
    let supports = world.supports("cup").unwrap();
    let names: Vec<String> = supports.iter().map(|s| s.body.to_string()).collect();
    assert_eq!(names, ["kitchen_island_surface"]);
    assert_eq!(world.grains_spilled_from("cup").unwrap(), 0);
}

#[test]
fn grains_ride_in_a_vessel_that_is_carried_level_and_leave_it_when_it_is_tilted() {
    let mut world = held_cup(50);
    assert!(tilt_of(&world.object_pose("cup").unwrap()) < 0.05);
    pass(&mut world, 2.0);
    assert_eq!(counts(&world, "cup"), 50);
    assert!(world.sleeps());
    // Away with all, and on its side.
    let mut robot = world.robot_configuration().clone();
    robot.base.translation.x -= 1.0;
    world.teleport_robot(&robot);
    pass(&mut world, 1.0);
    assert_eq!(counts(&world, "cup"), 50);
    let arm = world.models().description.arm(Side::Right);
    let roll = *arm.joints().last().unwrap();
    let turned = robot.joints.get(roll) + 2.0;
    robot.joints.set(roll, turned);
    world.teleport_robot(&robot);
    assert!(tilt_of(&world.object_pose("cup").unwrap()) > 1.5);
    assert_eq!(counts(&world, "cup"), 50);
    pass(&mut world, 4.0);
    let left = counts(&world, "cup");
    let spilled = world.grains_spilled_from("cup").unwrap();
    assert!(left < 5, "{left} have stayed");
    assert_eq!((left + spilled, counts(&world, "bowl")), (50, 0));
    assert_eq!(world.remove_spilled_grains(), spilled);
    assert_eq!(world.grain_count(), left);
}

#[test]
fn grains_that_fall_on_those_that_ride_lie_on_them() {
    let mut world = held_cup(30);
    pass(&mut world, 2.0);
    assert!(world.sleeps());
    // Out of a cup upside down, the grains of which are those of another kind.
    let cup = world.object_pose("cup").unwrap().translation;
    let over = at(cup.x, cup.y, cup.z + 0.3);
    spawn(&mut world, "other", "cup", &over);
    world.move_object("other", &over).unwrap();
    world.fill_with_grains("other", "peas", 20, RICE).unwrap();
    let turned = from_xyz_rpy([cup.x, cup.y, cup.z + 0.16], [3.1, 0.0, 0.0]);
    world.move_object("other", &turned).unwrap();
    for _ in 0..240 {
        world.step();
        for (_, places) in world.grains() {
            for (i, one) in places.iter().enumerate() {
                for other in &places[..i] {
                    assert!((one - other).norm() > 0.009, "grains in each other");
                }
            }
        }
        world.remove("other").ok();
    }
    let all: Vec<_> = world.grains().flat_map(|(_, places)| places).collect();
    for (i, one) in all.iter().enumerate() {
        for other in &all[..i] {
            assert!((one - other).norm() > 0.0105, "grains in each other");
        }
    }
    let found = world.grains_in("cup").unwrap();
    assert_eq!(found.first(), Some(&("rice", 30)));
    assert!(
        found.get(1).is_some_and(|(_, peas)| *peas >= 10),
        "{found:?}"
    );
}

#[test]
fn grains_go_along_with_a_vessel_that_is_put_elsewhere() {
    let mut world = filled_cup(30);
    pass(&mut world, 1.0);
    world.move_object("cup", &at(1.4, 0.6, 0.95)).unwrap();
    pass(&mut world, 1.0);
    assert_eq!(counts(&world, "cup"), 30);
    // Without it, they fall where they are.
    world.remove("cup").unwrap();
    pass(&mut world, 1.0);
    assert_eq!(world.remove_spilled_grains(), 30);
}

#[test]
fn what_grains_do_not_get_into_is_refused() {
    let mut world = filled_cup(10);
    spawn(&mut world, "milk", "milk", &at(-0.8, 2.3, 0.98));
    let most = world.grains_that_fit("cup").unwrap().unwrap();
    assert!((80..140).contains(&most), "{most}");
    assert_eq!(world.grains_that_fit("milk").unwrap(), None);
    for (name, count) in [("milk", 1), ("cup", most + 1)] {
        let refused = world.fill_with_grains(name, "rice", count, RICE);
        let name = name.to_owned();
        assert_eq!(refused, Err(WorldError::NoRoomForGrains { name }));
    }
    assert_eq!(counts(&world, "cup"), 10);
    // A spoon in it takes room.
    spawn(
        &mut world,
        "spoon",
        "spoon",
        &from_xyz_rpy([-0.8, 1.8, 0.93], [0.0, 1.5, 0.0]),
    );
    let beside = world.grains_that_fit("cup").unwrap().unwrap();
    assert!(beside < most, "{beside} of {most}");
    world
        .fill_with_grains("cup", "rice", most / 2, RICE)
        .unwrap();
    assert_eq!(world.grain_count(), most / 2);
    world.remove_all();
    assert_eq!(world.grain_count(), 0);
}

#[test]
fn a_world_with_grains_goes_on_from_a_snapshot_with_the_same_bits() {
    let mut packer = Packer::default();
    let mut world = held_cup(40);
    let mut kept = Vec::new();
    for step in 0..6 {
        pass(&mut world, 0.3);
        if step == 3 {
            let mut robot = world.robot_configuration().clone();
            let arm = world.models().description.arm(Side::Right);
            let roll = *arm.joints().last().unwrap();
            let turned = robot.joints.get(roll) + 2.0;
            robot.joints.set(roll, turned);
            world.teleport_robot(&robot);
            world.step();
        }
        let packed = packer.pack(&world.snapshot()).unwrap();
        let mut later = world.clone();
        pass(&mut later, 0.5);
        kept.push((packed, world.hash(), later.hash()));
    }
    for (packed, hash, later) in kept.iter().rev() {
        world.restore_packed(packed);
        assert_eq!(world.hash(), *hash);
        pass(&mut world, 0.5);
        assert_eq!(world.hash(), *later);
    }
}
