//! The URDF reader's data structures, built from elements that have been checked.
//!
//! `urdf_rs` parses a text three times, which takes most of a session's start-up time. Here
//! the elements are already parsed and their values checked by the schema, so they only
//! need to be sorted into its structures. Texts that need more, such as references like
//! `&amp;` or the rules of later versions of the format, are left to `urdf_rs`.

use urdf_rs::{
    Axis, Calibration, Collision, Color, Dynamics, Geometry, Inertia, Inertial, Joint, JointLimit,
    JointType, Link, LinkName, Mass, Material, Mimic, Pose, Robot, SafetyController, Texture, Vec3,
    Vec4, Visual,
};

use super::xml_elements::Element;

/// Whether [`robot`] yields what `urdf_rs` would read from the text: version 1.0 of the
/// format, without references.
pub(super) fn is_plain(text: &str, elements: &[Element<'_>]) -> bool {
    let version = elements.first().and_then(|root| root.attribute("version"));
    version.is_none_or(|v| v.value == "1.0") && !text.contains('&')
}

/// The robot that the elements describe; they must satisfy the schema.
pub(super) fn robot(elements: &[Element<'_>]) -> Robot {
    let root = Node { elements, index: 0 };
    Robot {
        name: root.text("name"),
        version: root.value("version").map(str::to_owned),
        links: root.children("link").map(link).collect(),
        joints: root.children("joint").map(joint).collect(),
        materials: root.children("material").map(material).collect(),
    }
}

/// An element in the list of all elements.
#[derive(Clone, Copy)]
struct Node<'a> {
    elements: &'a [Element<'a>],
    index: usize,
}

impl<'a> Node<'a> {
    fn element(self) -> Option<&'a Element<'a>> {
        self.elements.get(self.index)
    }

    /// The elements directly in this one.
    fn contents(self) -> impl Iterator<Item = Node<'a>> {
        let elements = self.elements;
        let parent = Some(self.index);
        // The contents of an element follow it directly, in the order of the file.
        (self.index + 1..elements.len())
            .take_while(move |&i| elements[i].parent >= parent)
            .filter(move |&i| elements[i].parent == parent)
            .map(move |index| Node { elements, index })
    }

    fn name(self) -> &'a str {
        self.element().map_or("", |e| e.name)
    }

    fn children(self, name: &'a str) -> impl Iterator<Item = Node<'a>> {
        self.contents().filter(move |node| node.name() == name)
    }

    fn child(self, name: &'a str) -> Option<Node<'a>> {
        self.children(name).next()
    }

    fn value(self, attribute: &str) -> Option<&'a str> {
        Some(self.element()?.attribute(attribute)?.value)
    }

    fn text(self, attribute: &str) -> String {
        self.value(attribute).unwrap_or_default().to_owned()
    }

    fn number(self, attribute: &str) -> Option<f64> {
        self.value(attribute)?.trim().parse().ok()
    }

    /// A number that defaults to 0.
    fn number_or_zero(self, attribute: &str) -> f64 {
        self.number(attribute).unwrap_or_default()
    }

    fn numbers<const N: usize>(self, attribute: &str) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        let mut words = self.value(attribute)?.split_whitespace();
        for number in &mut numbers {
            *number = words.next()?.parse().ok()?;
        }
        Some(numbers)
    }

    fn vector(self, attribute: &str) -> Vec3 {
        Vec3(self.numbers(attribute).unwrap_or_default())
    }

    fn origin(self) -> Pose {
        let pose = |origin: Node<'_>| Pose {
            xyz: origin.vector("xyz"),
            rpy: origin.vector("rpy"),
        };
        self.child("origin").map(pose).unwrap_or_default()
    }

    fn geometry(self) -> Geometry {
        let shape = self.child("geometry").and_then(|g| g.contents().next());
        match shape.map(|shape| (shape, shape.name())) {
            Some((shape, "cylinder")) => Geometry::Cylinder {
                radius: shape.number_or_zero("radius"),
                length: shape.number_or_zero("length"),
            },
            Some((shape, "sphere")) => Geometry::Sphere {
                radius: shape.number_or_zero("radius"),
            },
            // The schema lets nothing else pass.
            Some((shape, _)) => Geometry::Box {
                size: shape.vector("size"),
            },
            None => Geometry::default(),
        }
    }

    fn link_name(self, child: &'a str) -> LinkName {
        LinkName {
            link: self
                .child(child)
                .map(|c| c.text("link"))
                .unwrap_or_default(),
        }
    }
}

fn link(node: Node<'_>) -> Link {
    let name = |node: Node<'_>| node.value("name").map(str::to_owned);
    Link {
        name: node.text("name"),
        inertial: node.child("inertial").map(inertial).unwrap_or_default(),
        visual: node
            .children("visual")
            .map(|visual| Visual {
                name: name(visual),
                origin: visual.origin(),
                geometry: visual.geometry(),
                material: visual.child("material").map(material),
            })
            .collect(),
        collision: node
            .children("collision")
            .map(|collision| Collision {
                name: name(collision),
                origin: collision.origin(),
                geometry: collision.geometry(),
            })
            .collect(),
    }
}

fn inertial(node: Node<'_>) -> Inertial {
    let mass = |mass: Node<'_>| Mass {
        value: mass.number_or_zero("value"),
    };
    let inertia = |inertia: Node<'_>| Inertia {
        ixx: inertia.number_or_zero("ixx"),
        ixy: inertia.number_or_zero("ixy"),
        ixz: inertia.number_or_zero("ixz"),
        iyy: inertia.number_or_zero("iyy"),
        iyz: inertia.number_or_zero("iyz"),
        izz: inertia.number_or_zero("izz"),
    };
    Inertial {
        origin: node.origin(),
        mass: node.child("mass").map(mass).unwrap_or_default(),
        inertia: node.child("inertia").map(inertia).unwrap_or_default(),
    }
}

fn material(node: Node<'_>) -> Material {
    Material {
        name: node.text("name"),
        color: node.child("color").map(|color| Color {
            rgba: Vec4(color.numbers("rgba").unwrap_or_default()),
        }),
        texture: node.child("texture").map(|texture| Texture {
            filename: texture.text("filename"),
        }),
    }
}

fn joint(node: Node<'_>) -> Joint {
    Joint {
        name: node.text("name"),
        joint_type: match node.value("type") {
            Some("revolute") => JointType::Revolute,
            Some("continuous") => JointType::Continuous,
            Some("prismatic") => JointType::Prismatic,
            // The schema lets nothing else pass.
            _ => JointType::Fixed,
        },
        origin: node.origin(),
        parent: node.link_name("parent"),
        child: node.link_name("child"),
        axis: node
            .child("axis")
            .map(|axis| Axis {
                xyz: axis.vector("xyz"),
            })
            .unwrap_or_default(),
        limit: node
            .child("limit")
            .map(|limit| JointLimit {
                lower: limit.number_or_zero("lower"),
                upper: limit.number_or_zero("upper"),
                effort: limit.number_or_zero("effort"),
                velocity: limit.number_or_zero("velocity"),
                // Version 1.0 has none of the others.
                ..JointLimit::default()
            })
            .unwrap_or_default(),
        calibration: node.child("calibration").map(|calibration| Calibration {
            rising: calibration.number("rising"),
            falling: calibration.number("falling"),
        }),
        dynamics: node.child("dynamics").map(|dynamics| Dynamics {
            damping: dynamics.number_or_zero("damping"),
            friction: dynamics.number_or_zero("friction"),
        }),
        mimic: node.child("mimic").map(|mimic| Mimic {
            joint: mimic.text("joint"),
            multiplier: mimic.number("multiplier"),
            offset: mimic.number("offset"),
        }),
        safety_controller: node
            .child("safety_controller")
            .map(|safety| SafetyController {
                soft_lower_limit: safety.number_or_zero("soft_lower_limit"),
                soft_upper_limit: safety.number_or_zero("soft_upper_limit"),
                k_position: safety.number_or_zero("k_position"),
                k_velocity: safety.number_or_zero("k_velocity"),
            }),
    }
}

#[cfg(test)]
mod tests {
    use descriptions::{KITCHEN_URDF, PR2_URDF};

    use super::*;
    use crate::robot::xml_elements::elements;

    /// Everything in a URDF of version 1.0 that this program understands.
    const ALL: &str = r#"<?xml version="1.0"?>
        <!-- a comment with <link name="x"/> -->
        <robot name="r" version="1.0">
          <material name="red"><color rgba="1 0 0 0.5"/></material>
          <joint name="j" type="revolute">
            <child link="b"/><parent link="a"/><origin rpy="0 0 1.5"/><axis xyz="0 1 0"/>
            <limit upper=" 1e0 " velocity="2" effort="3"/>
            <calibration rising="0.1"/><dynamics damping="1"/>
            <safety_controller k_velocity="10" soft_lower_limit="-0.5"/>
          </joint>
          <link name="a">
            <visual name="v"><geometry><sphere radius="1"/></geometry></visual>
            <collision><geometry><box size="1 2  3"/></geometry></collision>
            <visual>
              <origin xyz="1 2 3" rpy="0 0 1"/><geometry><cylinder radius="1" length="2"/></geometry>
              <material name="blue"><color rgba="0 0 1 1"/></material>
            </visual>
            <inertial>
              <mass value="2"/><origin xyz="0 0 1"/>
              <inertia ixx="1" ixy="2" ixz="3" iyy="4" iyz="5" izz="6"/>
            </inertial>
          </link>
          <gazebo reference="a"><link name="none"/></gazebo>
          <link name="b"/><link name="c"/>
          <joint name="k" type="prismatic">
            <parent link="b"/><child link="c"/><limit lower="-1" velocity="1"/>
            <mimic joint="j" offset="0.25"/>
          </joint>
        </robot>"#;

    #[test]
    fn the_elements_give_what_the_urdf_reader_gives() {
        for text in [ALL, PR2_URDF, KITCHEN_URDF] {
            let elements = elements(text).map_err(|(_, problem)| problem).unwrap();
            assert!(is_plain(text, &elements));
            let ours = robot(&elements);
            let theirs = urdf_rs::read_from_string(text).unwrap();
            assert_eq!(format!("{ours:?}"), format!("{theirs:?}"));
        }
    }
}
