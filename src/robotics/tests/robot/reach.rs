//! From where the arms reach the bottles of the fetch-and-place tutorial.
//!
//! The robot stands at (-1.447, -0.15), facing the table (yaw -90 degrees); three bottles
//! stand on the table. For each bottle, arm and grasp the table below holds the torso
//! heights (in steps of 1 cm, as lowest and highest) at which the arm reaches the first
//! and second pregrasp, the grasp and the lift, found by an independent solver that tries
//! 1601 positions of the upper arm roll. What is not listed is reachable at no height.

use crate::robot::{KinematicTree, RobotDescription, Side};
use crate::world::grasp_library::{GRASPS, GraspDefinition, GraspLibrary};
use descriptions::{PR2_DESCRIPTION, PR2_URDF};
use spatial::Pose;
use spatial::pose::{from_xy_yaw, from_xyz_rpy};

const BOTTLES: [(&str, [f64; 3]); 3] = [
    ("A", [-1.6, -0.9, 0.8208]),
    ("B", [-2.0, -0.9, 0.8208]),
    ("C", [-1.0, -0.75, 0.8208]),
];

/// Lowest and highest torso height (cm).
type Range = Option<(u32, u32)>;

const NONE: Range = None;
const ALL: Range = Some((0, 33));

const fn cm(lowest: u32, highest: u32) -> Range {
    Some((lowest, highest))
}

/// `cram-front` is CRAM's own definition of `front`, which uses the offsets of `back`.
#[rustfmt::skip]
const TABLE: &[(&str, Side, &str, [Range; 4])] = &[
    ("A", Side::Right, "left-side", [ALL, ALL, ALL, ALL]),
    ("A", Side::Right, "back", [NONE, NONE, cm(0, 12), cm(10, 27)]),
    ("A", Side::Right, "cram-front", [cm(6, 31), cm(0, 16), NONE, NONE]),
    ("A", Side::Left, "left-side", [ALL, ALL, ALL, ALL]),
    ("A", Side::Left, "cram-front", [NONE, NONE, cm(0, 15), cm(7, 30)]),
    ("A", Side::Left, "front", [cm(3, 33), cm(0, 19), cm(0, 10), cm(12, 25)]),
    ("B", Side::Right, "left-side", [ALL, ALL, ALL, ALL]),
    ("B", Side::Right, "cram-front", [NONE, NONE, cm(0, 12), cm(10, 27)]),
    ("B", Side::Right, "front", [cm(3, 33), cm(0, 19), NONE, NONE]),
    ("C", Side::Right, "back", [ALL, ALL, cm(0, 22), ALL]),
    ("C", Side::Left, "left-side", [ALL, cm(14, 33), ALL, ALL]),
    ("C", Side::Left, "back", [ALL, ALL, ALL, ALL]),
    ("C", Side::Left, "cram-front", [ALL, ALL, cm(0, 9), cm(13, 24)]),
    ("C", Side::Left, "front", [NONE, NONE, cm(0, 24), ALL]),
];

fn grasps() -> GraspLibrary {
    let mut library =
        GraspLibrary::from_sexp(GRASPS, "grasps.sexp").expect("the built-in library is right");
    for side in Side::BOTH {
        let front = library
            .get("bottle", side, "front")
            .expect("bottles are grasped from the front")
            .clone();
        let cram = GraspDefinition {
            translation: [0.02, 0.0, 0.005],
            pregrasp: [-0.15, 0.0, 0.15],
            second_pregrasp: [-0.15, 0.0, 0.0],
            ..front
        };
        library
            .define("bottle", side, "cram-front", cram)
            .expect("the rotation is the same");
    }
    library
}

/// Wrist poses in the robot's frame: first and second pregrasp, grasp and lift.
fn wrist_poses(
    pr2: &RobotDescription,
    grasps: &GraspLibrary,
    bottle: &Pose,
    side: Side,
    grasp: &str,
) -> [Pose; 4] {
    let arm = pr2.arm(side);
    let definition = grasps
        .get("bottle", side, grasp)
        .expect("the grasp is defined");
    let tool = definition
        .tool_poses(bottle, &arm.tool_axes)
        .expect("the rotation is one");
    [tool.pregrasp, tool.second_pregrasp, tool.grasp, tool.lift].map(|t| arm.wrist_for_tool(&t))
}

#[test]
fn bottles_are_reachable_from_the_expected_torso_heights() {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the PR2 is right");
    let pr2 = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &tree)
        .expect("the description is right");
    let grasps = grasps();
    let base = from_xy_yaw(-1.447, -0.15, -std::f64::consts::FRAC_PI_2);
    let q = tree.zero_positions();
    let mut wrong = Vec::new();
    for (name, place) in BOTTLES {
        let bottle = base.inv_mul(&from_xyz_rpy(place, [0.0; 3]));
        for side in Side::BOTH {
            let search = pr2.torso_search(&tree, &q, side);
            for grasp in grasps.grasps("bottle") {
                let row = TABLE
                    .iter()
                    .find(|r| r.0 == name && r.1 == side && r.2 == grasp);
                let expected = row.map_or([NONE; 4], |r| r.3);
                let poses = wrist_poses(&pr2, &grasps, &bottle, side, grasp);
                let found = poses.map(|wrist| {
                    let reached =
                        |cm: &u32| search.reach_at(&wrist, f64::from(*cm) / 100.0).is_ok();
                    let heights: Vec<u32> = (0..=33).filter(reached).collect();
                    heights.first().copied().zip(heights.last().copied())
                });
                if found != expected {
                    wrong.push(format!(
                        "{name} {side} {grasp}: {found:?} instead of {expected:?}"
                    ));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The grasps that the tutorial tries on bottle C, in its order.
#[test]
fn the_right_arm_takes_bottle_c_from_behind_with_a_lower_torso() {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the PR2 is right");
    let pr2 = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &tree)
        .expect("the description is right");
    let grasps = grasps();
    let base = from_xy_yaw(-1.447, -0.15, -std::f64::consts::FRAC_PI_2);
    let bottle = base.inv_mul(&from_xyz_rpy(BOTTLES[2].1, [0.0; 3]));
    let mut q = tree.zero_positions();
    pr2.torso.set_height(&mut q, 0.3);
    let search = pr2.torso_search(&tree, &q, Side::Right);
    for grasp in ["left-side", "right-side", "front"] {
        let poses = wrist_poses(&pr2, &grasps, &bottle, Side::Right, grasp);
        for wrist in &poses[1..3] {
            assert!(search.reach(wrist).is_err(), "{grasp}");
        }
    }
    let poses = wrist_poses(&pr2, &grasps, &bottle, Side::Right, "back");
    let grasp = search.reach(&poses[2]).expect("from behind it works");
    // The first of the heights at or below 0.224 m on the way down from 0.3 m.
    assert!((grasp.torso - 0.22).abs() < 1e-9, "{}", grasp.torso);
}

#[test]
fn a_failure_says_how_far_away_it_is() {
    let tree = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the PR2 is right");
    let pr2 = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &tree)
        .expect("the description is right");
    let q = tree.zero_positions();
    let search = pr2.torso_search(&tree, &q, Side::Right);
    // The lift axis comes to x = 0.05, and the arm is 0.721 m long: 2 - 0.05 - 0.721.
    let far = from_xyz_rpy([2.0, -0.188, 0.790675], [0.0; 3]);
    let reason = search
        .reach(&far)
        .expect_err("two metres are too far")
        .to_string();
    assert_eq!(reason, "the wrist is 1.229 m out of the arm's reach");
    // A hand that points back at the robot would have to bend its wrist too far.
    let back = from_xyz_rpy([0.6, -0.3, 0.8], [0.0, 0.0, std::f64::consts::PI]);
    let reason = search
        .reach(&back)
        .expect_err("the wrist does not bend that far")
        .to_string();
    assert!(reason.contains("_joint would have to be at"), "{reason}");
}
