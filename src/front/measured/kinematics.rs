//! Forward and inverse kinematics, and reading the robot's description.

use descriptions::{KITCHEN_URDF, PR2_DESCRIPTION, PR2_URDF};
use std::hint::black_box;

use super::Stopwatch;
use robotics::robot::closed_form::ClosedForm;
use robotics::robot::{ArmPositions, KinematicTree, RobotDescription, Side};
use spatial::Pose;
use spatial::pose::from_xyz_rpy;

/// Pseudo-random shares (0..1) that do not depend on the time or the platform.
struct Shares(u64);

impl Shares {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Wrist poses in the torso's frame, from random joint positions within the soft limits.
fn reachable_poses(tree: &KinematicTree, pr2: &RobotDescription, side: Side) -> Vec<Pose> {
    let arm = pr2.arm(side);
    let mut shares = Shares(88_172_645_463_325_252);
    let mut poses = Vec::new();
    for _ in 0..10_000 {
        let mut q = tree.zero_positions();
        let positions: ArmPositions = arm
            .kinematics
            .limits()
            .iter()
            .map(|limits| match limits {
                Some(l) => l.lower + shares.next() * (l.upper - l.lower),
                None => std::f64::consts::PI * (2.0 * shares.next() - 1.0),
            })
            .collect();
        arm.set_positions(&mut q, &positions);
        poses.extend(tree.relative_pose(arm.base, arm.wrist, &q));
    }
    poses
}

/// Poses of the links, and joint positions that bring a wrist to a pose.
pub fn kinematics(stopwatch: &mut dyn Stopwatch) {
    let models = super::models();
    let (tree, pr2) = (&models.robot, &models.description);
    let start = pr2.start_positions(tree);
    let mut links = Vec::new();
    stopwatch.repeated("forward kinematics of all links", &mut || {
        tree.forward_kinematics(&Pose::identity(), black_box(&start), &mut links);
    });

    for side in Side::BOTH {
        let poses = reachable_poses(tree, pr2, side);
        let arm = pr2.arm(side);
        let solver = &arm.kinematics;
        let closed_form = ClosedForm::new(tree, arm.base, arm.wrist);
        let mut next = poses.iter().cycle();
        stopwatch.repeated(&format!("nearest solution, {side} arm"), &mut || {
            black_box(
                next.next()
                    .map(|pose| solver.nearest(pose, &[0.0; 7].into())),
            );
        });
        let mut next = poses.iter().cycle();
        stopwatch.repeated(&format!("solutions at one roll, {side} arm"), &mut || {
            let closed_form = closed_form.as_ref().ok();
            black_box(
                next.next()
                    .zip(closed_form)
                    .map(|(pose, solver)| solver.solve(pose, -0.5)),
            );
        });
    }

    let arm = pr2.arm(Side::Right);
    let tool = from_xyz_rpy([0.75, -0.55, 0.85], [0.0; 3]);
    let wrist = arm.wrist_for_tool(&tool);
    let search = pr2.torso_search(tree, &start, Side::Right);
    stopwatch.repeated("reach with the torso", &mut || {
        black_box(search.reach(black_box(&wrist)).is_ok());
    });
    let behind = from_xyz_rpy([0.6, 0.45, 0.85], [0.0, 0.0, 1.5]);
    assert!(search.reach(&behind).is_err());
    stopwatch.repeated("proof for all torso heights", &mut || {
        black_box(search.reach(black_box(&behind)).is_ok());
    });
}

/// Reading the files that describe the robot and the kitchen.
pub fn reading(stopwatch: &mut dyn Stopwatch) {
    stopwatch.repeated("read the PR2", &mut || {
        black_box(KinematicTree::from_urdf(black_box(PR2_URDF), "pr2.urdf").is_ok());
    });
    stopwatch.repeated("read the kitchen", &mut || {
        black_box(KinematicTree::from_urdf(black_box(KITCHEN_URDF), "kitchen.urdf").is_ok());
    });
    let models = super::models();
    stopwatch.repeated("read the description", &mut || {
        let text = black_box(PR2_DESCRIPTION);
        black_box(RobotDescription::from_sexp(text, "pr2.sexp", &models.robot).is_ok());
    });
}
