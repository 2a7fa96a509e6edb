//! Reading URDFs: what is kept, and what is said about a file that is wrong.

use crate::robot::{JointKind, KinematicTree, Limits};
use spatial::Pose;

fn error(body: &str) -> String {
    let text = format!("<robot name=\"r\">\n{body}\n</robot>\n");
    match KinematicTree::from_urdf(&text, "r.urdf") {
        Ok(_) => "no error".to_owned(),
        Err(error) => error.to_string(),
    }
}

fn tree(body: &str) -> KinematicTree {
    let text = format!("<robot name=\"r\">{body}</robot>");
    KinematicTree::from_urdf(&text, "r.urdf").expect("the test's URDF is right")
}

const TWO_LINKS: &str = "<link name=\"a\"/><link name=\"b\"/>";

fn joint(attributes: &str, rest: &str) -> String {
    format!(
        "{TWO_LINKS}\n<joint {attributes}><parent link=\"a\"/><child link=\"b\"/>{rest}</joint>"
    )
}

#[test]
fn a_frame_without_shapes_and_mass_is_kept() {
    let tree = tree(&joint(
        "name=\"j\" type=\"fixed\"",
        "<origin xyz=\"1 2 3\"/>",
    ));
    let b = tree.link_named("b").expect("b is a link");
    let pose = tree.link_pose(b, &Pose::identity(), &tree.zero_positions());
    assert_eq!(pose.translation.vector.as_slice(), [1.0, 2.0, 3.0]);
    assert_eq!(tree.link(b).mass, 0.0);
}

#[test]
fn soft_limits_and_speed_are_kept() {
    let tree = tree(&joint(
        "name=\"j\" type=\"revolute\"",
        "<limit lower=\"-1\" upper=\"2\" effort=\"3\" velocity=\"4\"/>\
         <safety_controller soft_lower_limit=\"-0.5\" soft_upper_limit=\"1.5\" k_velocity=\"1\"/>",
    ));
    let joint = tree.joint(tree.joint_named("j").expect("j is a joint"));
    assert_eq!(joint.kind, JointKind::Revolute);
    assert_eq!(
        joint.limits,
        Some(Limits {
            lower: -1.0,
            upper: 2.0
        })
    );
    assert_eq!(
        joint.soft_limits,
        Some(Limits {
            lower: -0.5,
            upper: 1.5
        })
    );
    assert_eq!(joint.max_velocity, Some(4.0));
}

#[test]
fn a_follower_of_a_follower_moves_with_the_last_one() {
    let prismatic = |name: &str, parent: &str, child: &str, mimic: &str| {
        format!(
            "<joint name=\"{name}\" type=\"prismatic\"><parent link=\"{parent}\"/>\
             <child link=\"{child}\"/><axis xyz=\"1 0 0\"/>\
             <limit lower=\"0\" upper=\"1\" velocity=\"1\"/>{mimic}</joint>"
        )
    };
    let tree = tree(
        &[
            "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/><link name=\"d\"/>".to_owned(),
            prismatic(
                "k",
                "b",
                "c",
                "<mimic joint=\"j\" multiplier=\"2\" offset=\"0.1\"/>",
            ),
            prismatic("l", "c", "d", "<mimic joint=\"k\" multiplier=\"-1\"/>"),
            prismatic("j", "a", "b", ""),
        ]
        .concat(),
    );
    let mut q = tree.zero_positions();
    q.set(tree.joint_named("j").expect("j is a joint"), 0.25);
    let k = tree.joint_named("k").expect("k is a joint");
    let l = tree.joint_named("l").expect("l is a joint");
    assert_eq!((tree.position(&q, k), tree.position(&q, l)), (0.6, -0.6));
    let mut poses = Vec::new();
    tree.forward_kinematics(&Pose::identity(), &q, &mut poses);
    let d = tree.link_named("d").expect("d is a link");
    assert_eq!(poses[d.index()].translation.x, 0.25);
}

#[test]
fn a_wrong_closing_tag_is_reported_with_its_place() {
    assert_eq!(
        error("<link name=\"a\">\n  </joint>"),
        "r.urdf:3:3: </joint> closes nothing; expected </link>, which line 2 opens"
    );
}

#[test]
fn a_missing_attribute_is_reported_with_an_example() {
    assert_eq!(
        error("<link/>"),
        "r.urdf:2:1: <link> has no name; add name=\"base_link\""
    );
}

#[test]
fn a_number_that_is_none_is_reported_at_its_place() {
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"fixed\"",
            "<origin xyz=\"1 2 x\"/>"
        )),
        "r.urdf:3:78: xyz=\"1 2 x\" in <origin> is wrong; expected three numbers from -1e4 to 1e4 (in metres), separated by blanks"
    );
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"fixed\"",
            "<origin xyz=\"1 2 inf\"/>"
        )),
        "r.urdf:3:78: xyz=\"1 2 inf\" in <origin> is wrong; expected three numbers from -1e4 to 1e4 (in metres), separated by blanks"
    );
}

#[test]
fn a_size_that_is_not_positive_is_reported() {
    assert_eq!(
        error(
            "<link name=\"a\"><collision><geometry><box size=\"1 -1 1\"/></geometry></collision></link>"
        ),
        "r.urdf:2:48: size=\"1 -1 1\" in <box> is wrong; expected three lengths from 1e-6 to 1e4 (in metres), separated by blanks"
    );
}

#[test]
fn shapes_with_which_nobody_can_calculate_are_reported() {
    for (attribute, shape) in [
        ("size=\"1 1e308 1\"", "box size=\"1 1e308 1\""),
        ("size=\"1 1e-7 1\"", "box size=\"1 1e-7 1\""),
        (
            "radius=\"1e-300\"",
            "cylinder radius=\"1e-300\" length=\"1\"",
        ),
        ("length=\"1e300\"", "cylinder radius=\"1\" length=\"1e300\""),
        ("radius=\"10001\"", "sphere radius=\"10001\""),
    ] {
        let text = format!(
            "<link name=\"a\"><collision><geometry><{shape}/></geometry></collision></link>"
        );
        let told = error(&text);
        assert!(told.starts_with("r.urdf:2:"), "{told}");
        assert!(
            told.contains(attribute) && told.contains("from 1e-6 to 1e4"),
            "{told}"
        );
    }
    let far = "<link name=\"a\"><visual><origin xyz=\"1e5 0 0\"/><geometry><sphere radius=\"1\"/></geometry></visual></link>";
    assert!(error(far).contains("from -1e4 to 1e4"), "{}", error(far));
}

#[test]
fn an_unknown_shape_is_refused() {
    assert_eq!(
        error(
            "<link name=\"a\"><visual><geometry><plane normal=\"0 0 1\"/></geometry></visual></link>"
        ),
        "r.urdf:2:34: <plane> is not supported: use <box>, <cylinder>, <sphere>, <capsule> or <mesh>"
    );
}

#[test]
fn an_unknown_parent_is_reported_with_the_nearest_name() {
    assert_eq!(
        error(
            "<link name=\"base_link\"/><link name=\"b\"/>\n<joint name=\"j\" type=\"fixed\"><parent link=\"base_lnik\"/><child link=\"b\"/></joint>"
        ),
        "r.urdf:3:1: joint \"j\" names the parent link \"base_lnik\", which does not exist; did you mean \"base_link\"?"
    );
}

#[test]
fn two_links_of_one_name_are_reported() {
    assert_eq!(
        error("<link name=\"a\"/>\n<link name=\"a\"/>"),
        "r.urdf:3:1: there are two links named \"a\" (the other one is on line 2); rename one"
    );
}

#[test]
fn a_second_root_is_reported() {
    assert_eq!(
        error(TWO_LINKS),
        "r.urdf:2:17: links \"a\" and \"b\" both have no parent; connect one of them by a joint"
    );
}

#[test]
fn a_cycle_is_reported() {
    let cycle = "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b\"/></joint>\
                 <joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint>";
    let expected =
        "link \"a\" hangs on itself through its parent joints; the joints must form a tree";
    assert_eq!(
        error(&format!("{TWO_LINKS}{cycle}")),
        format!("r.urdf:2:1: {expected}")
    );
    assert_eq!(
        error(&format!("<link name=\"root\"/>{TWO_LINKS}{cycle}")),
        "r.urdf:2:36: link \"b\" hangs on itself through its parent joints; the joints must form a tree"
    );
}

#[test]
fn reversed_limits_are_reported() {
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"revolute\"",
            "<limit lower=\"1\" upper=\"-1\" effort=\"1\" velocity=\"1\"/>"
        )),
        "r.urdf:3:1: the limits of joint \"j\" are reversed: lower 1 is above upper -1"
    );
}

#[test]
fn a_zero_axis_is_reported() {
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"continuous\"",
            "<axis xyz=\"0 0 0\"/>"
        )),
        "r.urdf:3:1: the axis of joint \"j\" is zero; give a direction such as xyz=\"0 0 1\""
    );
}

#[test]
fn a_follower_of_nobody_is_reported() {
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"continuous\"",
            "<mimic joint=\"k\"/>"
        )),
        "r.urdf:3:1: joint \"j\" names the mimicked joint \"k\", which does not exist; did you mean \"j\"?"
    );
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"continuous\"",
            "<mimic joint=\"j\"/>"
        )),
        "r.urdf:3:1: joint \"j\" mimics itself, directly or through other joints"
    );
}

#[test]
fn limits_are_required_where_the_kind_needs_them() {
    assert_eq!(
        error(&joint("name=\"j\" type=\"prismatic\"", "")),
        "r.urdf:3:1: <joint> has no <limit>; add <limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"1\"/>"
    );
}

#[test]
fn an_unsupported_kind_of_joint_is_reported() {
    assert_eq!(
        error(&joint("name=\"j\" type=\"planar\"", "")),
        "r.urdf:3:23: joint type \"planar\" is not supported; use fixed, revolute, continuous or prismatic"
    );
}

#[test]
fn an_empty_file_is_reported() {
    let error = KinematicTree::from_urdf("", "r.urdf")
        .map(|_| ())
        .map_err(|e| e.to_string());
    assert_eq!(
        error,
        Err(
            "r.urdf:1:1: expected <robot name=\"…\"> as the outermost element, found nothing"
                .to_owned()
        )
    );
}

#[test]
fn a_friction_that_is_no_number_is_reported_at_its_place() {
    assert_eq!(
        error(&joint(
            "name=\"j\" type=\"fixed\"",
            "\n<dynamics friction=\"much\"/>"
        )),
        "r.urdf:4:21: friction=\"much\" in <dynamics> is wrong; expected one finite number"
    );
}

#[test]
fn references_and_later_versions_of_the_format_are_understood() {
    let text = "<robot name=\"r\" version=\"1.1\"><link name=\"a\"/><link name=\"b&amp;c\"/>\
                <joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child link=\"b&amp;c\"/>\
                <origin quat_xyzw=\"0 0 1 0\"/></joint></robot>";
    let tree = KinematicTree::from_urdf(text, "r.urdf").expect("the test's URDF is right");
    let b = tree.link_named("b&c").expect("b&c is a link");
    let pose = tree.link_pose(b, &Pose::identity(), &tree.zero_positions());
    assert!((pose.rotation.angle() - std::f64::consts::PI).abs() < 1e-12);
}
