//! What the robot touches in the kitchen, and how far it is from everything.
//!
//! Expected numbers are those of the PR2's and the kitchen's meshes. The robot's primitives
//! are up to 2 cm larger than its meshes, never smaller by more than a few millimetres.

use crate::robot::Side;
use crate::tests::world::fixture::{at, carry, models, set_joint, spawn, tucked};
use crate::world::{AllowedPairs, BodyName, Models, RobotConfiguration, World};
use spatial::pose::from_xyz_rpy;

fn empty_world() -> World {
    let models = models();
    let robot = tucked(&models, [0.0; 3], 0.15);
    World::new(models, robot)
}

fn is_free(world: &World, robot: &RobotConfiguration) -> bool {
    world
        .collision_checker()
        .is_free(robot, &AllowedPairs::none(), 0.0)
}

#[test]
fn distances_to_the_kitchen_are_those_of_the_meshes() {
    let world = empty_world();
    let models = world.models();
    // Base pose, then the gap for: carry at torso 0 and 0.3, tucked at torso 0 and 0.3.
    let table = [
        ([0.0, 0.0, 0.0], [0.346, 0.448, 0.452, 0.452]),
        ([0.0, 1.0, 0.0], [0.328, 0.350, 0.328, 0.350]),
        ([-1.447, -0.15, -90.0], [0.212, 0.321, 0.206, 0.139]),
        ([-0.15, 2.0, 180.0], [0.158, 0.241, 0.223, 0.151]),
    ];
    // The shoulders are nearer to the floor than to any furniture.
    let links = models
        .robot
        .links()
        .map(|(link, _)| models.robot_body(link));
    let none = AllowedPairs::none().and_all(links, &BodyName::Floor);
    for (at, expected) in table {
        let robots = [
            carry(models, at, 0.0),
            carry(models, at, 0.3),
            tucked(models, at, 0.0),
            tucked(models, at, 0.3),
        ];
        for (robot, expected) in robots.iter().zip(expected) {
            let mut checker = world.collision_checker();
            let nearest = checker.clearance(robot, &none, 0.6).unwrap();
            let gap = nearest.distance;
            assert!(
                (expected - 0.02..expected + 0.006).contains(&gap),
                "{at:?}: {nearest:?}"
            );
            assert_eq!(checker.first_hit(robot, &none, 0.0), None, "{at:?}");
        }
    }
}

/// The first and last free place along a line through a free place, in steps of 1 cm.
fn free_range(
    world: &World,
    robot_at: impl Fn(&Models, f64) -> RobotConfiguration,
    inside: f64,
) -> (f64, f64) {
    let reach = |direction: f64| {
        let mut place = inside;
        while (place - inside).abs() < 3.0
            && is_free(world, &robot_at(world.models(), place + direction * 0.01))
        {
            place += direction * 0.01;
        }
        place
    };
    (reach(-1.0), reach(1.0))
}

#[test]
fn the_robot_can_drive_as_far_as_the_kitchen_allows() {
    let world = empty_world();
    // Where the line is, a free place on it, the free range at torso 0.
    type Line = (&'static str, fn(f64) -> [f64; 3], f64, (f64, f64));
    let lines: [Line; 6] = [
        (
            "towards the table",
            |y| [-1.447, y, -90.0],
            -0.15,
            (-0.57, 0.15),
        ),
        (
            "towards the island",
            |x| [x, 2.0, 180.0],
            0.0,
            (-0.35, 0.83),
        ),
        ("towards the sink", |x| [x, 1.0, 0.0], 0.0, (-0.32, 0.87)),
        (
            "towards the fridge",
            |x| [x, -1.04, 0.0],
            0.0,
            (-0.26, 0.91),
        ),
        (
            "towards the short edge",
            |y| [-1.0, y, 90.0],
            0.0,
            (-0.31, 0.25),
        ),
        (
            "behind the island",
            |x| [x, 0.75, 0.0],
            -2.5,
            (-3.46, -1.71),
        ),
    ];
    for (name, line, inside, expected) in lines {
        let range = free_range(&world, |models, s| carry(models, line(s), 0.0), inside);
        assert!(
            (range.0 - expected.0).abs() < 0.035 && (range.1 - expected.1).abs() < 0.035,
            "{name}: {range:?}"
        );
    }
}

#[test]
fn a_hit_names_the_pair_and_the_depth() {
    let world = empty_world();
    let robot = carry(world.models(), [-1.447, -0.6, -90.0], 0.0);
    let hits = world
        .collision_checker()
        .all_hits(&robot, &AllowedPairs::none(), 0.0);
    let pairs: Vec<_> = hits
        .iter()
        .map(|h| format!("{} - {}", h.moving, h.other))
        .collect();
    assert!(
        pairs.contains(&"r_shoulder_pan_link - table_area_main".to_owned()),
        "{pairs:?}"
    );
    assert!(hits.iter().all(|h| h.depth > 0.0 && h.depth < 0.1));
    assert!((hits[0].depth - 0.031).abs() < 1e-3, "{}", hits[0].depth);
}

#[test]
fn wheels_may_be_near_the_floor_and_nothing_else_may_be_in_it() {
    let world = empty_world();
    let mut robot = carry(world.models(), [0.0; 3], 0.0);
    assert!(
        world
            .collision_checker()
            .is_free(&robot, &AllowedPairs::none(), 0.01)
    );
    robot.base.translation.z = -0.06;
    let hit = world
        .collision_checker()
        .first_hit(&robot, &AllowedPairs::none(), 0.0)
        .unwrap();
    assert_eq!(
        (hit.moving.to_string(), hit.other),
        ("base_link".to_owned(), BodyName::Floor)
    );
    assert!((hit.depth - 0.009).abs() < 1e-9);
}

#[test]
fn arms_that_cross_each_other_collide() {
    let world = empty_world();
    let mut robot = carry(world.models(), [0.0; 3], 0.2);
    // Both arms straight ahead and turned inwards.
    for (side, pan) in [("l", -0.3), ("r", 0.3)] {
        for joint in [
            "shoulder_lift",
            "upper_arm_roll",
            "elbow_flex",
            "forearm_roll",
            "wrist_flex",
        ] {
            set_joint(
                world.models(),
                &mut robot,
                &format!("{side}_{joint}_joint"),
                0.0,
            );
        }
        set_joint(
            world.models(),
            &mut robot,
            &format!("{side}_shoulder_pan_joint"),
            pan,
        );
    }
    let hit = world
        .collision_checker()
        .first_hit(&robot, &AllowedPairs::none(), 0.0)
        .unwrap();
    let sides: Vec<_> = [hit.moving, hit.other]
        .iter()
        .map(|b| b.to_string()[..2].to_owned())
        .collect();
    assert!(
        sides.contains(&"l_".to_owned()) && sides.contains(&"r_".to_owned()),
        "{sides:?}"
    );
}

#[test]
fn objects_are_met_unless_the_pair_is_allowed() {
    let mut world = empty_world();
    spawn(&mut world, "BOTTLE-1", "bottle", &at(-1.6, -0.9, 0.82));
    world.settle(2.0);
    let models = world.models().clone();
    let palm = models.description.arm(Side::Right).gripper.palm;
    // Drive so that the right palm is at the bottle.
    let mut robot = carry(&models, [0.0, 0.0, -90.0], 0.0);
    let palm_pose = models.robot.link_pose(palm, &robot.base, &robot.joints);
    let bottle = world.object_pose("BOTTLE-1").unwrap();
    let shift = bottle.translation.vector - palm_pose.translation.vector;
    robot.base.translation.vector += shift;
    let name = BodyName::Object("BOTTLE-1".to_owned());
    let meets = |allowed: &AllowedPairs| {
        let hits = world.collision_checker().all_hits(&robot, allowed, 0.0);
        hits.iter()
            .filter(|h| h.other == name)
            .map(|h| h.moving.clone())
            .collect::<Vec<_>>()
    };
    let touching = meets(&AllowedPairs::none());
    assert!(
        touching
            .iter()
            .any(|b| b.to_string() == "r_gripper_palm_link"),
        "{touching:?}"
    );
    assert!(meets(&AllowedPairs::none().and_all(touching, &name)).is_empty());
}

#[test]
fn a_held_object_is_judged_where_the_hand_would_be() {
    let mut world = empty_world();
    let models = world.models().clone();
    let palm = models.description.arm(Side::Right).gripper.palm;
    let mut robot = carry(&models, [0.3, -0.5, 0.0], 0.2);
    set_joint(&models, &mut robot, "r_gripper_l_finger_joint", 0.5);
    world.teleport_robot(&robot);
    let grip = world.link_pose(palm) * from_xyz_rpy([0.18, 0.0, 0.0], [0.0; 3]);
    spawn(&mut world, "BOTTLE-1", "bottle", &grip);
    world.attach("BOTTLE-1", palm).unwrap();
    assert!(is_free(&world, &robot));
    let mut low = robot.clone();
    low.base.translation.z = -(grip.translation.z - 0.05);
    let hits = world
        .collision_checker()
        .all_hits(&low, &AllowedPairs::none(), 0.0);
    let held = BodyName::Object("BOTTLE-1".to_owned());
    assert!(
        hits.iter()
            .any(|h| h.moving == held && h.other == BodyName::Floor)
    );
}
