//! The description of the PR2, and what is said about descriptions that are wrong.

use crate::robot::{KinematicTree, RobotDescription, Side};
use descriptions::{PR2_DESCRIPTION, PR2_URDF};

fn tree() -> KinematicTree {
    KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the built-in PR2 is right")
}

fn pr2(tree: &KinematicTree) -> RobotDescription {
    RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", tree)
        .expect("the built-in description is right")
}

/// What is said when `from` is replaced by `to` in the built-in description.
fn error(from: &str, to: &str) -> String {
    assert!(
        PR2_DESCRIPTION.contains(from),
        "{from} is not in the description"
    );
    let text = PR2_DESCRIPTION.replacen(from, to, 1);
    match RobotDescription::from_sexp(&text, "pr2.sexp", &tree()) {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    }
}

#[test]
fn the_robot_starts_tucked_with_its_torso_at_15_cm() {
    let tree = tree();
    let pr2 = pr2(&tree);
    let q = pr2.start_positions(&tree);
    assert_eq!(pr2.torso.height(&q), 0.15);
    for arm in &pr2.arms {
        assert_eq!(Some(&arm.positions(&q)), arm.posture("tucked"));
    }
}

#[test]
fn sides_are_not_mixed_up() {
    let tree = tree();
    let pr2 = pr2(&tree);
    for (side, prefix) in [(Side::Left, "l_"), (Side::Right, "r_")] {
        let arm = pr2.arm(side);
        let links = [arm.wrist, arm.tool].into_iter().chain(arm.gripper.links());
        for link in links {
            let name = &tree.link(link).name;
            assert!(name.starts_with(prefix), "{name}");
        }
        for joint in arm.joints().iter().chain([&arm.gripper.joint]) {
            let name = &tree.joint(*joint).name;
            assert!(name.starts_with(prefix), "{name}");
        }
        assert_eq!(arm.side, side);
    }
}

#[test]
fn the_solver_uses_soft_limits_and_the_torso_hard_ones() {
    let tree = tree();
    let pr2 = pr2(&tree);
    let elbow = pr2.arm(Side::Left).kinematics.limits()[3].expect("the elbow has limits");
    assert_eq!((elbow.lower, elbow.upper), (-2.1213, -0.15));
    let torso = pr2.torso.limits;
    assert_eq!((torso.lower, torso.upper), (0.0, 0.33));
}

#[test]
fn the_gap_between_the_pads_is_the_measured_one() {
    let tree = tree();
    let pr2 = pr2(&tree);
    let gripper = &pr2.arm(Side::Right).gripper;
    // Measured on the finger meshes.
    for (position, gap) in [
        (0.0, -0.0017),
        (0.1, 0.0165),
        (0.2, 0.0344),
        (0.3, 0.0518),
        (0.4264, 0.0730),
        (0.5, 0.0847),
        (0.548, 0.0920),
    ] {
        assert!((gripper.gap(position) - gap).abs() < 1e-4, "{position}");
        let back = gripper.position_for_gap(gripper.gap(position));
        assert!((back - position).abs() < 1e-9, "{position}");
    }
    assert_eq!(gripper.position_for_gap(1.0), 0.548);
    assert_eq!(gripper.position_for_opening(0.1), 0.5);
    assert_eq!(gripper.position_for_opening(0.2), 0.548);
}

#[test]
fn the_torso_is_faster_than_in_the_urdf_and_the_arm_is_not() {
    let tree = tree();
    let pr2 = pr2(&tree);
    assert_eq!(pr2.speed(pr2.torso.joint.unwrap()).velocity, 0.1);
    for arm in &pr2.arms {
        for joint in arm.joints() {
            let limit = tree
                .joint(*joint)
                .max_velocity
                .expect("arm joints have a speed");
            assert!(pr2.speed(*joint).velocity <= limit);
        }
    }
}

#[test]
fn links_that_touch_include_all_neighbours() {
    let tree = tree();
    let pr2 = pr2(&tree);
    for (_, joint) in tree.joints() {
        let solid = |link| !tree.link(link).collisions.is_empty();
        if !solid(joint.parent) || !solid(joint.child) || pr2.wheels.contains(&joint.child) {
            continue;
        }
        let group = pr2
            .touching
            .iter()
            .find(|group| group.contains(&joint.parent) && group.contains(&joint.child));
        assert!(
            group.is_some(),
            "{} and its parent",
            tree.link(joint.child).name
        );
    }
}

#[test]
fn a_mistyped_link_is_reported_with_its_place() {
    assert_eq!(
        error(":body base_link", ":body base_lnik"),
        "pr2.sexp:9:13: there is no link named base_lnik; did you mean base_link?"
    );
}

#[test]
fn a_mistyped_key_is_reported_with_the_known_ones() {
    assert_eq!(
        error(":start 0.15", ":strat 0.15"),
        "pr2.sexp:14:54: (torso …) has no key :strat; it knows :link :joint :start; did you mean :start?"
    );
}

#[test]
fn a_mistyped_record_is_reported() {
    assert_eq!(
        error("(neck ", "(nekc "),
        "pr2.sexp:17:1: there is no record named nekc; did you mean neck?"
    );
}

#[test]
fn a_missing_record_is_reported() {
    assert_eq!(
        error("(robot PR2)", ""),
        "pr2.sexp:1:1: the file has no (robot …); add one"
    );
}

#[test]
fn a_posture_beyond_the_limits_is_reported() {
    assert_eq!(
        error("((park 1.9652919379395388", "((park 2.9652919379395388"),
        "pr2.sexp:47:13: expected a position of l_shoulder_pan_joint from -0.714601836603 to 2.2853981634, found 2.9652919379395386"
    );
}

#[test]
fn a_missing_parenthesis_is_reported() {
    let said = error("(robot PR2)", "(robot PR2");
    assert!(said.starts_with("pr2.sexp:"), "{said}");
    assert!(said.contains("EOF"), "{said}");
}

#[test]
fn numbers_are_read_to_the_last_digit() {
    let tree = tree();
    let pr2 = pr2(&tree);
    let park = pr2
        .arm(Side::Left)
        .posture("park")
        .expect("there is a parking posture");
    assert_eq!(park[0], 1.9652919379395388);
    assert_eq!(park[4], 16.99646118944817);
    assert_eq!(pr2.camera().vertical_view, 50.0_f64.to_radians());
}

#[test]
fn a_camera_that_the_urdf_lacks_stands_where_the_description_says() {
    let aimed = |at: &str| {
        error(
            "(camera narrow-stereo\n        :frame narrow_stereo_optical_frame",
            &format!("(camera stand :frame base_footprint {at}"),
        )
    };
    assert_eq!(aimed(":at (1 0 2) :looks-at (1 0 1)"), "no error");
    let nowhere = aimed(":at (1 0 2) :looks-at (1 0 2)");
    assert!(nowhere.contains("another point than :at"), "{nowhere}");
    let without = aimed(":looks-at (1 0 1)");
    assert!(without.contains("no :looks-at without :at"), "{without}");
    let blind = aimed(":at (1 0 2)");
    assert!(blind.contains("has no :looks-at; add it"), "{blind}");
}

#[test]
fn a_base_starts_upright_and_on_the_floor_if_it_drives() {
    let started = |at: &str| error(":body base_link", &format!(":body base_link :start {at}"));
    assert_eq!(started("((1 2 0) (0 0 1 0))"), "no error");
    let high = started("((1 2 0.7) (0 0 0 1))");
    assert!(high.contains("with z 0, for a base that drives"), "{high}");
    let leaning = started("((1 2 0) (1 0 0 1))");
    assert!(leaning.contains("an upright pose"), "{leaning}");
    let short = started("(1 2 0)");
    assert!(short.contains("a point and a quaternion"), "{short}");
}
