//! The built-in HSR: its figures, and what its arm of five joints reaches.

use crate::robot::arm_positions::ArmPositions;
use crate::robot::{KinematicTree, MissingNames, NumericKinematics};
use descriptions::{HSR_DESCRIPTION, HSR_URDF};
use nalgebra::{Translation3, Vector3};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};
use spatial::Pose;
use spatial::pose::{angle_between, distance_between, from_xy_yaw, from_xyz_rpy};

fn hsr() -> KinematicTree {
    KinematicTree::from_urdf(HSR_URDF, "hsr.urdf").expect("the HSR is right")
}

fn arm() -> NumericKinematics {
    let tree = hsr();
    let [base, tip] = ["base_link", "hand_palm_link"].map(|name| tree.link_named(name));
    NumericKinematics::new(&tree, base.expect("a base"), tip.expect("a hand")).expect("an arm")
}

/// Positions within the limits; the arm does not roll if the hand is to stay in the plane.
fn random_positions(random: &mut Pcg64, arm: &NumericKinematics, rolls: bool) -> ArmPositions {
    let limits = arm.limits().iter().enumerate();
    let positions = limits.map(|(joint, limits)| {
        let share = f64::from(random.next_u32()) / f64::from(u32::MAX);
        match limits {
            _ if joint == 2 && !rolls => 0.0,
            Some(limits) => limits.lower + share * (limits.upper - limits.lower),
            None => 0.0,
        }
    });
    positions.collect()
}

#[test]
fn the_description_names_what_there_is() {
    let missing = MissingNames::of(HSR_DESCRIPTION, "hsr.sexp", &hsr());
    let missing = missing.expect("it can be read");
    assert!(missing.is_empty(), "{missing}");
}

#[test]
fn the_figures_are_those_of_the_hsr() {
    let tree = hsr();
    let height = |lift: f64| {
        let mut q = tree.zero_positions();
        q.set(tree.joint_named("arm_lift_joint").expect("a lift"), lift);
        let camera = tree.link_named("head_rgbd_sensor_link").expect("a camera");
        tree.link_pose(camera, &Pose::identity(), &q).translation.z
    };
    // The head rises half as far as the arm.
    for (lift, expected) in [(0.0, 0.97), (0.69, 1.31)] {
        assert!((height(lift) - expected).abs() < 0.005, "{}", height(lift));
    }
    let tool = arm().forward(&[0.69, 0.0, 0.0, 0.0, 0.0]) * Translation3::new(0.0, 0.0, 0.075);
    assert!(tool.translation.z > 1.5, "{tool}");
    let moving = tree
        .joints()
        .filter(|(_, joint)| joint.is_actuated())
        .count();
    assert_eq!(moving, 10);
}

#[test]
fn every_pose_in_the_plane_is_met_exactly() {
    let arm = arm();
    let mut random = Pcg64::seed_from_u64(3);
    for _ in 0..500 {
        let goal = arm.forward(&random_positions(&mut random, &arm, false));
        let seed = random_positions(&mut random, &arm, true);
        let found = arm.nearest(&goal, &seed).expect("it is within reach");
        let reached = arm.forward(&found);
        assert!(distance_between(&goal, &reached) < 1e-6, "{goal}");
        assert!(angle_between(&goal, &reached) < 1e-5, "{goal}");
        assert!(arm.reaches(&goal), "{goal}");
    }
}

/// Two degrees are more than enough for what is 2 mm beside the plane.
#[test]
fn beside_the_plane_the_tool_is_at_its_place_and_the_hand_turned_a_little() {
    let tool = Vector3::new(0.0, 0.0, 0.075);
    let arm = arm().meeting_at(tool);
    let (distance, angle) = arm.tolerance();
    let mut random = Pcg64::seed_from_u64(4);
    let mut met = 0;
    for _ in 0..200 {
        // Away from the limits, with the hand well off the axis about which the arm rolls.
        let share = || f64::from(random.next_u32()) / f64::from(u32::MAX);
        let mut shares = std::iter::repeat_with(share);
        let mut next = |low: f64, high: f64| low + (high - low) * shares.next().unwrap_or(0.5);
        let positions = [next(0.1, 0.6), next(-1.4, -0.3), 0.0, next(-1.5, -0.6), 0.3];
        let goal = Translation3::new(0.0, 0.002, 0.0) * arm.forward(&positions);
        let seed = positions.into_iter().collect();
        let Ok(found) = arm.nearest(&goal, &seed) else {
            continue;
        };
        met += 1;
        let reached = arm.forward(&found);
        let away = distance_between(
            &(goal * Translation3::from(tool)),
            &(reached * Translation3::from(tool)),
        );
        assert!(away < distance, "{away}");
        let turned = angle_between(&goal, &reached);
        assert!(turned < angle && turned > 1e-4, "{turned}");
    }
    assert!(met >= 190, "{met}");
}

#[test]
fn what_is_far_beside_the_plane_is_not_reached() {
    let arm = arm();
    let goal = arm.forward(&[0.3, -0.8, 0.0, -0.8, 0.0]);
    assert!(arm.reaches(&goal));
    assert!(!arm.reaches(&(Translation3::new(0.0, 0.1, 0.0) * goal)));
    let turned = from_xyz_rpy([0.0; 3], [0.0, 0.0, 0.5]);
    let beside = Pose::from_parts(goal.translation, turned.rotation * goal.rotation);
    assert!(!arm.reaches(&beside));
    // Nor is it bent: six numbers take six joints.
    assert!(
        arm.nearest(&beside, &ArmPositions::from_iter([0.0; 5]))
            .is_err()
    );
}

#[test]
fn the_base_turns_and_moves_aside_until_the_hand_is_in_the_plane() {
    let arm = arm();
    let plane = arm.plane().expect("five joints have one");
    let mut random = Pcg64::seed_from_u64(5);
    let mut share =
        |range: f64| range * (2.0 * f64::from(random.next_u32()) / f64::from(u32::MAX) - 1.0);
    for _ in 0..200 {
        // A pose that the arm has from a base, and another base near that.
        let hand = arm.forward(&[
            0.3 + share(0.2),
            -0.9 + share(0.3),
            0.0,
            -0.9 + share(0.3),
            share(1.5),
        ]);
        let base = from_xy_yaw(share(2.0), share(2.0), share(3.0));
        let tip = base * hand;
        let near = base * from_xy_yaw(0.0, share(0.03), share(0.1));
        let (found, [turn, aside]) = plane.base_for(&near, &Pose::identity(), &tip);
        assert!(turn.abs() < 0.11 && aside.abs() < 0.12, "{turn} {aside}");
        assert!(arm.reaches(&(found.inverse() * tip)), "{hand}");
    }
}

#[test]
fn a_telescope_counts_as_one_joint() {
    let (tree, base, tip) = super::chains::chain(super::chains::TELESCOPE);
    let arm = NumericKinematics::new(&tree, base, tip).expect("the chain can be solved");
    assert_eq!(arm.joints().len(), 8);
    let plane = arm.plane().expect("the hand moves in five ways");
    // With the hand straight ahead it is in the plane, however far the arm is out.
    let goal = arm.forward(&[0.6, 0.1, 0.05, 0.0, 0.12, 0.0, 0.4, -0.3]);
    assert!(arm.reaches(&goal));
    let beside = Translation3::new(0.0, 0.1, 0.0) * goal;
    assert!(!arm.reaches(&beside));
    // The base moves aside for what is beside it.
    let (base, [turn, aside]) = plane.base_for(&Pose::identity(), &Pose::identity(), &beside);
    assert!(
        turn.abs() < 1e-9 && (aside.abs() - 0.1).abs() < 1e-9,
        "{turn} {aside}"
    );
    assert!(arm.reaches(&(base.inverse() * beside)));
    // Joints that slide in different directions are different ones.
    let [rows @ .., _] = super::chains::TELESCOPE else {
        panic!("there are rows");
    };
    let mut rows = rows.to_vec();
    rows[2].3 = [0.0, 1.0, 0.0];
    let (tree, base, tip) = super::chains::chain(&rows);
    let arm = NumericKinematics::new(&tree, base, tip).expect("the chain can be solved");
    assert!(arm.plane().is_none());
}
