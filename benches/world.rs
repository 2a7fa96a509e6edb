//! What the world costs: steps, snapshots, collision checks, pictures.
//!
//! Run with `cargo bench --bench world`.

#[path = "../tests/world_support/mod.rs"]
mod world_support;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use planwright::perception::Sight;
use planwright::world::{AllowedPairs, World};
use world_support::{at, carry, models, set_joint, spawn};

/// The kitchen with ten objects at rest and the robot in front of the table.
fn furnished() -> World {
    let models = models();
    let robot = carry(&models, [-1.447, -0.15, -90.0], 0.3);
    let mut world = World::new(models, robot);
    let places = [
        (-1.6, -0.9, 0.82),
        (-2.0, -0.9, 0.82),
        (-1.0, -0.75, 0.82),
        (-1.3, -1.2, 0.82),
        (-1.0, 0.75, 0.96),
        (-0.8, 2.0, 0.96),
    ];
    for (i, (x, y, z)) in places.into_iter().enumerate() {
        spawn(&mut world, &format!("BOTTLE-{i}"), "bottle", &at(x, y, z));
    }
    for (i, (x, y)) in [(1.44, 0.8), (-0.9, 1.5), (-1.2, 1.5)]
        .into_iter()
        .enumerate()
    {
        spawn(&mut world, &format!("CUBE-{i}"), "cube", &at(x, y, 0.95));
    }
    spawn(&mut world, "WURST", "weisswurst", &at(1.5, 1.0, 0.9));
    assert!(world.settle(10.0));
    for _ in 0..480 {
        world.step();
    }
    world
}

fn steps(c: &mut Criterion) {
    let mut world = furnished();
    c.bench_function("step, ten objects asleep", |b| b.iter(|| world.step()));

    let mut world = furnished();
    let mut robot = world.robot_configuration().clone();
    let models = world.models().clone();
    let mut t = 0.0;
    c.bench_function("step, ten objects asleep, arms and torso moving", |b| {
        b.iter(|| {
            t += 0.002;
            set_joint(
                &models,
                &mut robot,
                "torso_lift_joint",
                0.2 + 0.1 * f64::sin(t),
            );
            set_joint(
                &models,
                &mut robot,
                "r_shoulder_pan_joint",
                -1.7 + 0.2 * f64::sin(t),
            );
            world.set_robot_configuration(&robot);
            world.step();
        });
    });

    let mut world = furnished();
    world.keep_objects_awake();
    c.bench_function("step, ten objects awake", |b| b.iter(|| world.step()));
}

fn snapshots(c: &mut Criterion) {
    let mut world = furnished();
    c.bench_function("snapshot and drop", |b| {
        b.iter(|| black_box(world.snapshot()))
    });
    let snapshot = world.snapshot();
    c.bench_function("restore", |b| b.iter(|| world.restore(&snapshot)));
    c.bench_function("hash", |b| b.iter(|| black_box(world.hash())));
}

fn collisions(c: &mut Criterion) {
    let world = furnished();
    let models = world.models().clone();
    let none = AllowedPairs::none();
    let free = world.robot_configuration().clone();
    let mut poses = Vec::new();
    c.bench_function("forward kinematics of the robot", |b| {
        b.iter(|| {
            models
                .robot
                .forward_kinematics(&free.base, &free.joints, &mut poses)
        });
    });
    c.bench_function("make a collision checker", |b| {
        b.iter(|| black_box(world.collision_checker()))
    });
    let mut checker = world.collision_checker();
    c.bench_function("check a free configuration", |b| {
        b.iter(|| black_box(checker.first_hit(&free, &none, 0.0)));
    });
    c.bench_function("check a free configuration with 1 cm margin", |b| {
        b.iter(|| black_box(checker.first_hit(&free, &none, 0.01)));
    });
    let mut robots = Vec::new();
    for i in 0..30 {
        for j in 0..20 {
            let (x, y) = (-3.6 + 0.18 * f64::from(i), -1.8 + 0.23 * f64::from(j));
            robots.push(carry(&models, [x, y, f64::from(i * 37 + j * 91)], 0.1));
        }
    }
    let blocked = robots
        .iter()
        .filter(|r| !checker.is_free(r, &none, 0.0))
        .count();
    eprintln!("{blocked} of {} base poses are blocked", robots.len());
    let mut i = 0;
    c.bench_function("check random base poses with early out", |b| {
        b.iter(|| {
            i = (i + 1) % robots.len();
            black_box(checker.first_hit(&robots[i], &none, 0.0))
        });
    });
    c.bench_function("is a random base pose free", |b| {
        b.iter(|| {
            i = (i + 1) % robots.len();
            black_box(checker.is_free(&robots[i], &none, 0.0))
        });
    });
    c.bench_function("all hits of random base poses", |b| {
        b.iter(|| {
            i = (i + 1) % robots.len();
            black_box(checker.all_hits(&robots[i], &none, 0.0))
        });
    });
    c.bench_function("clearance within 0.3 m", |b| {
        b.iter(|| black_box(checker.clearance(&free, &none, 0.3)));
    });
}

fn pictures(c: &mut Criterion) {
    let world = furnished();
    c.bench_function("picture of 320 x 200", |b| {
        b.iter(|| black_box(Sight::of_robot(&world)));
    });
    let sight = Sight::of_robot(&world);
    c.bench_function("visibility of one object", |b| {
        b.iter(|| black_box(sight.visibility("BOTTLE-0").unwrap()));
    });
}

criterion_group!(benches, steps, snapshots, collisions, pictures);
criterion_main!(benches);
