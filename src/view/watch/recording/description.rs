//! What consists of boxes, cylinders and spheres as descriptions in URDF, for viewers that draw these
//! and no scenes: rerun does.
//!
//! Each description is a message of the type `std_msgs/msg/String` of ROS 2. Its links are named after the
//! frames of the nodes, which say where they are; all of them hang at the map.

use std::fmt::Write;

use nalgebra::Matrix3;

use super::shapes::{MAP, color, frame_of};
use crate::watch::{Kind, Node};
use spatial::{PlacedShape, Pose, Shape, trig};

/// The type of the messages, and its definition.
pub(super) const MESSAGE: &str = "std_msgs/msg/String";
pub(super) const DEFINITION: &str = "string data\n";

/// What a shape looks like that has no colour.
const PLAIN: [f32; 4] = [0.6, 0.6, 0.6, 1.0];

/// The topic of the descriptions of nodes of a kind.
pub(super) fn topic(kind: Kind) -> &'static str {
    match kind {
        Kind::Robot => "/robot_description",
        Kind::Furniture => "/kitchen/robot_description",
        Kind::Object => "/objects/robot_description",
    }
}

/// The nodes as a description with that name; `None` if none of them consists of anything that URDF
/// knows.
pub(super) fn description<'n>(name: &str, nodes: impl Iterator<Item = &'n Node>) -> Option<String> {
    let mut links = String::new();
    for node in nodes {
        let shapes: String = node.shapes.iter().filter_map(visual).collect();
        if shapes.is_empty() {
            continue;
        }
        let frame = escaped(&frame_of(node));
        // Writing to a text cannot fail.
        let _ = write!(
            links,
            "<link name=\"{frame}\">{shapes}</link><joint name=\"{frame}\" type=\"fixed\">\
             <parent link=\"{MAP}\"/><child link=\"{frame}\"/></joint>"
        );
    }
    let name = escaped(name);
    (!links.is_empty())
        .then(|| format!("<robot name=\"{name}\"><link name=\"{MAP}\"/>{links}</robot>"))
}

/// A text as the message, in the representation of ROS 2: little endian CDR.
pub(super) fn message(text: &str) -> Vec<u8> {
    // A description of four gigabytes does not fit into memory.
    let length = u32::try_from(text.len() + 1).unwrap_or(u32::MAX);
    let mut bytes = vec![0, 1, 0, 0];
    bytes.extend(length.to_le_bytes());
    bytes.extend(text.bytes());
    bytes.push(0);
    bytes
}

/// A shape as an element of a link; `None` for a mesh.
fn visual(placed: &PlacedShape) -> Option<String> {
    let geometry = match &placed.shape {
        Shape::Box { size: [x, y, z] } => format!("<box size=\"{x} {y} {z}\"/>"),
        Shape::Cylinder { radius, length } => {
            format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>")
        }
        Shape::Sphere { radius } => format!("<sphere radius=\"{radius}\"/>"),
        Shape::Hull(_) | Shape::Mesh(_) => return None,
    };
    let [x, y, z] = placed.pose.translation.vector.into();
    let [roll, pitch, yaw] = roll_pitch_yaw(&placed.pose);
    let shade = color(placed.color.unwrap_or(PLAIN));
    let (r, g, b, a) = (shade.r, shade.g, shade.b, shade.a);
    Some(format!(
        "<visual><origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/><geometry>{geometry}</geometry>\
         <material name=\"{r} {g} {b} {a}\"><color rgba=\"{r} {g} {b} {a}\"/></material></visual>"
    ))
}

/// The turns (rad) about the fixed axes x, y, z, one after the other, as URDF has them.
fn roll_pitch_yaw(pose: &Pose) -> [f64; 3] {
    let turn: Matrix3<f64> = pose.rotation.to_rotation_matrix().into_inner();
    let level = libm::hypot(turn[(0, 0)], turn[(1, 0)]);
    let pitch = trig::atan2(-turn[(2, 0)], level);
    if level < 1e-9 {
        // Only the sum or the difference of the other two matters.
        return [0.0, pitch, trig::atan2(-turn[(0, 1)], turn[(1, 1)])];
    }
    let roll = trig::atan2(turn[(2, 1)], turn[(2, 2)]);
    [roll, pitch, trig::atan2(turn[(1, 0)], turn[(0, 0)])]
}

/// A text as the value of an attribute.
fn escaped(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => plain.push_str("&amp;"),
            '<' => plain.push_str("&lt;"),
            '"' => plain.push_str("&quot;"),
            // No text of XML may have them.
            c if c.is_control() => plain.push('?'),
            c => plain.push(c),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;
    use std::sync::Arc;

    use super::*;
    use robotics::robot::KinematicTree;
    use spatial::pose::{angle_between, from_xyz_rpy};

    fn node(name: &str, shapes: Vec<PlacedShape>) -> Node {
        Node {
            id: 0,
            name: name.to_owned(),
            kind: Kind::Object,
            type_name: String::new(),
            parent: None,
            still: None,
            mesh: Arc::default(),
            shapes: shapes.into(),
        }
    }

    #[test]
    fn the_turns_are_those_of_the_pose() {
        let turns = [-3.0, -FRAC_PI_2, -0.4, 0.0, 1.0, FRAC_PI_2, 2.5];
        for roll in turns {
            for pitch in turns {
                for yaw in turns {
                    let pose = from_xyz_rpy([0.0; 3], [roll, pitch, yaw]);
                    let again = from_xyz_rpy([0.0; 3], roll_pitch_yaw(&pose));
                    let off = angle_between(&pose, &again);
                    assert!(off < 1e-7, "{roll} {pitch} {yaw}: {off}");
                }
            }
        }
    }

    #[test]
    fn a_description_is_urdf_with_the_shapes_in_it() {
        let pose = from_xyz_rpy([0.1, -0.2, 0.3], [0.4, 0.5, -0.6]);
        let shapes = [
            Shape::Box {
                size: [0.1, 0.2, 0.3],
            },
            Shape::Cylinder {
                radius: 0.04,
                length: 0.2,
            },
            Shape::Sphere { radius: 0.05 },
        ];
        let shapes = shapes.map(|shape| PlacedShape {
            shape,
            pose,
            color: None,
        });
        let odd = "a<b>&\"c\"\u{1b}";
        let nodes = [node(odd, shapes.to_vec()), node("empty", Vec::new())];
        let text = description("objects", nodes.iter()).expect("there is something");
        let tree = KinematicTree::from_urdf(&text, "objects.urdf").expect("it is URDF");
        let names: Vec<&str> = tree.links().map(|(_, link)| link.name.as_str()).collect();
        assert_eq!(names, [MAP, "object/a<b>&\"c\"?"]);
        let (_, link) = tree.links().nth(1).expect("there are two");
        assert_eq!(link.visuals.len(), 3);
        for (read, written) in link.visuals.iter().zip(&shapes) {
            assert_eq!(read.shape, written.shape);
            assert!((read.pose.translation.vector - pose.translation.vector).norm() < 1e-12);
            assert!(angle_between(&read.pose, &pose) < 1e-7);
        }
        assert_eq!(description("objects", nodes.iter().skip(1)), None);
    }

    #[test]
    fn a_message_is_a_string_of_ros() {
        assert_eq!(message("ab"), *b"\0\x01\0\0\x03\0\0\0ab\0");
    }
}
