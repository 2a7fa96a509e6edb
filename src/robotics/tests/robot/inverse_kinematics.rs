//! Inverse kinematics of the arms: complete, exact, near the seed, within limits.

use crate::robot::closed_form::ClosedForm;
use crate::robot::{ArmPositions, KinematicTree, LinkId, Unreachable};
use descriptions::PR2_URDF;
use proptest::prelude::*;
use spatial::pose::{angle_between, distance_between, from_xyz_quaternion};
use spatial::{Pose, trig};
use std::f64::consts::PI;
use std::sync::LazyLock;

struct Fixture {
    tree: KinematicTree,
    base: LinkId,
    arms: [(LinkId, ClosedForm); 2],
}

static PR2: LazyLock<Fixture> = LazyLock::new(|| {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the PR2 is right");
    let base = tree.link_named("torso_lift_link").expect("it has a torso");
    let arms = ["l_wrist_roll_link", "r_wrist_roll_link"].map(|name| {
        let tip = tree.link_named(name).expect("it has arms");
        let arm = ClosedForm::new(&tree, base, tip).expect("the arm suits the solver");
        (tip, arm)
    });
    Fixture { tree, base, arms }
});

impl Fixture {
    /// Pose of the wrist in the frame of the torso.
    fn wrist(&self, arm: usize, positions: &ArmPositions) -> Pose {
        let (tip, kinematics) = &self.arms[arm];
        let mut q = self.tree.zero_positions();
        for (joint, position) in kinematics.joints().iter().zip(positions) {
            q.set(*joint, *position);
        }
        self.tree
            .relative_pose(self.base, *tip, &q)
            .expect("the wrist hangs on the torso")
    }

    /// Joint positions from shares 0..1 of their ranges.
    fn positions(&self, arm: usize, shares: &[f64; 7]) -> ArmPositions {
        let limits = self.arms[arm].1.limits();
        let places = shares
            .iter()
            .zip(limits)
            .map(|(share, limits)| match limits {
                Some(l) => l.lower + share * (l.upper - l.lower),
                None => PI * (2.0 * share - 1.0),
            });
        places.collect()
    }

    fn check(&self, arm: usize, wrist: &Pose, solution: &ArmPositions) {
        let reached = self.wrist(arm, solution);
        assert!(distance_between(wrist, &reached) < 1e-9, "{solution:?}");
        assert!(angle_between(wrist, &reached) < 1e-9, "{solution:?}");
        for (position, limits) in solution.iter().zip(self.arms[arm].1.limits()) {
            assert!(limits.is_none_or(|l| l.contains(*position)), "{solution:?}");
        }
    }
}

fn shares() -> impl Strategy<Value = [f64; 7]> {
    prop::array::uniform7(0.0..=1.0_f64)
}

/// Any pose around the shoulders, most of them unreachable.
fn any_pose() -> impl Strategy<Value = Pose> {
    let place = (-0.3..0.9_f64, -1.0..1.0_f64, -0.8..0.8_f64);
    let turn = prop::array::uniform4(-1.0..1.0_f64);
    (place, turn).prop_filter_map("a rotation", |((x, y, z), turn)| {
        from_xyz_quaternion([x, y, z], turn)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn a_hand_is_turned_about_the_wrist(
        arm in 0usize..2,
        shares in shares(),
        other in shares(),
    ) {
        let kinematics = &PR2.arms[arm].1;
        let (now, then) = (PR2.positions(arm, &shares), PR2.positions(arm, &other));
        let hand = kinematics.hand_rotation(&then);
        let wanted = PR2.wrist(arm, &then).rotation.to_rotation_matrix();
        prop_assert!((hand - wanted.matrix()).norm() < 1e-9);
        if let Some(turned) = kinematics.with_hand_turned(&now, &hand) {
            let (before, after) = (PR2.wrist(arm, &now), PR2.wrist(arm, &turned));
            prop_assert!(distance_between(&before, &after) < 1e-9);
            prop_assert!((kinematics.hand_rotation(&turned) - hand).norm() < 1e-9);
        }
        let unturned = kinematics.with_hand_turned(&now, &kinematics.hand_rotation(&now));
        prop_assert!(unturned.is_some());
    }

    #[test]
    fn every_reachable_pose_is_reached(arm in 0..2_usize, shares in shares()) {
        let wrist = PR2.wrist(arm, &PR2.positions(arm, &shares));
        let solution = PR2.arms[arm].1.nearest(&wrist, &[0.0; 7].into());
        let solution = solution.expect("the pose was made from joint positions within limits");
        PR2.check(arm, &wrist, &solution);
    }

    #[test]
    fn continuous_joints_stay_within_half_a_turn_of_the_seed(
        arm in 0..2_usize, shares in shares(), seed in prop::array::uniform7(-30.0..30.0_f64),
    ) {
        let wrist = PR2.wrist(arm, &PR2.positions(arm, &shares));
        let solution = PR2.arms[arm].1.nearest(&wrist, &seed.into()).expect("reachable");
        PR2.check(arm, &wrist, &solution);
        for i in [4, 6] {
            prop_assert!((solution[i] - seed[i]).abs() <= PI + 1e-9);
        }
    }

    #[test]
    fn the_solution_is_near_the_seed_when_the_seed_is_one(arm in 0..2_usize, shares in shares()) {
        let seed = PR2.positions(arm, &shares);
        let wrist = PR2.wrist(arm, &seed);
        let solution = PR2.arms[arm].1.nearest(&wrist, &seed).expect("the seed is a solution");
        for (found, seed) in solution.iter().zip(seed) {
            prop_assert!((found - seed).abs() < 0.05, "{solution:?} instead of {seed:?}");
        }
    }

    #[test]
    fn the_original_positions_are_among_those_at_their_roll(
        arm in 0..2_usize, shares in prop::array::uniform7(0.001..=0.999_f64),
    ) {
        let original = PR2.positions(arm, &shares);
        let wrist = PR2.wrist(arm, &original);
        let solutions = PR2.arms[arm].1.solve(&wrist, original[2]);
        prop_assert!(solutions.len() <= 2);
        let same = |q: &ArmPositions| q.iter().zip(&original).all(|(a, b)| {
            trig::wrap(a - b).abs() < 1e-4
        });
        prop_assert!(solutions.iter().any(same), "{solutions:?} instead of {original:?}");
    }

    #[test]
    fn all_solutions_are_sound(arm in 0..2_usize, wrist in any_pose()) {
        let kinematics = &PR2.arms[arm].1;
        let solutions = kinematics.solutions(&wrist, 0.2);
        prop_assert_eq!(solutions.is_empty(), kinematics.nearest(&wrist, &[0.0; 7].into()).is_err());
        for solution in &solutions {
            PR2.check(arm, &wrist, solution);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// What the solver calls unreachable, no upper arm roll in steps of 0.002 rad reaches.
    #[test]
    fn unreachable_means_unreachable(arm in 0..2_usize, wrist in any_pose()) {
        let kinematics = &PR2.arms[arm].1;
        if kinematics.nearest(&wrist, &[0.0; 7].into()).is_err() {
            let roll = kinematics.limits()[2].expect("the roll has limits");
            let steps = ((roll.upper - roll.lower) / 0.002) as u32;
            for i in 0..=steps {
                let found = kinematics.solve(&wrist, roll.lower + f64::from(i) * 0.002);
                prop_assert!(found.is_empty(), "{found:?}");
            }
        }
    }

    /// The named joints really break their limits, by what is said.
    #[test]
    fn the_reason_for_being_unreachable_is_true(arm in 0..2_usize, wrist in any_pose()) {
        let kinematics = &PR2.arms[arm].1;
        match kinematics.nearest(&wrist, &[0.0; 7].into()) {
            Err(Unreachable::Limits { positions, violations }) => {
                let reached = PR2.wrist(arm, &positions);
                prop_assert!(distance_between(&wrist, &reached) < 1e-9);
                prop_assert!(angle_between(&wrist, &reached) < 1e-9);
                prop_assert!(!violations.is_empty());
                for violation in &violations {
                    let joint = PR2.tree.joint_named(&violation.joint).expect("it exists");
                    let place = kinematics.joints().iter().position(|j| *j == joint);
                    let place = place.expect("it is a joint of the arm");
                    prop_assert_eq!(violation.position, positions[place]);
                    prop_assert!(violation.excess > 0.0);
                    prop_assert_eq!(violation.limits.excess(violation.position), violation.excess);
                }
            }
            Err(Unreachable::OutOfReach { missing }) => {
                prop_assert!(missing > 0.0);
                // The wrist is farther from the pan axis than the arm is long, or too near.
                let side = if arm == 0 { 0.188 } else { -0.188 };
                let place = wrist.translation.vector - nalgebra::Vector3::new(0.0, side, 0.0);
                prop_assert!(place.norm() + missing > 0.0 && missing < place.norm() + 0.821);
            }
            Err(Unreachable::Searched(miss)) => prop_assert!(false, "{miss}"),
            Ok(_) => {}
        }
    }
}

#[test]
fn the_wrist_may_lie_on_the_pan_axis() {
    // The upper arm points down and is rolled by half a turn, the forearm comes back.
    let fixture = &*PR2;
    for arm in 0..2 {
        let side = if arm == 0 { 0.188 } else { -0.188 };
        let mut reached = 0;
        for z in [-0.5, -0.45, -0.4, -0.37] {
            for turn in 0..8 {
                let yaw = f64::from(turn) * PI / 4.0;
                let wrist = spatial::pose::from_xyz_rpy([0.0, side, z], [0.3, 0.2, yaw]);
                if let Ok(solution) = fixture.arms[arm].1.nearest(&wrist, &[0.0; 7].into()) {
                    fixture.check(arm, &wrist, &solution);
                    reached += 1;
                }
            }
        }
        assert!(reached > 0);
    }
}

#[test]
fn a_chain_of_another_layout_is_refused() {
    let tree = &PR2.tree;
    let link = |name| tree.link_named(name).expect("the link exists");
    let error = |base, tip| match ClosedForm::new(tree, link(base), link(tip)) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    };
    assert_eq!(
        error("torso_lift_link", "head_tilt_link"),
        "the arm from \"torso_lift_link\" to \"head_tilt_link\" has 2 moving joints; \
         the inverse kinematics needs 7"
    );
    assert_eq!(
        error("l_wrist_roll_link", "r_wrist_roll_link"),
        "link \"r_wrist_roll_link\" does not hang on link \"l_wrist_roll_link\"; an arm goes \
         from its base to its tip"
    );
    assert_eq!(
        error("base_link", "r_wrist_flex_link"),
        "joint \"torso_lift_joint\" does not suit the inverse kinematics of the arm: it needs \
         to be revolute and to follow no other joint"
    );
}

#[test]
fn the_same_question_has_the_same_answer_to_the_bit() {
    let wrist = PR2.wrist(1, &PR2.positions(1, &[0.4; 7]));
    let solve = || {
        PR2.arms[1]
            .1
            .nearest(&wrist, &[0.1; 7].into())
            .expect("reachable")
    };
    let bits = |q: ArmPositions| q.into_iter().map(f64::to_bits).collect::<Vec<_>>();
    assert_eq!(bits(solve()), bits(solve()));
}
