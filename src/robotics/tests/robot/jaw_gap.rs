//! The gap of a gripper, measured from the shapes of its fingers.

use crate::robot::{JawGap, JawGapError, JointId, KinematicTree, LinkId};
use descriptions::{FETCH_URDF, PR2_URDF};
use nalgebra::Vector3;

fn tree(text: &str) -> KinematicTree {
    KinematicTree::from_urdf(text, "gripper.urdf").expect("the robot is right")
}

fn links(tree: &KinematicTree, names: &[&str]) -> Vec<LinkId> {
    let link = |name: &&str| tree.link_named(name).expect("there is the link");
    names.iter().map(link).collect()
}

fn joints(tree: &KinematicTree, names: &[&str]) -> Vec<JointId> {
    let joint = |name: &&str| tree.joint_named(name).expect("there is the joint");
    names.iter().map(joint).collect()
}

fn measured(
    tree: &KinematicTree,
    palm: &str,
    moved: &[&str],
    [left, right]: [&[&str]; 2],
) -> Result<JawGap, JawGapError> {
    let palm = links(tree, &[palm])[0];
    let (left, right) = (links(tree, left), links(tree, right));
    JawGap::measure(tree, palm, &joints(tree, moved), [&left, &right])
}

/// Gap and position follow each other, and the gap grows with the opening.
fn is_consistent(jaw: &JawGap) {
    let (closed, open) = (jaw.closed(), jaw.open());
    assert!(open.1 > closed.1);
    for i in 0..=10 {
        let gap = closed.1 + (open.1 - closed.1) * f64::from(i) / 10.0;
        let position = jaw.position_for_gap(gap);
        assert!(
            (jaw.gap(position) - gap).abs() < 1e-9,
            "{gap} at {position}"
        );
    }
    for gap in [-1.0, 5.0] {
        let end = if gap < 0.0 { closed } else { open };
        assert_eq!(jaw.position_for_gap(gap), end.0);
    }
    let beyond = if jaw.opens_up() { 1.0 } else { -1.0 };
    assert_eq!(jaw.gap(open.0 + beyond), open.1);
    assert_eq!(jaw.gap(closed.0 - beyond), closed.1);
}

#[test]
fn the_pr2_opens_by_92_mm() {
    let tree = tree(PR2_URDF);
    let fingers: [&[&str]; 2] = [
        &["r_gripper_l_finger_link", "r_gripper_l_finger_tip_link"],
        &["r_gripper_r_finger_link", "r_gripper_r_finger_tip_link"],
    ];
    let moved = ["r_gripper_l_finger_joint"];
    let jaw = measured(&tree, "r_gripper_palm_link", &moved, fingers).expect("it is a gripper");
    is_consistent(&jaw);
    assert!(jaw.opens_up());
    // The gap by the lengths of the linkage.
    for i in 0..=20 {
        let q = 0.548 * f64::from(i) / 20.0;
        let (s, c) = spatial::trig::sin_cos(q);
        let expected = 2.0 * (0.09137 * s + 0.00495 * c - 0.0058);
        assert!(
            (jaw.gap(q) - expected).abs() < 2e-6,
            "at {q}: {}",
            jaw.gap(q)
        );
    }
    assert!((jaw.open().1 - 0.0922).abs() < 2e-4, "{:?}", jaw.open());
    // The pads of 36 x 23 mm meet in front of the palm, between the fingers.
    assert!((jaw.pad_size[0] - 0.036).abs() < 0.001 && (jaw.pad_size[1] - 0.0226).abs() < 0.001);
    let grip = jaw.grip;
    assert!((grip.rotation * Vector3::x() - Vector3::x()).norm() < 1e-9);
    assert!((grip.rotation * Vector3::y() - Vector3::y()).norm() < 1e-9);
    let place = grip.translation.vector;
    assert!(
        (0.15..0.20).contains(&place.x) && place.yz().norm() < 1e-6,
        "{place}"
    );
}

#[test]
fn two_joints_of_fetch_that_move_together_open_twice_as_far() {
    let tree = tree(FETCH_URDF);
    let fingers: [&[&str]; 2] = [&["r_gripper_finger_link"], &["l_gripper_finger_link"]];
    let both = ["r_gripper_finger_joint", "l_gripper_finger_joint"];
    let jaw = measured(&tree, "gripper_link", &both, fingers).expect("it is a gripper");
    is_consistent(&jaw);
    for q in [0.0, 0.01, 0.05] {
        assert!(
            (jaw.gap(q) - (2.0 * q - 0.0006)).abs() < 1e-9,
            "{}",
            jaw.gap(q)
        );
    }
    // The frame of the hand is in the middle of the pads, 1 mm behind.
    let place = jaw.grip.translation.vector;
    assert!(
        (place - Vector3::new(0.001, 0.0, 0.0)).norm() < 1e-9,
        "{place}"
    );
    assert!((jaw.pad_size[0] - 0.06).abs() < 1e-9 && (jaw.pad_size[1] - 0.026).abs() < 1e-9);
    let mut q = tree.zero_positions();
    jaw.set_positions(&mut q, 0.03);
    assert!(
        joints(&tree, &both)
            .iter()
            .all(|joint| q.get(*joint) == 0.03)
    );
    // With one joint only, the other finger stays.
    let one = measured(&tree, "gripper_link", &both[..1], fingers).expect("it is a gripper");
    assert!((one.open().1 - 0.0494).abs() < 1e-9);
}

/// A hand whose fingers slide along `axis`, the right one as `joint` says.
fn hand(limits: [&str; 2], axis: &str, joint: &str) -> KinematicTree {
    let finger = |side: &str, y: f64| {
        format!(
            "<link name=\"{side}\"><collision><origin xyz=\"0 {y} 0.1\"/><geometry>\
             <box size=\"0.02 0.01 0.054\"/></geometry></collision></link>"
        )
    };
    let [lower, upper] = limits;
    tree(&format!(
        "<robot name=\"hand\"><link name=\"hand\"/>{}{}\
         <joint name=\"first\" type=\"prismatic\"><parent link=\"hand\"/><child link=\"left\"/>\
         <axis xyz=\"{axis}\"/><limit lower=\"{lower}\" upper=\"{upper}\" effort=\"1\" velocity=\"1\"/></joint>\
         <joint name=\"second\" type=\"prismatic\"><parent link=\"hand\"/><child link=\"right\"/>{joint}</joint>\
         </robot>",
        finger("left", 0.005),
        finger("right", -0.005)
    ))
}

const FINGERS: [&[&str]; 2] = [&["left"], &["right"]];

#[test]
fn followers_and_mirrored_joints_move_the_other_jaw() {
    let limits = "<limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>";
    let follower = format!("<axis xyz=\"0 -1 0\"/>{limits}<mimic joint=\"first\"/>");
    let panda = hand(["0", "0.04"], "0 1 0", &follower);
    let jaw = measured(&panda, "hand", &["first"], FINGERS).expect("it is a gripper");
    is_consistent(&jaw);
    assert!((jaw.open().1 - 0.08).abs() < 1e-9 && jaw.closed().1.abs() < 1e-9);
    // Away from the palm is up here.
    assert!((jaw.grip.rotation * Vector3::x() - Vector3::z()).norm() < 1e-9);
    assert!((jaw.grip.translation.vector.z - 0.1).abs() < 1e-9);
    assert!((jaw.pad_size[0] - 0.054).abs() < 1e-9);

    let mirrored =
        "<axis xyz=\"0 1 0\"/><limit lower=\"-0.04\" upper=\"0\" effort=\"1\" velocity=\"1\"/>";
    let mirrored = hand(["0", "0.04"], "0 1 0", mirrored);
    let jaw = measured(&mirrored, "hand", &["first", "second"], FINGERS).expect("it is a gripper");
    is_consistent(&jaw);
    assert!((jaw.open().1 - 0.08).abs() < 1e-9);

    // A joint that closes as it grows.
    let closing = hand(
        ["-0.04", "0"],
        "0 -1 0",
        &follower.replace("0 -1 0", "0 1 0"),
    );
    let jaw = measured(&closing, "hand", &["first"], FINGERS).expect("it is a gripper");
    is_consistent(&jaw);
    assert!(!jaw.opens_up());
    assert_eq!(jaw.open().0, -0.04);
    assert!((jaw.gap(-0.01) - 0.02).abs() < 1e-9);
}

#[test]
fn only_the_part_of_the_range_counts_in_which_the_gap_grows() {
    // The fingers pass through each other below 0.
    let follower = "<axis xyz=\"0 -1 0\"/><limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>\
                    <mimic joint=\"first\"/>";
    let tree = hand(["-0.02", "0.04"], "0 1 0", follower);
    let jaw = measured(&tree, "hand", &["first"], FINGERS).expect("it is a gripper");
    is_consistent(&jaw);
    assert!(jaw.closed().1 < 0.0);
}

#[test]
fn fingers_that_turn_open_between_their_pads() {
    // Hinges 40 mm apart, thick roots beside them, and pads 180 mm away that meet at 0.
    let finger = |side: &str, sign: f64| {
        format!(
            "<link name=\"{side}\"><collision><geometry><box size=\"0.02 0.01 0.04\"/>\
             </geometry></collision></link><link name=\"{side}_tip\"><collision><geometry>\
             <box size=\"0.02 0.01 0.03\"/></geometry></collision></link>\
             <joint name=\"{side}_joint\" type=\"revolute\"><parent link=\"hand\"/><child link=\"{side}\"/>\
             <origin xyz=\"0 {} 0.1\"/><axis xyz=\"{} 0 0\"/>\
             <limit lower=\"0\" upper=\"0.4\" effort=\"1\" velocity=\"1\"/></joint>\
             <joint name=\"{side}_end\" type=\"fixed\"><parent link=\"{side}\"/><child link=\"{side}_tip\"/>\
             <origin xyz=\"0 {} 0.18\"/></joint>",
            0.02 * sign,
            -sign,
            -0.015 * sign
        )
    };
    let text = format!(
        "<robot name=\"hand\"><link name=\"hand\"/>{}{}</robot>",
        finger("left", 1.0),
        finger("right", -1.0)
    );
    let tree = tree(&text);
    let fingers: [&[&str]; 2] = [&["left", "left_tip"], &["right", "right_tip"]];
    let jaw = measured(&tree, "hand", &["left_joint", "right_joint"], fingers);
    let jaw = jaw.expect("it is a gripper");
    is_consistent(&jaw);
    // Between the roots there are never more than 40 mm.
    assert_eq!(jaw.open().0, 0.4);
    assert!((0.12..0.16).contains(&jaw.open().1), "{:?}", jaw.open());
    assert!(jaw.closed().1.abs() < 1e-9, "{:?}", jaw.closed());
    // The hand holds between the pads.
    let place = jaw.grip.translation.vector;
    assert!((0.26..0.29).contains(&place.z), "{place}");
}

#[test]
fn what_is_no_gripper_is_refused() {
    let fixed =
        "<axis xyz=\"0 1 0\"/><limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>";
    let with_left = hand(
        ["0", "0.04"],
        "0 1 0",
        &format!("{fixed}<mimic joint=\"first\"/>"),
    );
    let refused = |tree: &KinematicTree, palm: &str, moved: &[&str], fingers| {
        let error = measured(tree, palm, moved, fingers).expect_err("it is no gripper");
        error.to_string()
    };
    let text = refused(&with_left, "hand", &["first"], FINGERS);
    assert!(text.contains("apart by less than 1 mm"), "{text}");
    let text = refused(&with_left, "hand", &[], FINGERS);
    assert!(text.contains("needs a joint"), "{text}");
    let text = refused(&with_left, "left", &["first"], FINGERS);
    assert!(
        text.contains("finger \"right\" does not hang on palm \"left\""),
        "{text}"
    );
    let text = refused(&with_left, "hand", &["first"], [&["left"], &[]]);
    assert!(text.contains("no collision shape"), "{text}");
    let standing = hand(["0", "0"], "0 1 0", fixed);
    let text = refused(&standing, "hand", &["first"], FINGERS);
    assert!(
        text.contains("cannot move: both of its limits are 0"),
        "{text}"
    );
    let pr2 = tree(PR2_URDF);
    let text = refused(
        &pr2,
        "r_gripper_palm_link",
        &["r_forearm_roll_joint"],
        FINGERS_OF_PR2,
    );
    assert!(text.contains("has no limits"), "{text}");
}

const FINGERS_OF_PR2: [&[&str]; 2] = [
    &["r_gripper_l_finger_tip_link"],
    &["r_gripper_r_finger_tip_link"],
];
