//! What happens while robot and kitchen move, and that it happens again in the same way.

use crate::robot::Side;
use crate::tests::world::fixture::{at, carry, models, set_joint, spawn, world};
use crate::world::{AllowedPairs, BodyName, World};
use spatial::Pose;
use spatial::pose::{distance_between, from_xy_yaw};

/// A robot in free space with a bottle in the open right hand, welded to its palm.
pub(crate) fn world_with_held_bottle() -> World {
    let models = models();
    let mut robot = carry(&models, [0.3, -0.5, 0.0], 0.2);
    set_joint(&models, &mut robot, "r_gripper_l_finger_joint", 0.5);
    let mut world = World::new(models, robot);
    let palm = world.models().description.arm(Side::Right).gripper.palm;
    let grip = world.link_pose(palm) * Pose::translation(0.18, 0.0, 0.0);
    let report = spawn(&mut world, "BOTTLE-1", "bottle", &grip);
    assert_eq!(report.blocked_by, None);
    assert_eq!(report.pose, grip);
    world.attach("BOTTLE-1", palm).unwrap();
    world
}

#[test]
fn a_welded_object_goes_where_the_hand_goes() {
    let mut world = world_with_held_bottle();
    let mut robot = world.robot_configuration().clone();
    let mut worst = 0.0f64;
    // 1 m forward while turning by 60 degrees, at half a metre a second, from rest to rest.
    for i in 0..=960 {
        let s = f64::from(i) / 960.0;
        let s = s * s * (3.0 - 2.0 * s);
        robot.base = from_xy_yaw(0.3, -0.5 + s, s);
        world.set_robot_configuration(&robot);
        world.step();
        worst = worst.max(world.weld_error("BOTTLE-1").unwrap().unwrap().distance);
    }
    assert!(worst < 1e-3, "the bottle lagged by {worst} m");
    let palm = world.models().description.arm(Side::Right).gripper.palm;
    let wanted = world.link_pose(palm) * Pose::translation(0.18, 0.0, 0.0);
    let real = world.object_pose("BOTTLE-1").unwrap();
    assert!(distance_between(&wanted, &real) < 1e-3);
}

#[test]
fn a_full_turn_of_the_heading_is_no_motion() {
    let mut world = world_with_held_bottle();
    let mut robot = world.robot_configuration().clone();
    // The heading is the same, the sign of its quaternion is not.
    robot.base = from_xy_yaw(0.3, -0.5, std::f64::consts::TAU);
    world.set_robot_configuration(&robot);
    for _ in 0..10 {
        world.step();
    }
    let error = world.weld_error("BOTTLE-1").unwrap().unwrap();
    assert!(error.distance < 1e-3, "the bottle lags by {error:?}");
}

#[test]
fn a_released_object_falls() {
    let mut world = world_with_held_bottle();
    let before = world.object_pose("BOTTLE-1").unwrap().translation.z;
    world.detach("BOTTLE-1").unwrap();
    assert_eq!(world.weld_error("BOTTLE-1").unwrap(), None);
    world.settle(10.0);
    assert!(world.object_pose("BOTTLE-1").unwrap().translation.z < before - 0.3);
}

#[test]
fn closing_fingers_feel_the_object_between_them() {
    let mut world = world_with_held_bottle();
    let models = world.models().clone();
    let mut robot = world.robot_configuration().clone();
    let pressed = |world: &World| {
        world.finger_contacts(Side::Right).map(|contacts| {
            contacts
                .iter()
                .filter(|c| c.body == BodyName::Object("BOTTLE-1".to_owned()))
                .map(|c| c.force)
                .sum::<f64>()
        })
    };
    assert_eq!(pressed(&world), [0.0, 0.0]);
    let mut angle = 0.5;
    while angle > 0.0 && !pressed(&world).iter().all(|force| *force > 2.0) {
        angle -= 0.5 / 240.0;
        set_joint(&models, &mut robot, "r_gripper_l_finger_joint", angle);
        world.set_robot_configuration(&robot);
        world.step();
    }
    // A bottle of 71 mm fits between the pads at 0.413 rad.
    assert!(
        (angle - 0.413).abs() < 0.015,
        "the fingers closed to {angle} rad"
    );
    assert!(
        world
            .deepest_penetration(&AllowedPairs::none(), 0.002)
            .is_none()
    );
}

#[test]
fn a_drawer_takes_along_what_is_in_it() {
    const DRAWER: &str = "sink_area_left_upper_drawer_main_joint";
    let mut world = world();
    world.teleport_kitchen_joint(DRAWER, 0.4).unwrap();
    let front = 1.25 - 0.4 + 0.15;
    spawn(&mut world, "CUBE-1", "cube", &at(front, 0.9, 0.78));
    assert!(world.settle(5.0));
    let before = world.object_pose("CUBE-1").unwrap();
    let mut position = 0.4;
    while position > 0.1 {
        position -= 0.2 / 240.0;
        world.set_kitchen_joint(DRAWER, position).unwrap();
        world.step();
    }
    world.settle(2.0);
    let after = world.object_pose("CUBE-1").unwrap();
    let moved = after.translation.x - before.translation.x;
    assert!(
        (moved - (0.4 - world.kitchen_joint(DRAWER).unwrap())).abs() < 2e-3,
        "{moved}"
    );
    assert!((after.translation.z - before.translation.z).abs() < 1e-3);
}

#[test]
fn a_kitchen_joint_stays_within_its_limits() {
    let mut world = world();
    let joint = "iai_fridge_door_joint";
    assert_eq!(
        world.set_kitchen_joint(joint, 9.0),
        Ok(std::f64::consts::FRAC_PI_2)
    );
    assert!(world.kitchen_joint("fridge_door_joint").is_err());
}

/// Things fall over each other while the robot moves through the room.
pub(crate) fn turmoil(world: &mut World, steps: u32) -> u64 {
    let mut robot = world.robot_configuration().clone();
    let models = world.models().clone();
    for i in 0..steps {
        let t = f64::from(i) / 240.0;
        robot.base = from_xy_yaw(0.3 * t, 0.1 * t, 0.2 * t);
        set_joint(&models, &mut robot, "torso_lift_joint", 0.15 + 0.05 * t);
        world.set_robot_configuration(&robot);
        world.step();
    }
    world.hash()
}

pub(crate) fn world_with_a_pile() -> World {
    let mut world = world();
    for i in 0..6 {
        let name = format!("THING-{i}");
        let thing = if i % 2 == 0 { "bottle" } else { "cube" };
        let i = f64::from(i);
        spawn(
            &mut world,
            &name,
            thing,
            &at(0.6 + 0.01 * i, 0.02, 1.0 + 0.2 * i),
        );
    }
    world
}

#[test]
fn the_same_run_has_the_same_bits() {
    let [one, two] = [0; 2].map(|_| turmoil(&mut world_with_a_pile(), 600));
    assert_eq!(one, two);
}

#[test]
fn a_restored_world_goes_on_with_the_same_bits() {
    let mut world = world_with_a_pile();
    turmoil(&mut world, 100);
    let snapshot = world.snapshot();
    let hash = world.hash();
    let first = turmoil(&mut world, 300);
    world.remove("THING-3").unwrap();
    spawn(&mut world, "LATER", "bottle", &at(-1.0, -0.9, 0.9));
    world.restore(&snapshot);
    assert_eq!(world.hash(), hash);
    assert_eq!(turmoil(&mut world, 300), first);
    let mut copy = world.clone();
    copy.restore(&snapshot);
    assert_eq!(turmoil(&mut copy, 300), first);
}

#[test]
fn queries_do_not_change_what_happens() {
    let mut quiet = world_with_a_pile();
    let mut asked = world_with_a_pile();
    for _ in 0..50 {
        quiet.step();
        asked.step();
        let robot = asked.robot_configuration().clone();
        let hits = asked
            .collision_checker()
            .all_hits(&robot, &AllowedPairs::none(), 0.05);
        let forces = asked.object_contacts("THING-0").unwrap();
        let _ = (
            hits,
            forces,
            asked.deepest_penetration(&AllowedPairs::none(), 0.0),
        );
    }
    assert_eq!(quiet.hash(), asked.hash());
}

#[test]
fn a_standing_bottle_is_carried_with_its_weight() {
    let mut world = world();
    spawn(&mut world, "BOTTLE-1", "bottle", &at(-1.6, -0.9, 0.82));
    world.settle(5.0);
    let force = world.support_force("BOTTLE-1").unwrap();
    assert!((force - 0.2 * 9.81).abs() < 0.05, "{force} N");
    let supports = world.supports("BOTTLE-1").unwrap();
    assert_eq!(supports.len(), 1);
    assert_eq!(supports[0].body.to_string(), "table_area_main");
}

#[test]
fn a_teleported_robot_takes_along_what_it_holds_and_nothing_else() {
    let mut world = world_with_held_bottle();
    spawn(&mut world, "CUBE-1", "cube", &at(-1.6, -0.9, 0.8));
    // Until it does not even creep.
    for _ in 0..480 {
        world.step();
    }
    let cube_before = world.object_pose("CUBE-1").unwrap();
    let mut robot = world.robot_configuration().clone();
    robot.base = from_xy_yaw(-0.2, 1.0, 1.0);
    world.teleport_robot(&robot);
    assert!(world.weld_error("BOTTLE-1").unwrap().unwrap().distance < 1e-9);
    for _ in 0..240 {
        world.step();
    }
    assert!(world.weld_error("BOTTLE-1").unwrap().unwrap().distance < 1e-3);
    assert!(distance_between(&cube_before, &world.object_pose("CUBE-1").unwrap()) < 1e-6);
}
