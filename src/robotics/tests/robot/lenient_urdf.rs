//! What is read although the standard does not allow it, and what is said of it.

use crate::mesh::MeshLibrary;
use crate::robot::{JointKind, KinematicTree, Limits, UrdfReading, UrdfUse, urdf_text};
use spatial::Shape;

fn read(body: &str) -> UrdfReading {
    let text = format!("<robot name=\"r\">\n{body}\n</robot>\n");
    let meshes = MeshLibrary::none();
    KinematicTree::read_urdf(&text, "r.urdf", &meshes, UrdfUse::World)
        .unwrap_or_else(|error| panic!("{error}"))
}

fn remarks(body: &str) -> Vec<String> {
    read(body).remarks.iter().map(ToString::to_string).collect()
}

/// Two links and a joint between them.
fn joint(kind: &str, rest: &str) -> String {
    format!(
        "<link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\" type=\"{kind}\"><parent link=\"a\"/>\
         <child link=\"b\"/>{rest}</joint>"
    )
}

#[test]
fn materials_without_names_keep_their_colours_and_are_said_once() {
    let visual = |name: &str, red: u8| {
        format!(
            "<visual><geometry><sphere radius=\"1\"/></geometry>\
             <material{name}><color rgba=\"{red} 0 0 1\"/></material></visual>\n"
        )
    };
    let body = format!(
        "<link name=\"a\">\n{}{}{}</link>",
        visual(" name=\"\"", 1),
        visual("", 0),
        visual(" name=\"\"", 1)
    );
    let reading = read(&body);
    let (_, link) = reading.tree.links().next().expect("there is a link");
    let colors: Vec<_> = link
        .visuals
        .iter()
        .map(|shape| shape.color.map(|c| c[0]))
        .collect();
    assert_eq!(colors, [Some(1.0), Some(0.0), Some(1.0)]);
    assert_eq!(
        remarks(&body)[1..],
        [
            "r.urdf:3:66: <material> has no name; its colour is that of this shape alone (and 2 times more)"
        ]
    );
}

#[test]
fn of_children_that_may_stand_once_the_last_one_counts() {
    let body = joint(
        "continuous",
        "<origin xyz=\"1 0 0\"/>\n<origin xyz=\"2 0 0\"/><limit velocity=\"1\"/>\n<limit velocity=\"2\"/>",
    );
    let tree = read(&body).tree;
    let joint = tree.joint(tree.joint_named("j").expect("there is a joint"));
    assert_eq!(joint.origin.translation.x, 2.0);
    assert_eq!(joint.max_velocity, Some(2.0));
    assert_eq!(
        remarks(&body),
        [
            "r.urdf:4:1: <joint> has a second <origin>; the last one counts",
            "r.urdf:5:1: <joint> has a second <limit>; the last one counts",
        ]
    );
}

#[test]
fn a_capsule_is_a_cylinder_with_balls() {
    let body = "<link name=\"a\"><collision><geometry><capsule radius=\"0.1\" length=\"0.4\"/></geometry>\
                </collision></link>";
    let tree = read(body).tree;
    let (_, link) = tree.links().next().expect("there is a link");
    let ends: Vec<f64> = link
        .collisions
        .iter()
        .map(|shape| shape.pose.translation.z)
        .collect();
    assert_eq!(ends, [0.0, -0.2, 0.2]);
    assert!(matches!(link.collisions[0].shape, Shape::Cylinder { .. }));
    assert_eq!(
        remarks(body),
        ["r.urdf:2:37: <capsule> is taken as a cylinder with a ball at either end"]
    );
}

#[test]
fn shapes_without_a_size_are_left_out() {
    let body = "<link name=\"a\"><collision><geometry><box size=\"1 0 1\"/></geometry></collision>\
                <collision><geometry><sphere radius=\"0\"/></geometry></collision></link>";
    assert!(
        read(body)
            .tree
            .links()
            .all(|(_, link)| link.collisions.is_empty())
    );
    assert_eq!(
        remarks(body),
        ["r.urdf:2:48: a shape of size \"1 0 1\" is left out (and once more)"]
    );
}

#[test]
fn limits_may_say_effort_alone() {
    let body = joint("continuous", "<limit effort=\"5\"/>");
    let tree = read(&body).tree;
    let joint_of = |tree: &KinematicTree| {
        let (_, joint) = tree.joints().next().expect("there is a joint");
        joint.clone()
    };
    assert_eq!(joint_of(&tree).max_effort, Some(5.0));
    assert_eq!(
        remarks(&body),
        ["r.urdf:3:70: <limit> has no velocity; the joint is as fast as others are"]
    );
    let body = joint("revolute", "<limit effort=\"-5\" velocity=\"1\"/>");
    let still = joint_of(&read(&body).tree);
    assert_eq!(
        (still.limits, still.max_effort),
        (
            Some(Limits {
                lower: 0.0,
                upper: 0.0
            }),
            None
        )
    );
    assert_eq!(
        remarks(&body),
        [
            "r.urdf:3:68: <limit> of joint \"j\" has neither lower nor upper; the joint stands at 0",
            "r.urdf:3:83: effort=\"-5\" is negative; it is taken as not given",
        ]
    );
}

#[test]
fn a_follower_without_limits_has_those_that_follow() {
    let follower = |kind: &str, limits: &str| {
        format!(
            "<link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>\n\
             <joint name=\"j\" type=\"{kind}\"><parent link=\"a\"/><child link=\"b\"/>{limits}</joint>\n\
             <joint name=\"k\" type=\"revolute\"><parent link=\"b\"/><child link=\"c\"/>\
             <mimic joint=\"j\" multiplier=\"-2\" offset=\"1\"/></joint>"
        )
    };
    let body = follower(
        "revolute",
        "<limit lower=\"0\" upper=\"0.5\" velocity=\"1\"/>",
    );
    let tree = read(&body).tree;
    let k = tree.joint(tree.joint_named("k").expect("there is a follower"));
    assert_eq!(
        k.limits,
        Some(Limits {
            lower: 0.0,
            upper: 1.0
        })
    );
    assert_eq!(
        remarks(&body),
        [
            "r.urdf:4:1: joint \"k\" follows another one and has no limits; they follow from the other's"
        ]
    );
    let tree = read(&follower("continuous", "")).tree;
    let k = tree.joint(tree.joint_named("k").expect("there is a follower"));
    assert_eq!((k.kind, k.limits), (JointKind::Continuous, None));
}

#[test]
fn an_axis_without_direction_is_x() {
    let body = joint("continuous", "<axis/>");
    let (_, joint) = read(&body)
        .tree
        .joints()
        .map(|(id, joint)| (id, joint.clone()))
        .next()
        .expect("one");
    assert_eq!(joint.axis.x, 1.0);
    assert_eq!(
        remarks(&body),
        ["r.urdf:3:70: <axis> has no xyz; it is taken as 1 0 0"]
    );
}

#[test]
fn what_belongs_to_others_is_passed_over() {
    let body = "<link name=\"a\"><contact><friction value=\"much\"/></contact>\
                <sensor><origin xyz=\"here\"/></sensor></link>\n\
                <gazebo><joint name=\"x\"/></gazebo>\n<loop_joint name=\"l\"/>";
    assert_eq!(
        remarks(body),
        ["r.urdf:4:1: <loop_joint> is left out: joints form a tree here"]
    );
}

#[test]
fn what_is_visible_is_solid_if_nothing_else_is() {
    let body =
        "<link name=\"a\"><visual><geometry><box size=\"1 1 1\"/></geometry></visual></link>";
    let said = "r.urdf:2:34: no link has a <collision>; what is visible is taken as solid";
    assert_eq!(remarks(body), [said]);
    let (_, link) = read(body)
        .tree
        .links()
        .map(|(id, link)| (id, link.clone()))
        .next()
        .expect("one");
    assert_eq!((link.collisions.len(), link.visuals.len()), (1, 1));
    // The body of a robot is what it says.
    let text = format!("<robot name=\"r\">{body}</robot>");
    let tree = KinematicTree::from_urdf(&text, "r.urdf").expect("the robot is right");
    assert!(tree.links().all(|(_, link)| link.collisions.is_empty()));
}

#[test]
fn macros_are_named_as_such() {
    let advice = "this is xacro, from which a URDF is made: expand it, `xacro FILE.xacro > FILE.urdf`, \
                  and give the FILE.urdf";
    for (body, place) in [
        ("<xacro:include filename=\"b.xacro\"/>", "2:1"),
        ("<link name=\"${prefix}a\"/>", "2:13"),
        (
            "<link name=\"a\"><visual><geometry><mesh filename=\"$(find p)/a.stl\"/></geometry></visual></link>",
            "2:50",
        ),
    ] {
        let text = format!(
            "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\">\n{body}</robot>"
        );
        let error = KinematicTree::from_urdf(&text, "r.urdf").expect_err("it is xacro");
        assert_eq!(error.to_string(), format!("r.urdf:{place}: {advice}"));
    }
    // The name of the format alone is none.
    let text = "<robot name=\"r\" xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><link name=\"a\"/></robot>";
    assert!(KinematicTree::from_urdf(text, "r.urdf").is_ok());
}

#[test]
fn a_declared_encoding_is_read() {
    let file = b"<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n<robot name=\"K\xfcche\"><link name=\"a\"/></robot>";
    let text = urdf_text(file).expect("the encoding is declared");
    let meshes = MeshLibrary::none();
    let reading =
        KinematicTree::read_urdf(&text, "k.urdf", &meshes, UrdfUse::World).expect("it is right");
    assert_eq!(reading.tree.name(), "Küche");
    assert_eq!(
        reading
            .remarks
            .iter()
            .map(ToString::to_string)
            .collect::<Vec<_>>(),
        ["k.urdf:1:1: the file is read as ISO-8859-1, as it declares"]
    );
    assert_eq!(
        urdf_text(b"<robot>\n\xfc"),
        Err(
            "it is not UTF-8 at line 2, column 1: byte 0xfc; save the file as UTF-8, or declare what it is: <?xml \
             version=\"1.0\" encoding=\"ISO-8859-1\"?>"
                .to_owned()
        )
    );
    assert_eq!(
        urdf_text(b"\xef\xbb\xbf<robot/>"),
        Ok("<robot/>".to_owned())
    );
}
