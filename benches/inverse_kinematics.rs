//! Times of forward and inverse kinematics.
//!
//! `cargo bench --bench inverse_kinematics`

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use planwright::robot::{
    ArmPositions, KITCHEN_URDF, KinematicTree, PR2_DESCRIPTION, PR2_URDF, RobotDescription, Side,
};
use planwright::spatial::Pose;
use planwright::spatial::pose::from_xyz_rpy;

/// Shares 0..1 without any dependence on time or platform.
struct Shares(u64);

impl Iterator for Shares {
    type Item = f64;

    fn next(&mut self) -> Option<f64> {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        Some((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}

/// Wrist poses in the frame of the torso, of random joint positions within the soft limits.
fn reachable_poses(tree: &KinematicTree, pr2: &RobotDescription, side: Side) -> Vec<Pose> {
    let arm = pr2.arm(side);
    let mut shares = Shares(88_172_645_463_325_252);
    let mut share = || shares.next().unwrap_or_default();
    let mut poses = Vec::new();
    for _ in 0..10_000 {
        let mut q = tree.zero_positions();
        let positions: ArmPositions = arm.kinematics.limits().map(|limits| match limits {
            Some(l) => l.lower + share() * (l.upper - l.lower),
            None => std::f64::consts::PI * (2.0 * share() - 1.0),
        });
        arm.set_positions(&mut q, &positions);
        poses.extend(tree.relative_pose(arm.base, arm.wrist, &q));
    }
    poses
}

fn kinematics(c: &mut Criterion) {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the PR2 is right");
    let pr2 = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &tree)
        .expect("the description is right");
    let start = pr2.start_positions(&tree);

    c.bench_function("forward kinematics of all links", |b| {
        let mut links = Vec::new();
        b.iter(|| tree.forward_kinematics(&Pose::identity(), black_box(&start), &mut links));
    });

    for side in Side::BOTH {
        let poses = reachable_poses(&tree, &pr2, side);
        let solver = &pr2.arm(side).kinematics;
        c.bench_function(&format!("nearest solution, {side} arm"), |b| {
            let mut next = poses.iter().cycle();
            b.iter(|| next.next().map(|pose| solver.nearest(pose, &[0.0; 7])));
        });
        c.bench_function(&format!("solutions at one roll, {side} arm"), |b| {
            let mut next = poses.iter().cycle();
            b.iter(|| next.next().map(|pose| solver.solve(pose, -0.5)));
        });
    }

    let arm = pr2.arm(Side::Right);
    let tool = from_xyz_rpy([0.75, -0.55, 0.85], [0.0; 3]);
    let wrist = arm.wrist_for_tool(&tool);
    let search = pr2.torso_search(&tree, &start, Side::Right);
    c.bench_function("reach with the torso", |b| {
        b.iter(|| search.reach(black_box(&wrist)));
    });
    let behind = from_xyz_rpy([0.6, 0.45, 0.85], [0.0, 0.0, 1.5]);
    assert!(search.reach(&behind).is_err());
    c.bench_function("proof for all torso heights", |b| {
        b.iter(|| search.reach(black_box(&behind)));
    });
}

fn reading(c: &mut Criterion) {
    c.bench_function("read the PR2", |b| {
        b.iter(|| KinematicTree::from_urdf(black_box(PR2_URDF), "pr2.urdf"));
    });
    c.bench_function("read the kitchen", |b| {
        b.iter(|| KinematicTree::from_urdf(black_box(KITCHEN_URDF), "kitchen.urdf"));
    });
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the PR2 is right");
    c.bench_function("read the description", |b| {
        b.iter(|| RobotDescription::from_sexp(black_box(PR2_DESCRIPTION), "pr2.sexp", &tree));
    });
}

criterion_group!(benches, kinematics, reading);
criterion_main!(benches);
