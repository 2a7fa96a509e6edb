//! Packed snapshots: little memory, the same bits.

use crate::robot::Side;
use crate::tests::world::fixture::{at, set_joint, spawn};
use crate::tests::world::motion::{turmoil, world_with_a_pile, world_with_held_bottle};
use crate::world::{Packed, Packer, World};
use spatial::pose::from_xy_yaw;

/// The state of the world, packed.
fn packed(packer: &mut Packer, world: &World) -> Packed {
    let packed = packer.pack(&world.snapshot());
    packed.expect("no joint is new")
}

/// The hash after every tenth step, so that differences show when they begin.
fn hashes(world: &mut World, steps: u32) -> Vec<u64> {
    (0..steps / 10).map(|_| turmoil(world, 10)).collect()
}

#[test]
fn a_world_goes_on_from_a_packed_snapshot_with_the_same_bits() {
    let mut packer = Packer::default();
    let mut world = world_with_a_pile();
    let mut kept = Vec::new();
    // While all fall, while they come to rest on each other, and when they sleep.
    for steps in [0, 1, 20, 40, 60, 100, 200, 600, 0] {
        turmoil(&mut world, steps);
        let packed = packed(&mut packer, &world);
        kept.push((packed, world.hash(), hashes(&mut world.clone(), 300)));
    }
    world.remove("THING-3").unwrap();
    spawn(&mut world, "LATER", "bottle", &at(-1.0, -0.9, 0.9));
    turmoil(&mut world, 50);
    for (packed, hash, later) in kept.iter().rev() {
        world.restore_packed(packed);
        assert_eq!(world.hash(), *hash);
        assert_eq!(hashes(&mut world, 300), *later);
    }
}

#[test]
fn a_packed_snapshot_says_what_was_changed_since_the_last_step() {
    let mut packer = Packer::default();
    let mut world = world_with_a_pile();
    turmoil(&mut world, 400);
    packed(&mut packer, &world);
    // None of it has been seen by a step.
    world.move_object("THING-0", &at(0.9, 0.3, 1.5)).unwrap();
    world.remove("THING-1").unwrap();
    spawn(&mut world, "LATER", "bottle", &at(-1.0, -0.9, 0.9));
    world
        .teleport_kitchen_joint("sink_area_left_upper_drawer_main_joint", 0.3)
        .unwrap();
    let packed = packed(&mut packer, &world);
    let later = hashes(&mut world.clone(), 300);
    turmoil(&mut world, 30);
    world.restore_packed(&packed);
    assert_eq!(hashes(&mut world, 300), later);
}

#[test]
fn a_packed_snapshot_says_what_a_hand_holds() {
    let mut packer = Packer::default();
    let mut world = world_with_held_bottle();
    // The weld is new.
    assert!(packer.pack(&world.snapshot()).is_none());
    let carried = |world: &mut World| {
        let mut robot = world.robot_configuration().clone();
        let models = world.models().clone();
        for i in 0..240 {
            let t = f64::from(i) / 240.0;
            robot.base = from_xy_yaw(0.3 + 0.2 * t, -0.5, 0.3 * t);
            set_joint(
                &models,
                &mut robot,
                "r_gripper_l_finger_joint",
                0.5 - 0.09 * t,
            );
            world.set_robot_configuration(&robot);
            world.step();
        }
        world.hash()
    };
    carried(&mut world);
    let held = packed(&mut packer, &world);
    let later = carried(&mut world.clone());
    // Having let go, or grasped anew, it is another matter.
    world.detach("BOTTLE-1").unwrap();
    assert!(packer.pack(&world.snapshot()).is_none());
    turmoil(&mut world, 100);
    packed(&mut packer, &world);
    world.restore_packed(&held);
    assert!(world.weld_error("BOTTLE-1").unwrap().is_some());
    assert_eq!(carried(&mut world), later);
    let palm = world.models().description.arm(Side::Right).gripper.palm;
    world.restore_packed(&held);
    world.detach("BOTTLE-1").unwrap();
    world.attach("BOTTLE-1", palm).unwrap();
    assert!(packer.pack(&world.snapshot()).is_none());
}

#[test]
fn a_restored_world_packs_into_the_same_bytes() {
    let mut packer = Packer::default();
    let mut world = world_with_a_pile();
    turmoil(&mut world, 60);
    packed(&mut packer, &world);
    turmoil(&mut world, 60);
    let before = packed(&mut packer, &world);
    let restored = before.unpacked();
    let again = packer.pack(&restored).unwrap();
    assert!(before.says_the_same_as(&again));
    turmoil(&mut world, 1);
    assert!(!before.says_the_same_as(&packed(&mut packer, &world)));
}

#[test]
fn packed_snapshots_take_little_memory() {
    let mut packer = Packer::default();
    let mut world = world_with_a_pile();
    turmoil(&mut world, 1000);
    let whole = world.snapshot().bytes();
    let mut bytes = 0;
    let mut shared = None;
    for number in 0..50 {
        turmoil(&mut world, 50);
        if number % 10 == 0 {
            let name = format!("LATER-{number}");
            spawn(
                &mut world,
                &name,
                "bottle",
                &at(-1.0, -0.9 + 0.01 * f64::from(number), 0.9),
            );
        }
        let packed = packed(&mut packer, &world);
        let (which, of_all) = packed.shared();
        if shared.replace(which) != Some(which) {
            bytes += of_all;
        }
        bytes += packed.bytes();
    }
    assert!(
        bytes / 50 < whole / 20,
        "{bytes} B for 50, {whole} B for one that is not packed"
    );
}
