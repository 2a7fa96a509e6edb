//! What a URDF may contain: the attributes and children that each element needs, and
//! the values they may have. Checked before the file is read.
//!
//! Published files break the standard in ways that leave no doubt about what is meant. These are read, and
//! said once for each kind; everything else is an error.

use std::ops::RangeInclusive;

use super::urdf_error::UrdfProblem;
use super::urdf_remark::{Leniency, Remarks};
use super::xml_elements::Element;

/// The kind of value that an attribute may have.
#[derive(Clone, Copy)]
enum Value {
    Text,
    Name,
    JointType,
    Number,
    NotNegative,
    Length,
    Three,
    Position,
    ThreeLengths,
    Color,
    Scale,
}

/// The lengths of shapes, in metres, with which the physics engine can calculate.
const LENGTHS: RangeInclusive<f64> = 1e-6..=1e4;

/// Factors on the coordinates of meshes, without their signs.
const SCALES: RangeInclusive<f64> = 1e-6..=1e6;

impl Value {
    /// Wording for messages.
    fn expected(self) -> &'static str {
        match self {
            Self::Text | Self::Name => "a text that is not empty",
            Self::JointType => "fixed, revolute, continuous or prismatic",
            Self::Number => "one finite number",
            Self::NotNegative => "one finite number that is not negative",
            Self::Length => "one length from 1e-6 to 1e4 (in metres)",
            Self::Three => "three finite numbers separated by blanks",
            Self::Position => "three numbers from -1e4 to 1e4 (in metres), separated by blanks",
            Self::ThreeLengths => "three lengths from 1e-6 to 1e4 (in metres), separated by blanks",
            Self::Color => "four numbers from 0 to 1 (red green blue alpha)",
            Self::Scale => "three numbers other than 0, from -1e6 to 1e6, separated by blanks",
        }
    }

    fn accepts(self, value: &str) -> bool {
        let all = |count: usize, test: fn(f64) -> bool| {
            let good = |word: &str| word.parse().is_ok_and(|n: f64| n.is_finite() && test(n));
            let mut words = value.split_whitespace();
            (0..count).all(|_| words.next().is_some_and(good)) && words.next().is_none()
        };
        match self {
            Self::Text | Self::Name => !value.trim().is_empty(),
            Self::JointType => ["fixed", "revolute", "continuous", "prismatic"].contains(&value),
            Self::Number => all(1, |_| true),
            Self::NotNegative => all(1, |n| n >= 0.0),
            Self::Length => all(1, |n| LENGTHS.contains(&n)),
            Self::Three => all(3, |_| true),
            Self::Position => all(3, |n| n.abs() <= *LENGTHS.end()),
            Self::ThreeLengths => all(3, |n| LENGTHS.contains(&n)),
            Self::Color => all(4, |n| (0.0..=1.0).contains(&n)),
            Self::Scale => all(3, |n| SCALES.contains(&n.abs())),
        }
    }

    /// What is done with a value that is not accepted, if there is no doubt about what is meant.
    fn leniency(self, attribute: &str, value: &str) -> Option<Leniency> {
        let all = |test: fn(f64) -> bool| {
            let good = |word: &str| word.parse().is_ok_and(|n: f64| n.is_finite() && test(n));
            value.split_whitespace().all(good)
        };
        let count = value.split_whitespace().count();
        let no_size = |n: f64| n == 0.0 || LENGTHS.contains(&n);
        match self {
            Self::Name => value.trim().is_empty().then_some(Leniency::UnnamedMaterial),
            Self::NotNegative if count == 1 && all(|_| true) => {
                Some(Leniency::NegativeLimit(format!("{attribute}={value:?}")))
            }
            Self::Length if count == 1 && all(no_size) => Some(Leniency::NoSize(value.to_owned())),
            Self::ThreeLengths if count == 3 && all(no_size) => {
                Some(Leniency::NoSize(value.to_owned()))
            }
            Self::Color if count == 4 && all(|_| true) => Some(Leniency::Color(value.to_owned())),
            Self::Scale if count == 1 && all(|n| SCALES.contains(&n.abs())) => {
                Some(Leniency::OneScale)
            }
            _ => None,
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
    ("axis", "xyz", Value::Three, None),
    ("limit", "lower", Value::Number, None),
    ("limit", "upper", Value::Number, None),
    ("limit", "effort", Value::NotNegative, None),
    ("limit", "velocity", Value::NotNegative, None),
    ("safety_controller", "soft_lower_limit", Value::Number, None),
    ("safety_controller", "soft_upper_limit", Value::Number, None),
    ("safety_controller", "k_position", Value::Number, None),
    ("safety_controller", "k_velocity", Value::Number, None),
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
    ("capsule", "radius", Value::Length, Some("0.1")),
    ("capsule", "length", Value::Length, Some("0.2")),
    (
        "mesh",
        "filename",
        Value::Text,
        Some("package://my_kitchen/meshes/table.stl"),
    ),
    ("mesh", "scale", Value::Scale, None),
    ("material", "name", Value::Name, None),
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

/// Elements whose children may each appear only once. Of several, the last one counts.
const SINGLE_CHILDREN: &[&str] = &[
    "joint",
    "inertial",
    "visual",
    "collision",
    "geometry",
    "material",
];

/// The shapes that a geometry can have.
const SHAPES: &[&str] = &["box", "cylinder", "sphere", "capsule", "mesh"];

/// Whether the element may hold only one such child.
fn is_single(element: &str, child: &str) -> bool {
    SINGLE_CHILDREN.contains(&element) || (element, child) == ("link", "inertial")
}

/// Finds the first element that breaks the rules: its byte offset and what is wrong. What breaks them
/// without harm is noted.
///
/// Only links, joints and materials are checked; other elements of a robot, such as
/// `transmission` and `gazebo`, have no meaning here.
pub(super) fn check(
    elements: &[Element<'_>],
    remarks: &mut Remarks,
) -> Result<(), (usize, UrdfProblem)> {
    let root = match elements.first() {
        None => return Err((0, UrdfProblem::NotARobot("nothing".to_owned()))),
        Some(root) => root,
    };
    if let Some(macros) = elements.iter().position(|e| e.name.starts_with("xacro:")) {
        return Err((elements[macros].offset, UrdfProblem::Xacro));
    }
    if root.name != "robot" {
        let found = format!("<{}>", root.name);
        return Err((root.offset, UrdfProblem::NotARobot(found)));
    }
    if let Some(second) = elements.iter().skip(1).find(|e| e.parent.is_none()) {
        let found = format!("a second one, <{}>", second.name);
        return Err((second.offset, UrdfProblem::NotARobot(found)));
    }
    for (i, element) in elements.iter().enumerate().skip(1) {
        if element.parent == Some(0) && element.name == "loop_joint" {
            remarks.add(element.offset, Leniency::LoopJoint);
        }
        if matters(elements, i) {
            check_attributes(element, remarks)?;
            check_children(elements, i, remarks)?;
        }
    }
    Ok(())
}

/// What an element must be in for its contents to count, by its name: `<origin>` of a sensor in a link,
/// say, does not.
const PLACES: &[(&str, &[&str])] = &[
    ("link", &["robot"]),
    ("joint", &["robot"]),
    ("visual", &["link"]),
    ("collision", &["link"]),
    ("inertial", &["link"]),
    ("origin", &["joint", "visual", "collision", "inertial"]),
    ("geometry", &["visual", "collision"]),
    ("box", &["geometry"]),
    ("cylinder", &["geometry"]),
    ("sphere", &["geometry"]),
    ("capsule", &["geometry"]),
    ("mesh", &["geometry"]),
    ("material", &["robot", "visual"]),
    ("color", &["material"]),
    ("texture", &["material"]),
    ("mass", &["inertial"]),
    ("inertia", &["inertial"]),
    ("parent", &["joint"]),
    ("child", &["joint"]),
    ("axis", &["joint"]),
    ("limit", &["joint"]),
    ("safety_controller", &["joint"]),
    ("calibration", &["joint"]),
    ("dynamics", &["joint"]),
    ("mimic", &["joint"]),
];

/// Whether the element has a meaning where it is, as part of a link, a joint or a material of the robot.
fn matters(elements: &[Element<'_>], mut i: usize) -> bool {
    while let Some(parent) = elements[i].parent {
        let holders = PLACES.iter().find(|(name, _)| *name == elements[i].name);
        let is_in_place =
            holders.is_some_and(|(_, holders)| holders.contains(&elements[parent].name));
        if !is_in_place {
            return false;
        }
        if parent == 0 {
            return true;
        }
        i = parent;
    }
    false
}

fn check_attributes(
    element: &Element<'_>,
    remarks: &mut Remarks,
) -> Result<(), (usize, UrdfProblem)> {
    let mut values = element.attributes.iter();
    if let Some(expression) = values.find(|a| a.value.contains("${") || a.value.contains("$(")) {
        return Err((expression.offset, UrdfProblem::Xacro));
    }
    for &(name, attribute, kind, example) in ATTRIBUTES {
        if name != element.name {
            continue;
        }
        match (element.attribute(attribute), example) {
            (Some(found), _) if kind.accepts(&found.value) => {}
            (Some(found), _) if matches!(kind, Value::JointType) => {
                let problem = UrdfProblem::UnsupportedJoint(found.value.to_string());
                return Err((found.offset, problem));
            }
            (Some(found), _) => match kind.leniency(attribute, &found.value) {
                Some(leniency) => remarks.add(found.offset, leniency),
                None => {
                    let problem = UrdfProblem::BadValue {
                        element: name.to_owned(),
                        attribute: attribute.to_owned(),
                        value: found.value.to_string(),
                        expected: kind.expected(),
                    };
                    return Err((found.offset, problem));
                }
            },
            (None, Some(example)) => {
                let problem = UrdfProblem::MissingAttribute {
                    element: name.to_owned(),
                    attribute,
                    example,
                };
                return Err((element.offset, problem));
            }
            (None, None) => {
                let leniency = match (name, attribute) {
                    ("axis", "xyz") => Leniency::NoDirection,
                    ("material", "name") => Leniency::UnnamedMaterial,
                    ("limit", "velocity") => Leniency::NoVelocity,
                    _ => continue,
                };
                remarks.add(element.offset, leniency);
            }
        }
    }
    if element.name == "capsule" {
        remarks.add(element.offset, Leniency::Capsule);
    }
    Ok(())
}

fn check_children(
    elements: &[Element<'_>],
    i: usize,
    remarks: &mut Remarks,
) -> Result<(), (usize, UrdfProblem)> {
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
    let mut singles: Vec<_> = children()
        .filter(|child| is_single(element.name, child.name))
        .collect();
    // Of each name, all but the first, in the order of the file.
    singles.sort_by_key(|child| child.name);
    for pair in singles
        .windows(2)
        .filter(|pair| pair[0].name == pair[1].name)
    {
        let second = Leniency::SecondChild {
            element: element.name.to_owned(),
            child: pair[1].name.to_owned(),
        };
        remarks.add(pair[1].offset, second);
    }
    if element.name == "joint" {
        let name = element.attribute("name").map_or("", |name| &name.value);
        let has = |child: &str| children().any(|e| e.name == child);
        let is_limited = matches!(
            element.attribute("type").map(|a| a.value.as_ref()),
            Some("revolute" | "prismatic")
        );
        let limits = children().filter(|e| e.name == "limit").last();
        let has_range =
            |e: &Element<'_>| e.attribute("lower").is_some() || e.attribute("upper").is_some();
        match limits {
            None if is_limited && has("mimic") => {
                remarks.add(element.offset, Leniency::FollowersRange(name.to_owned()));
            }
            None if is_limited => {
                return missing(
                    "limit",
                    "<limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"1\"/>",
                );
            }
            Some(limits) if is_limited && !has_range(limits) => {
                let leniency = match has("mimic") {
                    true => Leniency::FollowersRange(name.to_owned()),
                    false => Leniency::NoRange(name.to_owned()),
                };
                remarks.add(limits.offset, leniency);
            }
            _ => {}
        }
    }
    if element.name == "geometry" {
        let Some(first) = children().next() else {
            return missing("box", "<box size=\"0.1 0.1 0.1\"/>");
        };
        if !children().any(|e| SHAPES.contains(&e.name)) {
            let problem = UrdfProblem::UnsupportedShape(first.name.to_owned());
            return Err((first.offset, problem));
        }
    }
    Ok(())
}
