//! What a URDF may contain: the attributes and children that each element needs, and
//! the values they may have. Checked before the file is read.

use std::ops::RangeInclusive;

use super::urdf_error::UrdfProblem;
use super::xml_elements::Element;

/// The kind of value that an attribute may have.
#[derive(Clone, Copy)]
enum Value {
    Text,
    JointType,
    Number,
    NotNegative,
    Length,
    Three,
    Position,
    ThreeLengths,
    Color,
}

/// The lengths of shapes, in metres, with which the physics engine can calculate.
const LENGTHS: RangeInclusive<f64> = 1e-6..=1e4;

impl Value {
    /// Wording for messages.
    fn expected(self) -> &'static str {
        match self {
            Self::Text => "a text that is not empty",
            Self::JointType => "fixed, revolute, continuous or prismatic",
            Self::Number => "one finite number",
            Self::NotNegative => "one finite number that is not negative",
            Self::Length => "one length from 1e-6 to 1e4 (in metres)",
            Self::Three => "three finite numbers separated by blanks",
            Self::Position => "three numbers from -1e4 to 1e4 (in metres), separated by blanks",
            Self::ThreeLengths => "three lengths from 1e-6 to 1e4 (in metres), separated by blanks",
            Self::Color => "four numbers from 0 to 1 (red green blue alpha)",
        }
    }

    fn accepts(self, value: &str) -> bool {
        let all = |count: usize, test: fn(f64) -> bool| {
            let good = |word: &str| word.parse().is_ok_and(|n: f64| n.is_finite() && test(n));
            let mut words = value.split_whitespace();
            (0..count).all(|_| words.next().is_some_and(good)) && words.next().is_none()
        };
        match self {
            Self::Text => !value.trim().is_empty(),
            Self::JointType => ["fixed", "revolute", "continuous", "prismatic"].contains(&value),
            Self::Number => all(1, |_| true),
            Self::NotNegative => all(1, |n| n >= 0.0),
            Self::Length => all(1, |n| LENGTHS.contains(&n)),
            Self::Three => all(3, |_| true),
            Self::Position => all(3, |n| n.abs() <= *LENGTHS.end()),
            Self::ThreeLengths => all(3, |n| LENGTHS.contains(&n)),
            Self::Color => all(4, |n| (0.0..=1.0).contains(&n)),
        }
    }
}

/// Element, attribute, kind of value, and an example when the attribute is required.
const ATTRIBUTES: &[(&str, &str, Value, Option<&str>)] = &[
    ("link", "name", Value::Text, Some("base_link")),
    ("joint", "name", Value::Text, Some("elbow_joint")),
    ("joint", "type", Value::JointType, Some("fixed")),
    ("parent", "link", Value::Text, Some("base_link")),
    ("child", "link", Value::Text, Some("arm_link")),
    ("origin", "xyz", Value::Position, None),
    ("origin", "rpy", Value::Three, None),
    ("axis", "xyz", Value::Three, Some("0 0 1")),
    ("limit", "lower", Value::Number, None),
    ("limit", "upper", Value::Number, None),
    ("limit", "effort", Value::NotNegative, None),
    ("limit", "velocity", Value::NotNegative, Some("1.0")),
    ("safety_controller", "soft_lower_limit", Value::Number, None),
    ("safety_controller", "soft_upper_limit", Value::Number, None),
    ("safety_controller", "k_position", Value::Number, None),
    ("safety_controller", "k_velocity", Value::Number, Some("10")),
    ("calibration", "rising", Value::Number, None),
    ("calibration", "falling", Value::Number, None),
    ("dynamics", "damping", Value::Number, None),
    ("dynamics", "friction", Value::Number, None),
    ("mimic", "joint", Value::Text, Some("finger_joint")),
    ("mimic", "multiplier", Value::Number, None),
    ("mimic", "offset", Value::Number, None),
    ("mass", "value", Value::NotNegative, Some("1.0")),
    ("inertia", "ixx", Value::Number, Some("0.1")),
    ("inertia", "ixy", Value::Number, Some("0")),
    ("inertia", "ixz", Value::Number, Some("0")),
    ("inertia", "iyy", Value::Number, Some("0.1")),
    ("inertia", "iyz", Value::Number, Some("0")),
    ("inertia", "izz", Value::Number, Some("0.1")),
    ("box", "size", Value::ThreeLengths, Some("0.1 0.2 0.3")),
    ("cylinder", "radius", Value::Length, Some("0.1")),
    ("cylinder", "length", Value::Length, Some("0.2")),
    ("sphere", "radius", Value::Length, Some("0.1")),
    ("material", "name", Value::Text, Some("grey")),
    ("color", "rgba", Value::Color, Some("0.5 0.5 0.5 1")),
];

/// Element, required child, and an example of the child.
const CHILDREN: &[(&str, &str, &str)] = &[
    ("joint", "parent", "<parent link=\"…\"/>"),
    ("joint", "child", "<child link=\"…\"/>"),
    ("inertial", "mass", "<mass value=\"1.0\"/>"),
    (
        "inertial",
        "inertia",
        "<inertia ixx=\"0.1\" ixy=\"0\" … izz=\"0.1\"/>",
    ),
    (
        "visual",
        "geometry",
        "<geometry><box size=\"0.1 0.1 0.1\"/></geometry>",
    ),
    (
        "collision",
        "geometry",
        "<geometry><box size=\"0.1 0.1 0.1\"/></geometry>",
    ),
];

/// Elements whose children may each appear only once.
const SINGLE_CHILDREN: &[&str] = &[
    "joint",
    "inertial",
    "visual",
    "collision",
    "geometry",
    "material",
];

/// Whether the element may hold only one such child.
fn is_single(element: &str, child: &str) -> bool {
    SINGLE_CHILDREN.contains(&element) || (element, child) == ("link", "inertial")
}

/// Finds the first element that breaks the rules: its byte offset and what is wrong.
///
/// Only links, joints and materials are checked; other elements of a robot, such as
/// `transmission` and `gazebo`, have no meaning here.
pub(super) fn check(elements: &[Element<'_>]) -> Result<(), (usize, UrdfProblem)> {
    match elements.first() {
        None => return Err((0, UrdfProblem::NotARobot("nothing".to_owned()))),
        Some(root) if root.name != "robot" => {
            let found = format!("<{}>", root.name);
            return Err((root.offset, UrdfProblem::NotARobot(found)));
        }
        Some(_) => {}
    }
    if let Some(second) = elements.iter().skip(1).find(|e| e.parent.is_none()) {
        let found = format!("a second one, <{}>", second.name);
        return Err((second.offset, UrdfProblem::NotARobot(found)));
    }
    for (i, element) in elements.iter().enumerate().skip(1) {
        if matters(elements, i) {
            check_attributes(element)?;
            check_children(elements, i)?;
        }
    }
    Ok(())
}

/// Whether the element belongs to a link, a joint or a material of the robot.
fn matters(elements: &[Element<'_>], mut i: usize) -> bool {
    while let Some(parent) = elements[i].parent {
        if parent == 0 {
            return ["link", "joint", "material"].contains(&elements[i].name);
        }
        i = parent;
    }
    false
}

fn check_attributes(element: &Element<'_>) -> Result<(), (usize, UrdfProblem)> {
    for &(name, attribute, kind, example) in ATTRIBUTES {
        if name != element.name {
            continue;
        }
        match (element.attribute(attribute), example) {
            (Some(found), _) if kind.accepts(found.value) => {}
            (Some(found), _) if matches!(kind, Value::JointType) => {
                let problem = UrdfProblem::UnsupportedJoint(found.value.to_owned());
                return Err((found.offset, problem));
            }
            (Some(found), _) => {
                let problem = UrdfProblem::BadValue {
                    element: name.to_owned(),
                    attribute: attribute.to_owned(),
                    value: found.value.to_owned(),
                    expected: kind.expected(),
                };
                return Err((found.offset, problem));
            }
            (None, Some(example)) => {
                let problem = UrdfProblem::MissingAttribute {
                    element: name.to_owned(),
                    attribute,
                    example,
                };
                return Err((element.offset, problem));
            }
            (None, None) => {}
        }
    }
    Ok(())
}

fn check_children(elements: &[Element<'_>], i: usize) -> Result<(), (usize, UrdfProblem)> {
    let element = &elements[i];
    // The contents of an element follow it directly, in the order of the file.
    let contents = || elements[i + 1..].iter().take_while(|e| e.parent >= Some(i));
    let children = || contents().filter(|e| e.parent == Some(i));
    let missing = |child: &'static str, example: &'static str| {
        let problem = UrdfProblem::MissingChild {
            element: element.name.to_owned(),
            child,
            example,
        };
        Err((element.offset, problem))
    };
    for &(name, child, example) in CHILDREN {
        if name == element.name && !children().any(|e| e.name == child) {
            return missing(child, example);
        }
    }
    let singles = || children().filter(|child| is_single(element.name, child.name));
    for (k, child) in singles().enumerate() {
        if singles().take(k).any(|e| e.name == child.name) {
            let problem = UrdfProblem::RepeatedChild {
                element: element.name.to_owned(),
                child: child.name.to_owned(),
            };
            return Err((child.offset, problem));
        }
    }
    let limited = matches!(
        element.attribute("type").map(|a| a.value),
        Some("revolute" | "prismatic")
    );
    if element.name == "joint" && limited && !children().any(|e| e.name == "limit") {
        return missing(
            "limit",
            "<limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"1\"/>",
        );
    }
    if element.name == "geometry" {
        let Some(shape) = children().next() else {
            return missing("box", "<box size=\"0.1 0.1 0.1\"/>");
        };
        if !["box", "cylinder", "sphere"].contains(&shape.name) {
            let problem = UrdfProblem::UnsupportedShape(shape.name.to_owned());
            return Err((shape.offset, problem));
        }
    }
    Ok(())
}
