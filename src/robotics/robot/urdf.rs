//! Reading a kinematic tree from a URDF.
//!
//! Errors in the file are reported one at a time, before anything is built. What the standard does not
//! allow but leaves no doubt is read, with a remark. Shapes are primitives, or meshes, which the room
//! `mesh` makes convex bodies of.

use nalgebra::{Unit, Vector3};

use super::tree::{AssemblyError, JointPart, LinkPart};
use super::urdf_error::{Place, UrdfError, UrdfProblem};
use super::urdf_node::Node;
use super::urdf_remark::{Leniency, Remarks, UrdfRemark};
use super::urdf_shapes::Shapes;
use super::xml_elements::{Element, elements};
use super::{JointKind, KinematicTree, Limits, urdf_schema};
use crate::mesh::MeshLibrary;
use closest_name::closest_name;

/// What a URDF describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UrdfUse {
    /// A robot.
    Robot,
    /// A kitchen: if nothing in it is solid, what is visible is.
    World,
}

/// A tree that was read from a URDF.
#[derive(Clone, Debug, PartialEq)]
pub struct UrdfReading {
    /// The tree.
    pub tree: KinematicTree,
    /// What was taken leniently, in the order of the file.
    pub remarks: Vec<UrdfRemark>,
}

impl KinematicTree {
    /// Reads the text of a URDF without meshes; `file_name` is used only in errors.
    pub fn from_urdf(text: &str, file_name: &str) -> Result<Self, UrdfError> {
        let reading = Self::read_urdf(text, file_name, &MeshLibrary::none(), UrdfUse::Robot);
        reading.map(|reading| reading.tree)
    }

    /// Reads the text of a URDF, and the meshes that it names; `file_name` is used only in errors.
    ///
    /// # Errors
    ///
    /// The first thing in the file that is wrong, or a mesh of something solid that cannot be had.
    pub fn read_urdf(
        text: &str,
        file_name: &str,
        meshes: &MeshLibrary<'_>,
        usage: UrdfUse,
    ) -> Result<UrdfReading, UrdfError> {
        Self::read(text, file_name, urdf_schema::check, meshes, usage)
    }

    /// Reads a text that is built in: the tests check what it contains.
    pub fn built_in(text: &str, file_name: &str) -> Result<Self, UrdfError> {
        let check = |_: &[Element<'_>], _: &mut Remarks| Ok(());
        let reading = Self::read(text, file_name, check, &MeshLibrary::none(), UrdfUse::Robot);
        reading.map(|reading| reading.tree)
    }

    fn read(
        text: &str,
        file_name: &str,
        check: impl Fn(&[Element<'_>], &mut Remarks) -> Result<(), Wrong>,
        meshes: &MeshLibrary<'_>,
        usage: UrdfUse,
    ) -> Result<UrdfReading, UrdfError> {
        let place = |(offset, problem): Wrong| UrdfError {
            place: Place::at(file_name, text, offset),
            problem: Box::new(problem),
        };
        let mut remarks = Remarks::default();
        if let Some(name) = super::urdf_text::declared(text).filter(|_| !text.is_ascii()) {
            remarks.add(0, Leniency::Encoding(name));
        }
        let elements = elements(text).map_err(place)?;
        check(&elements, &mut remarks).map_err(place)?;
        let root = Node::root(&elements);
        let tree = build(root, text, meshes, usage, &mut remarks).map_err(place)?;
        Ok(UrdfReading {
            tree,
            remarks: remarks.of(file_name, text),
        })
    }
}

/// Byte offset and problem.
pub(super) type Wrong = (usize, UrdfProblem);

/// Links or joints: their names, and where they are in the file.
struct Named<'a> {
    names: Vec<&'a str>,
    offsets: Vec<usize>,
}

impl<'a> Named<'a> {
    fn of(nodes: &[Node<'a>]) -> Self {
        Self {
            names: nodes.iter().map(|node| node.text("name")).collect(),
            offsets: nodes.iter().map(|node| node.offset()).collect(),
        }
    }

    fn name(&self, i: usize) -> String {
        self.names.get(i).copied().unwrap_or_default().to_owned()
    }

    fn offset(&self, i: usize) -> usize {
        self.offsets.get(i).copied().unwrap_or(0)
    }

    /// An error if two have one name.
    fn check_unique(&self, what: &'static str, text: &str) -> Result<(), Wrong> {
        let mut sorted: Vec<(&str, usize)> = self.names.iter().copied().zip(0..).collect();
        sorted.sort_unstable();
        let twice = sorted.windows(2).filter(|pair| pair[0].0 == pair[1].0);
        let Some(pair) = twice.min_by_key(|pair| pair[1].1) else {
            return Ok(());
        };
        let before = text.get(..self.offset(pair[0].1));
        let problem = UrdfProblem::DuplicateName {
            what,
            name: pair[0].0.to_owned(),
            line: before.map_or(1, |text| text.matches('\n').count() + 1),
        };
        Err((self.offset(pair[1].1), problem))
    }
}

fn build(
    robot: Node<'_>,
    text: &str,
    meshes: &MeshLibrary<'_>,
    usage: UrdfUse,
    remarks: &mut Remarks,
) -> Result<KinematicTree, Wrong> {
    let link_nodes: Vec<_> = robot.children("link").collect();
    let joint_nodes: Vec<_> = robot.children("joint").collect();
    let (links, joints) = (Named::of(&link_nodes), Named::of(&joint_nodes));
    links.check_unique("link", text)?;
    joints.check_unique("joint", text)?;

    let mut joint_parts = Vec::with_capacity(joint_nodes.len());
    for node in &joint_nodes {
        let part = joint_part(*node, &links.names, &joints.names);
        joint_parts.push(part.map_err(|problem| (node.offset(), problem))?);
    }
    follow_ranges(&joint_nodes, &mut joint_parts)?;
    let root = find_root(&links, &joints, &joint_parts)?;
    let mut shapes = Shapes::read(robot, &link_nodes, meshes, usage, remarks)?;
    let link_parts = link_nodes.iter().enumerate().map(|(i, node)| {
        let (collisions, visuals) = shapes.take(i);
        let mass = node
            .child("inertial")
            .and_then(|inertial| inertial.child("mass"));
        LinkPart {
            name: node.text("name").to_owned(),
            collisions,
            visuals,
            mass: mass.map_or(0.0, |mass| mass.number_or_zero("value")),
        }
    });
    let name = robot.text("name").to_owned();
    KinematicTree::assemble(name, link_parts.collect(), joint_parts, root).map_err(|error| {
        match error {
            AssemblyError::LinkHangsOnItself(i) => {
                (links.offset(i), UrdfProblem::Cycle(links.name(i)))
            }
            AssemblyError::JointFollowsItself(i) => {
                (joints.offset(i), UrdfProblem::MimicCycle(joints.name(i)))
            }
        }
    })
}

/// The one link that is no joint's child.
fn find_root(links: &Named<'_>, joints: &Named<'_>, parts: &[JointPart]) -> Result<usize, Wrong> {
    let mut parent: Vec<Option<usize>> = vec![None; links.names.len()];
    for (i, joint) in parts.iter().enumerate() {
        if let Some(first) = parent[joint.child].replace(i) {
            let problem = UrdfProblem::TwoParents {
                link: links.name(joint.child),
                first: joints.name(first),
                second: joint.name.clone(),
            };
            return Err((joints.offset(i), problem));
        }
    }
    let mut roots = (0..parent.len()).filter(|&i| parent[i].is_none());
    match (roots.next(), roots.next()) {
        (Some(root), None) => Ok(root),
        (Some(first), Some(second)) => {
            let problem = UrdfProblem::SeveralRoots {
                first: links.name(first),
                second: links.name(second),
            };
            Err((links.offset(second), problem))
        }
        (None, _) => match links.names.first() {
            Some(name) => Err((links.offset(0), UrdfProblem::Cycle((*name).to_owned()))),
            None => Err((0, UrdfProblem::NoLinks)),
        },
    }
}

fn joint_part(joint: Node<'_>, links: &[&str], joints: &[&str]) -> Result<JointPart, UrdfProblem> {
    let joint_name = joint.text("name");
    let find = |role, name: &str, names: &[&str]| {
        let index = names.iter().position(|n| *n == name);
        index.ok_or_else(|| UrdfProblem::UnknownName {
            joint: joint_name.to_owned(),
            role,
            name: name.to_owned(),
            closest: closest_name(name, names.iter().copied()).map(str::to_owned),
        })
    };
    let parent = find("parent link", joint.link_of("parent"), links)?;
    let child = find("child link", joint.link_of("child"), links)?;
    let kind = match joint.text("type") {
        "revolute" => JointKind::Revolute,
        "continuous" => JointKind::Continuous,
        "prismatic" => JointKind::Prismatic,
        // The schema lets nothing else pass.
        _ => JointKind::Fixed,
    };
    let axis = joint
        .child("axis")
        .filter(|axis| axis.value("xyz").is_some());
    let axis = axis.map_or([1.0, 0.0, 0.0], |axis| axis.vector("xyz"));
    let axis = match Unit::try_new(Vector3::from(axis), 1e-9) {
        Some(axis) => axis,
        None if kind == JointKind::Fixed => Vector3::x_axis(),
        None => return Err(UrdfProblem::ZeroAxis(joint_name.to_owned())),
    };
    let limited = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
    let range = |which, lower: f64, upper: f64| {
        if lower <= upper {
            return Ok(Limits { lower, upper });
        }
        Err(UrdfProblem::ReversedLimits {
            joint: joint_name.to_owned(),
            which,
            lower,
            upper,
        })
    };
    let limit = joint.child("limit");
    let limits = limit.map_or([0.0; 2], |limit| {
        ["lower", "upper"].map(|end| limit.number_or_zero(end))
    });
    let limits = limited
        .then(|| range("limits", limits[0], limits[1]))
        .transpose()?;
    // A safety controller without limits reads as 0..0 and limits the speed only.
    let safety = joint.child("safety_controller").map(|safety| {
        ["soft_lower_limit", "soft_upper_limit"].map(|end| safety.number_or_zero(end))
    });
    let soft_limits = safety
        .filter(|ends| limited && ends.iter().any(|end| *end != 0.0))
        .map(|[lower, upper]| range("soft limits", lower, upper))
        .transpose()?;
    let mimic = match joint.child("mimic") {
        Some(mimic) => {
            let master = find("mimicked joint", mimic.text("joint"), joints)?;
            let multiplier = mimic.number("multiplier").unwrap_or(1.0);
            Some((master, multiplier, mimic.number_or_zero("offset")))
        }
        None => None,
    };
    let most = |what| {
        limit
            .and_then(|limit| limit.number(what))
            .filter(|v| *v > 0.0)
    };
    Ok(JointPart {
        name: joint_name.to_owned(),
        kind,
        parent,
        child,
        origin: joint.origin(),
        axis,
        limits,
        soft_limits,
        max_velocity: most("velocity"),
        max_effort: most("effort"),
        mimic,
    })
}

/// Gives joints that follow others, and have no limits of their own, those that follow from the others'.
fn follow_ranges(nodes: &[Node<'_>], parts: &mut [JointPart]) -> Result<(), Wrong> {
    for (i, node) in nodes.iter().enumerate() {
        let has_own = node
            .child("limit")
            .is_some_and(|limit| limit.value("lower").is_some() || limit.value("upper").is_some());
        if has_own || parts[i].limits.is_none() || parts[i].mimic.is_none() {
            continue;
        }
        let (mut at, mut factor, mut offset) = (i, 1.0, 0.0);
        // A circle ends with what it has; it is found later.
        for _ in 0..parts.len() {
            let Some((next, multiplier, shift)) = parts[at].mimic else {
                break;
            };
            offset += factor * shift;
            factor *= multiplier;
            at = next;
        }
        match parts[at].limits {
            Some(Limits { lower, upper }) => {
                let ends = [factor * lower + offset, factor * upper + offset];
                parts[i].limits = Some(Limits {
                    lower: ends[0].min(ends[1]),
                    upper: ends[0].max(ends[1]),
                });
            }
            None if parts[i].kind == JointKind::Revolute => {
                parts[i].kind = JointKind::Continuous;
                parts[i].limits = None;
            }
            None => {
                let problem = UrdfProblem::MissingChild {
                    element: "joint".to_owned(),
                    child: "limit",
                    example: "<limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"1\"/>",
                };
                return Err((node.offset(), problem));
            }
        }
    }
    Ok(())
}
