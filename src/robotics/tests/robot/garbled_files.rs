//! Whatever a file holds, reading it ends in a value or in an error, never in a crash.

use crate::robot::{KinematicTree, RobotDescription};
use crate::world::grasp_library::{GRASPS, GraspLibrary};
use crate::world::object_library::{OBJECTS, ObjectLibrary};
use descriptions::{PR2_DESCRIPTION, PR2_URDF};
use proptest::prelude::*;
use std::sync::LazyLock;

static TREE: LazyLock<KinematicTree> = LazyLock::new(|| {
    KinematicTree::from_urdf(PR2_URDF, "pr2.urdf").expect("the built-in PR2 is right")
});

const URDF: &str = "<?xml version=\"1.0\"?>\n<robot name=\"r\"><!-- two links -->\
    <material name=\"red\"><color rgba=\"1 0 0 1\"/></material>\
    <link name=\"a\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" \
    iyz=\"0\" izz=\"1\"/></inertial><visual><origin xyz=\"0 0 1\"/><geometry><box size=\"1 1 1\"/>\
    </geometry><material name=\"red\"/></visual></link><link name=\"b\"/>\
    <joint name=\"j\" type=\"revolute\"><parent link=\"a\"/><child link=\"b\"/><axis xyz=\"0 0 1\"/>\
    <limit lower=\"-1\" upper=\"1\" velocity=\"1\"/><mimic joint=\"j\"/></joint></robot>";

/// The text with a stretch of it replaced.
fn garbled(text: &str, from: usize, length: usize, patch: &str) -> String {
    let chars: Vec<char> = text.chars().collect();
    let from = from % (chars.len() + 1);
    let to = (from + length).min(chars.len());
    chars[..from].iter().collect::<String>() + patch + &chars[to..].iter().collect::<String>()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn garbled_urdfs_are_no_crash(from in 0..10_000_usize, length in 0..30_usize, patch in "[ -~\n\u{e4}<>/\"=]{0,4}") {
        let _ = KinematicTree::from_urdf(&garbled(URDF, from, length, &patch), "r.urdf");
    }

    #[test]
    fn garbled_data_is_no_crash(from in 0..100_000_usize, length in 0..30_usize, patch in "[ -~\n\u{e4}()#:;|\"]{0,4}") {
        let text = |text| garbled(text, from, length, &patch);
        let _ = RobotDescription::from_sexp(&text(PR2_DESCRIPTION), "pr2.sexp", &TREE);
        let _ = ObjectLibrary::from_sexp(&text(OBJECTS), "objects.sexp");
        let _ = GraspLibrary::from_sexp(&text(GRASPS), "grasps.sexp");
    }
}

#[test]
fn endless_nesting_is_refused() {
    let urdf = format!("<robot>{}", "<link>".repeat(100_000));
    let error = KinematicTree::from_urdf(&urdf, "r.urdf")
        .map(|_| ())
        .map_err(|e| e.to_string());
    let expected = "r.urdf:1:386: <link> is nested more than 64 deep; a URDF needs five levels";
    assert_eq!(error, Err(expected.to_owned()));
    let data = "(".repeat(100_000);
    assert!(ObjectLibrary::from_sexp(&data, "objects.sexp").is_err());
}

#[test]
fn lists_without_a_proper_end_are_refused() {
    for data in [
        "(object . x)",
        "(object o . x)",
        "(available . (tray))",
        "()",
        "(())",
        "#(a)",
    ] {
        assert!(
            ObjectLibrary::from_sexp(data, "objects.sexp").is_err(),
            "{data}"
        );
    }
}
