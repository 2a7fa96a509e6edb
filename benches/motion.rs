//! What planning and moving cost: `cargo bench --bench motion`.
#![allow(missing_docs)]

#[path = "../tests/motion_support/mod.rs"]
mod motion_support;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use motion_support::Kitchen;
use planwright::motion::drive_plan::plan_drive;
use planwright::motion::trajectory::{AxisGroup, Corners, Trajectory};
use planwright::motion::{CollisionMode, Motion, TcpPath};
use planwright::robot::Side;

fn trajectories(c: &mut Criterion) {
    let points: Vec<Vec<f64>> = (0..16)
        .map(|i| (0..8).map(|j| f64::from(i * j) * 0.01).collect())
        .collect();
    let limits: Vec<_> = (0..8)
        .map(|axis| AxisGroup::single(axis, 1.5, 4.0))
        .collect();
    c.bench_function("trajectory of 16 points and 8 axes", |b| {
        b.iter(|| Trajectory::new(&points, &limits, Corners::Round));
    });
    let way = Trajectory::new(&points, &limits, Corners::Round);
    c.bench_function("a place on it", |b| {
        b.iter(|| way.position(way.duration() / 2.0))
    });
}

fn drives(c: &mut Criterion) {
    let cases = [
        (
            "straight",
            [0.0, 0.0, 0.0],
            [-1.447, -0.15, -std::f64::consts::FRAC_PI_2],
        ),
        (
            "from the table to the island",
            [-1.447, -0.15, -90.0],
            [-0.15, 2.0, std::f64::consts::PI],
        ),
        ("through the passage", [0.0, 0.0, 0.0], [-2.6, 1.5, 0.7]),
    ];
    for (name, [x, y, yaw], goal) in cases {
        let kitchen = Kitchen::parked(x, y, yaw, 0.0);
        c.bench_function(&format!("plan a drive, {name}"), |b| {
            b.iter(|| plan_drive(&kitchen.world, goal));
        });
    }
}

/// The first tick of a motion: its planning.
fn first_tick(
    c: &mut Criterion,
    name: &str,
    kitchen: &Kitchen,
    motion: impl Fn() -> Box<dyn Motion>,
) {
    c.bench_function(name, |b| {
        b.iter_batched(
            || (kitchen.world.clone(), motion()),
            |(mut world, mut motion)| motion.tick(&mut world),
            BatchSize::SmallInput,
        );
    });
}

fn arms(c: &mut Criterion) {
    let start = Kitchen::new();
    first_tick(c, "plan parking both arms from the start", &start, || {
        Box::new(start.park(true, true))
    });
    let mut kitchen = Kitchen::parked(-1.447, -0.15, -90.0, 0.3);
    kitchen.spawn_bottle(-1.6, -0.9, 0.83);
    let poses = kitchen.grasp_poses(Side::Right, "left-side", &kitchen.in_base("bottle-1"));
    let reach = |pose, path| kitchen.tcp(Side::Right, pose, path, CollisionMode::AllowHand);
    first_tick(c, "plan reaching for a bottle", &kitchen, || {
        Box::new(reach(poses.second_pregrasp, TcpPath::Free))
    });
    let far = kitchen.grasp_poses(Side::Right, "right-side", &kitchen.in_base("bottle-1"));
    first_tick(c, "find out that a pose is unreachable", &kitchen, || {
        Box::new(reach(far.grasp, TcpPath::Free))
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = trajectories, drives, arms
}
criterion_main!(benches);
