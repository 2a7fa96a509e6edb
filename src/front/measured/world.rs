//! World steps, snapshots, collision checks, and what the robot sees.

use std::hint::black_box;

use super::{AT_TABLE, Stopwatch, models, parked, spawn};
use robotics::perception::Sight;
use robotics::world::{AllowedPairs, Models, RobotConfiguration, World};

/// The kitchen with ten objects at rest and the robot in front of the table.
fn furnished() -> World {
    let models = models();
    let robot = parked(&models, AT_TABLE, 0.3);
    let mut world = World::new(models, robot);
    let bottles = [
        [-1.6, -0.9, 0.82],
        [-2.0, -0.9, 0.82],
        [-1.0, -0.75, 0.82],
        [-1.3, -1.2, 0.82],
        [-1.0, 0.75, 0.96],
        [-0.8, 2.0, 0.96],
    ];
    for (i, at) in bottles.into_iter().enumerate() {
        spawn(&mut world, &format!("BOTTLE-{i}"), "bottle", at);
    }
    let cubes = [[1.44, 0.8, 0.95], [-0.9, 1.5, 0.95], [-1.2, 1.5, 0.95]];
    for (i, at) in cubes.into_iter().enumerate() {
        spawn(&mut world, &format!("CUBE-{i}"), "cube", at);
    }
    spawn(&mut world, "WURST", "weisswurst", [1.5, 1.0, 0.9]);
    assert!(world.settle(10.0));
    for _ in 0..480 {
        world.step();
    }
    world
}

fn set_joint(models: &Models, robot: &mut RobotConfiguration, name: &str, position: f64) {
    let joint = models.robot.joint_named(name);
    robot.joints.set(joint.expect("the PR2 has it"), position);
}

/// A single world step.
pub fn steps(stopwatch: &mut dyn Stopwatch) {
    let mut world = furnished();
    stopwatch.repeated("step, ten objects asleep", &mut || world.step());

    let mut world = furnished();
    let mut robot = world.robot_configuration().clone();
    let models = world.models().clone();
    let mut t = 0.0;
    let name = "step, ten objects asleep, arms and torso moving";
    stopwatch.repeated(name, &mut || {
        t += 0.002;
        let torso = 0.2 + 0.1 * f64::sin(t);
        set_joint(&models, &mut robot, "torso_lift_joint", torso);
        let shoulder = -1.7 + 0.2 * f64::sin(t);
        set_joint(&models, &mut robot, "r_shoulder_pan_joint", shoulder);
        world.set_robot_configuration(&robot);
        world.step();
    });

    let mut world = furnished();
    world.keep_objects_awake();
    stopwatch.repeated("step, ten objects awake", &mut || world.step());
}

/// Taking a snapshot and restoring it.
pub fn snapshots(stopwatch: &mut dyn Stopwatch) {
    let mut world = furnished();
    stopwatch.repeated("snapshot and drop", &mut || {
        black_box(world.snapshot());
    });
    let snapshot = world.snapshot();
    stopwatch.repeated("restore", &mut || world.restore(&snapshot));
    stopwatch.repeated("hash", &mut || {
        black_box(world.hash());
    });
}

/// Whether a robot configuration collides.
pub fn collisions(stopwatch: &mut dyn Stopwatch) {
    let world = furnished();
    let none = AllowedPairs::none();
    let free = world.robot_configuration().clone();
    stopwatch.repeated("make a collision checker", &mut || {
        black_box(world.collision_checker());
    });
    let mut checker = world.collision_checker();
    stopwatch.repeated("check a free configuration", &mut || {
        black_box(checker.first_hit(&free, &none, 0.0));
    });
    let name = "check a free configuration with 1 cm margin";
    stopwatch.repeated(name, &mut || {
        black_box(checker.first_hit(&free, &none, 0.01));
    });
    let mut robots = Vec::new();
    for i in 0..30 {
        for j in 0..20 {
            let (x, y) = (-3.6 + 0.18 * f64::from(i), -1.8 + 0.23 * f64::from(j));
            let at = [x, y, f64::from(i * 37 + j * 91)];
            robots.push(parked(world.models(), at, 0.1));
        }
    }
    // Most of these poses are blocked by furniture.
    let mut places = robots.iter().cycle();
    stopwatch.repeated("check base poses until the first hit", &mut || {
        black_box(
            places
                .next()
                .map(|robot| checker.first_hit(robot, &none, 0.0)),
        );
    });
    stopwatch.repeated("is a base pose free", &mut || {
        black_box(
            places
                .next()
                .map(|robot| checker.is_free(robot, &none, 0.0)),
        );
    });
    stopwatch.repeated("all hits of base poses", &mut || {
        black_box(
            places
                .next()
                .map(|robot| checker.all_hits(robot, &none, 0.0)),
        );
    });
    stopwatch.repeated("clearance within 0.3 m", &mut || {
        black_box(checker.clearance(&free, &none, 0.3));
    });
}

/// What the robot's camera sees.
pub fn sight(stopwatch: &mut dyn Stopwatch) {
    let world = furnished();
    stopwatch.repeated("what the camera sees", &mut || {
        black_box(Sight::of_robot(&world));
    });
    let sight = Sight::of_robot(&world);
    stopwatch.repeated("visibility of one object", &mut || {
        black_box(sight.visibility("BOTTLE-0").is_ok());
    });
}
