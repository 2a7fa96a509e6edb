//! Reading a kinematic tree from a URDF.
//!
//! Errors in the file are reported one at a time, before anything is built. Meshes are
//! not supported: solids are primitives only.

use nalgebra::{Unit, Vector3};
use urdf_rs::{Geometry, JointType};

use super::tree::{AssemblyError, JointPart, LinkPart};
use super::urdf_error::{Place, UrdfError, UrdfProblem};
use super::xml_elements::{Element, elements};
use super::{JointKind, KinematicTree, Limits, urdf_elements, urdf_schema};
use closest_name::closest_name;
use spatial::pose::from_xyz_rpy;
use spatial::{PlacedShape, Pose, Shape};

impl KinematicTree {
    /// Reads the text of a URDF; `file_name` is used only in errors.
    pub fn from_urdf(text: &str, file_name: &str) -> Result<Self, UrdfError> {
        Self::read(text, file_name, urdf_schema::check)
    }

    /// Reads a text that is built in: the tests check what it contains.
    pub fn built_in(text: &str, file_name: &str) -> Result<Self, UrdfError> {
        Self::read(text, file_name, |_| Ok(()))
    }

    fn read(
        text: &str,
        file_name: &str,
        check: fn(&[Element<'_>]) -> Result<(), Wrong>,
    ) -> Result<Self, UrdfError> {
        let place = |(offset, problem): (usize, UrdfProblem)| UrdfError {
            place: Place::at(file_name, text, offset),
            problem: Box::new(problem),
        };
        let elements = elements(text).map_err(place)?;
        check(&elements).map_err(place)?;
        let robot = if urdf_elements::is_plain(text, &elements) {
            urdf_elements::robot(&elements)
        } else {
            urdf_rs::read_from_string(text).map_err(|error| UrdfError {
                place: Place {
                    file: file_name.to_owned(),
                    line_column: None,
                },
                problem: Box::new(UrdfProblem::Other(error.to_string())),
            })?
        };
        let source = Source {
            text,
            links: top_level(&elements, "link"),
            joints: top_level(&elements, "joint"),
        };
        build(&robot, &source).map_err(place)
    }
}

/// Where the links and joints are in the file; both in the order of the file, which
/// `urdf_rs` keeps too.
struct Source<'a> {
    text: &'a str,
    links: Vec<usize>,
    joints: Vec<usize>,
}

impl Source<'_> {
    fn link(&self, i: usize) -> usize {
        self.links.get(i).copied().unwrap_or(0)
    }

    fn joint(&self, i: usize) -> usize {
        self.joints.get(i).copied().unwrap_or(0)
    }

    fn line(&self, offset: usize) -> usize {
        self.text
            .get(..offset)
            .map_or(1, |t| t.matches('\n').count() + 1)
    }
}

/// Offsets of the elements with that name directly under the outermost one.
fn top_level(elements: &[Element<'_>], name: &str) -> Vec<usize> {
    let wanted = elements
        .iter()
        .filter(|e| e.parent == Some(0) && e.name == name);
    wanted.map(|e| e.offset).collect()
}

type Wrong = (usize, UrdfProblem);

fn build(robot: &urdf_rs::Robot, source: &Source<'_>) -> Result<KinematicTree, Wrong> {
    let link_names: Vec<&str> = robot.links.iter().map(|l| l.name.as_str()).collect();
    let joint_names: Vec<&str> = robot.joints.iter().map(|j| j.name.as_str()).collect();
    check_unique("link", &link_names, &source.links, source)?;
    check_unique("joint", &joint_names, &source.joints, source)?;

    let mut joints = Vec::with_capacity(robot.joints.len());
    for (i, joint) in robot.joints.iter().enumerate() {
        let part = joint_part(joint, &link_names, &joint_names)
            .map_err(|problem| (source.joint(i), problem))?;
        joints.push(part);
    }
    let root = find_root(&link_names, &joints, source)?;
    let links = robot.links.iter().map(|l| link_part(l, &robot.materials));
    KinematicTree::assemble(robot.name.clone(), links.collect(), joints, root).map_err(|error| {
        match error {
            AssemblyError::LinkHangsOnItself(i) => {
                let name = link_names.get(i).copied().unwrap_or_default();
                (source.link(i), UrdfProblem::Cycle(name.to_owned()))
            }
            AssemblyError::JointFollowsItself(i) => {
                let name = joint_names.get(i).copied().unwrap_or_default();
                (source.joint(i), UrdfProblem::MimicCycle(name.to_owned()))
            }
        }
    })
}

fn check_unique(
    what: &'static str,
    names: &[&str],
    offsets: &[usize],
    source: &Source<'_>,
) -> Result<(), Wrong> {
    let mut sorted: Vec<(&str, usize)> = names.iter().copied().zip(0..).collect();
    sorted.sort_unstable();
    let twice = sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let Some(pair) = twice.min_by_key(|pair| pair[1].1) else {
        return Ok(());
    };
    let offset = |i: usize| offsets.get(i).copied().unwrap_or(0);
    let problem = UrdfProblem::DuplicateName {
        what,
        name: pair[0].0.to_owned(),
        line: source.line(offset(pair[0].1)),
    };
    Err((offset(pair[1].1), problem))
}

/// The one link that is no joint's child.
fn find_root(names: &[&str], joints: &[JointPart], source: &Source<'_>) -> Result<usize, Wrong> {
    let mut parent: Vec<Option<usize>> = vec![None; names.len()];
    for (i, joint) in joints.iter().enumerate() {
        if let Some(first) = parent[joint.child].replace(i) {
            let problem = UrdfProblem::TwoParents {
                link: names[joint.child].to_owned(),
                first: joints[first].name.clone(),
                second: joint.name.clone(),
            };
            return Err((source.joint(i), problem));
        }
    }
    let mut roots = (0..names.len()).filter(|&i| parent[i].is_none());
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(root),
        (Some(first), Some(second)) => {
            let problem = UrdfProblem::SeveralRoots {
                first: names[first].to_owned(),
                second: names[second].to_owned(),
            };
            Err((source.link(second), problem))
        }
        (None, _) => match names.first() {
            Some(name) => Err((source.link(0), UrdfProblem::Cycle((*name).to_owned()))),
            None => Err((0, UrdfProblem::NoLinks)),
        },
    }
}

fn link_part(link: &urdf_rs::Link, materials: &[urdf_rs::Material]) -> LinkPart {
    let collisions = link.collision.iter();
    let visuals = link.visual.iter();
    LinkPart {
        name: link.name.clone(),
        collisions: collisions
            .filter_map(|c| placed(&c.geometry, &c.origin, None))
            .collect(),
        visuals: visuals
            .filter_map(|v| {
                placed(
                    &v.geometry,
                    &v.origin,
                    color(v.material.as_ref(), materials),
                )
            })
            .collect(),
        mass: link.inertial.mass.value,
    }
}

/// `None` for meshes and capsules, which the schema has already rejected.
fn placed(
    geometry: &Geometry,
    origin: &urdf_rs::Pose,
    color: Option<[f32; 4]>,
) -> Option<PlacedShape> {
    let shape = match geometry {
        Geometry::Box { size } => Shape::Box { size: size.0 },
        Geometry::Cylinder { radius, length } => Shape::Cylinder {
            radius: *radius,
            length: *length,
        },
        Geometry::Sphere { radius } => Shape::Sphere { radius: *radius },
        Geometry::Mesh { .. } | Geometry::Capsule { .. } => return None,
    };
    Some(PlacedShape {
        shape,
        pose: pose(origin),
        color,
    })
}

fn pose(origin: &urdf_rs::Pose) -> Pose {
    from_xyz_rpy(origin.xyz.0, origin.rpy.0)
}

/// The colour of the material itself, or of the robot's material with the same name.
fn color(
    material: Option<&urdf_rs::Material>,
    materials: &[urdf_rs::Material],
) -> Option<[f32; 4]> {
    let material = material?;
    let shared = || {
        materials
            .iter()
            .find(|m| m.name == material.name)?
            .color
            .as_ref()
    };
    let color = material.color.as_ref().or_else(shared)?;
    Some(color.rgba.0.map(|c| c as f32))
}

fn joint_part(
    joint: &urdf_rs::Joint,
    links: &[&str],
    joints: &[&str],
) -> Result<JointPart, UrdfProblem> {
    let find = |role, name: &str, names: &[&str]| {
        let index = names.iter().position(|n| *n == name);
        index.ok_or_else(|| UrdfProblem::UnknownName {
            joint: joint.name.clone(),
            role,
            name: name.to_owned(),
            closest: closest_name(name, names.iter().copied()).map(str::to_owned),
        })
    };
    let parent = find("parent link", &joint.parent.link, links)?;
    let child = find("child link", &joint.child.link, links)?;
    let kind = match joint.joint_type {
        JointType::Fixed => JointKind::Fixed,
        JointType::Revolute => JointKind::Revolute,
        JointType::Continuous => JointKind::Continuous,
        JointType::Prismatic => JointKind::Prismatic,
        JointType::Floating => return Err(UrdfProblem::UnsupportedJoint("floating".to_owned())),
        JointType::Planar => return Err(UrdfProblem::UnsupportedJoint("planar".to_owned())),
        JointType::Spherical => return Err(UrdfProblem::UnsupportedJoint("spherical".to_owned())),
    };
    let axis = Vector3::from(joint.axis.xyz.0);
    let axis = match Unit::try_new(axis, 1e-9) {
        Some(axis) => axis,
        None if kind == JointKind::Fixed => Vector3::x_axis(),
        None => return Err(UrdfProblem::ZeroAxis(joint.name.clone())),
    };
    let limited = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
    let range = |which, lower: f64, upper: f64| {
        if lower <= upper {
            return Ok(Limits { lower, upper });
        }
        Err(UrdfProblem::ReversedLimits {
            joint: joint.name.clone(),
            which,
            lower,
            upper,
        })
    };
    let limits = limited
        .then(|| range("limits", joint.limit.lower, joint.limit.upper))
        .transpose()?;
    // A safety controller without limits reads as 0..0 and limits the speed only.
    let safety = joint
        .safety_controller
        .as_ref()
        .filter(|s| limited && (s.soft_lower_limit != 0.0 || s.soft_upper_limit != 0.0));
    let soft_limits = safety
        .map(|s| range("soft limits", s.soft_lower_limit, s.soft_upper_limit))
        .transpose()?;
    let mimic = match &joint.mimic {
        Some(m) => {
            let master = find("mimicked joint", &m.joint, joints)?;
            Some((master, m.multiplier.unwrap_or(1.0), m.offset.unwrap_or(0.0)))
        }
        None => None,
    };
    Ok(JointPart {
        name: joint.name.clone(),
        kind,
        parent,
        child,
        origin: pose(&joint.origin),
        axis,
        limits,
        soft_limits,
        max_velocity: Some(joint.limit.velocity).filter(|v| *v > 0.0),
        max_effort: Some(joint.limit.effort).filter(|v| *v > 0.0),
        mimic,
    })
}
