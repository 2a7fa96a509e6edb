//! Links connected by joints: the robot's body, or the furniture with its drawers and doors.
//!
//! A tree has exactly one root, every other link has exactly one parent joint, and every
//! link and frame of the URDF is kept, including those without geometry or mass. A tree
//! never changes after it has been read; its joint positions are a separate
//! [`JointPositions`].

use nalgebra::{Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use serde::Serialize;

use super::ids::{JointId, LinkId};
use super::joint_positions::JointPositions;
use super::mounted_frame::MountedFrame;
use spatial::{PlacedShape, Pose, trig};

/// A rigid part, or a mere frame when it has neither shapes nor mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    /// Name, unique in the tree.
    pub name: String,
    /// The joint that carries the link; `None` for the root.
    pub(crate) parent_joint: Option<JointId>,
    /// The joints that the link carries, in the order of the file.
    pub(crate) children: Vec<JointId>,
    /// Collision geometry, in the link's frame.
    pub collisions: Vec<PlacedShape>,
    /// Visual geometry, in the link's frame.
    pub visuals: Vec<PlacedShape>,
    /// Mass (kg), 0 for a mere frame.
    pub mass: f64,
}

/// How a joint lets its child move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JointKind {
    /// Not at all.
    Fixed,
    /// Turns about the axis within limits (rad).
    Revolute,
    /// Turns about the axis without limits (rad).
    Continuous,
    /// Slides along the axis within limits (m).
    Prismatic,
}

/// A closed range of joint positions (rad or m), `lower <= upper`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Least position.
    pub lower: f64,
    /// Greatest position.
    pub upper: f64,
}

impl Limits {
    /// Whether the position is in the range.
    pub fn contains(&self, position: f64) -> bool {
        (self.lower..=self.upper).contains(&position)
    }

    /// The position in the range that is nearest to the given one.
    pub fn clamp(&self, position: f64) -> f64 {
        position.max(self.lower).min(self.upper)
    }

    /// How far the position is outside the range; 0 inside.
    pub(crate) fn excess(&self, position: f64) -> f64 {
        (self.lower - position).max(position - self.upper).max(0.0)
    }
}

/// A joint that follows another one: `multiplier * position of the other + offset`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mimic {
    /// The joint that is followed; never itself a follower.
    pub joint: JointId,
    /// Factor on the other joint's position.
    pub multiplier: f64,
    /// Position (rad or m) when the other joint is at 0.
    pub offset: f64,
}

/// What connects two links.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name, unique in the tree.
    pub name: String,
    /// How the child may move.
    pub kind: JointKind,
    /// The link that carries the joint.
    pub parent: LinkId,
    /// The link that the joint carries.
    pub child: LinkId,
    /// Pose of the child in the frame of the parent when the joint is at 0.
    pub origin: Pose,
    /// Axis, in the child's frame, that the joint turns about or slides along.
    pub axis: Unit<Vector3<f64>>,
    /// Range of positions; `None` for fixed and continuous joints.
    pub limits: Option<Limits>,
    /// Narrower range of the safety controller, where the URDF gives one.
    pub(crate) soft_limits: Option<Limits>,
    /// Maximum speed (rad/s or m/s) given by the URDF.
    pub max_velocity: Option<f64>,
    /// Maximum torque (Nm) or force (N) given by the URDF.
    pub(crate) max_effort: Option<f64>,
    /// Set when the joint follows another one.
    pub mimic: Option<Mimic>,
}

impl Joint {
    /// Whether the joint can move on its own: neither fixed nor following another one.
    pub fn is_actuated(&self) -> bool {
        self.kind != JointKind::Fixed && self.mimic.is_none()
    }

    /// Pose of the child in the frame of the parent when the joint is at `position` (rad or m).
    pub(crate) fn pose_at(&self, position: f64) -> Pose {
        match self.kind {
            JointKind::Fixed => self.origin,
            JointKind::Revolute | JointKind::Continuous => {
                let turned = self.origin.rotation * turn(&self.axis, position);
                Pose::from_parts(self.origin.translation, turned)
            }
            JointKind::Prismatic => {
                let shift = self.origin.rotation * (self.axis.into_inner() * position);
                let place = Translation3::from(self.origin.translation.vector + shift);
                Pose::from_parts(place, self.origin.rotation)
            }
        }
    }
}

/// Rotation by `angle` (rad) about a unit axis, the same bits on every platform.
fn turn(axis: &Unit<Vector3<f64>>, angle: f64) -> UnitQuaternion<f64> {
    let (s, c) = trig::sin_cos(angle / 2.0);
    // A unit axis and a point of the unit circle make a unit quaternion.
    UnitQuaternion::new_unchecked(Quaternion::new(c, s * axis.x, s * axis.y, s * axis.z))
}

/// A link as passed to [`KinematicTree::assemble`], which attaches the joints.
pub(super) struct LinkPart {
    pub name: String,
    pub collisions: Vec<PlacedShape>,
    pub visuals: Vec<PlacedShape>,
    pub mass: f64,
}

/// A joint as passed to [`KinematicTree::assemble`]: links and followed joints are indices.
pub(super) struct JointPart {
    pub name: String,
    pub kind: JointKind,
    pub parent: usize,
    pub child: usize,
    pub origin: Pose,
    pub axis: Unit<Vector3<f64>>,
    pub limits: Option<Limits>,
    pub(crate) soft_limits: Option<Limits>,
    pub max_velocity: Option<f64>,
    pub(crate) max_effort: Option<f64>,
    /// Index of the joint that is followed, multiplier, offset.
    pub mimic: Option<(usize, f64, f64)>,
}

/// Links and joints that form one tree.
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicTree {
    name: String,
    links: Vec<Link>,
    joints: Vec<Joint>,
    root: LinkId,
    /// All joints, each after the joint that carries its parent link.
    order: Vec<Placement>,
    /// Names in use for links and joints besides their own.
    aliases: Vec<Alias>,
}

/// Another name of a link or a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Alias {
    /// The name in use.
    pub name: String,
    /// What it stands for.
    pub part: AliasedPart,
}

/// What an alias stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AliasedPart {
    /// A link.
    Link(LinkId),
    /// A joint.
    Joint(JointId),
}

/// What places a link: a few words for each, since all are looked at again and again.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Placement {
    joint: JointId,
    parent: LinkId,
    child: LinkId,
    /// The joint whose position counts, which another one may follow; `None` if this one is fixed.
    leader: Option<JointId>,
}

impl KinematicTree {
    /// Name of the robot in the URDF.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The link without a parent.
    pub fn root(&self) -> LinkId {
        self.root
    }

    /// All links in the order of the file.
    pub fn links(&self) -> impl ExactSizeIterator<Item = (LinkId, &Link)> {
        self.links.iter().enumerate().map(|(i, l)| (LinkId(i), l))
    }

    /// All joints in the order of the file.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = (JointId, &Joint)> {
        self.joints.iter().enumerate().map(|(i, j)| (JointId(i), j))
    }

    /// All joints, each after the joints that carry it.
    pub(crate) fn joints_from_root(&self) -> impl Iterator<Item = (JointId, &Joint)> {
        (self.order.iter()).map(|placed| (placed.joint, self.joint(placed.joint)))
    }

    /// The link with that id, which must come from this tree.
    pub fn link(&self, id: LinkId) -> &Link {
        // Ids are only made by a tree for its own links, and links are never removed.
        &self.links[id.0]
    }

    /// The joint with that id, which must come from this tree.
    pub fn joint(&self, id: JointId) -> &Joint {
        // As for links.
        &self.joints[id.0]
    }

    /// The link with that name, or with that alias.
    pub fn link_named(&self, name: &str) -> Option<LinkId> {
        let own = self.links.iter().position(|l| l.name == name).map(LinkId);
        own.or_else(|| match self.alias(name)? {
            AliasedPart::Link(link) => Some(link),
            AliasedPart::Joint(_) => None,
        })
    }

    /// The joint with that name, or with that alias.
    pub fn joint_named(&self, name: &str) -> Option<JointId> {
        let own = self.joints.iter().position(|j| j.name == name).map(JointId);
        own.or_else(|| match self.alias(name)? {
            AliasedPart::Joint(joint) => Some(joint),
            AliasedPart::Link(_) => None,
        })
    }

    fn alias(&self, name: &str) -> Option<AliasedPart> {
        let found = self.aliases.iter().find(|alias| alias.name == name);
        found.map(|alias| alias.part)
    }

    /// The names in use for links and joints besides their own.
    pub fn aliases(&self) -> &[Alias] {
        &self.aliases
    }

    /// Lets links and joints of this tree be found by other names, too.
    pub(crate) fn set_aliases(&mut self, aliases: Vec<Alias>) {
        self.aliases = aliases;
    }

    /// The joints from the link up to the root, nearest first.
    pub fn ancestors(&self, link: LinkId) -> impl Iterator<Item = JointId> {
        let mut next = self.link(link).parent_joint;
        std::iter::from_fn(move || {
            let joint = next?;
            next = self.link(self.joint(joint).parent).parent_joint;
            Some(joint)
        })
    }

    /// Whether `link` is `carrier` or one of its descendants.
    pub fn carries(&self, carrier: LinkId, link: LinkId) -> bool {
        link == carrier
            || self
                .ancestors(link)
                .any(|j| self.joint(j).parent == carrier)
    }

    /// Lets a joint move as another one does, in the other direction if its range is on the other side of 0.
    pub(crate) fn join(&mut self, follower: JointId, leader: JointId) {
        let upper = |joint: JointId| self.joint(joint).limits.map_or(0.0, |limits| limits.upper);
        let is_mirrored = (upper(follower) > 0.0) != (upper(leader) > 0.0);
        if let Some(joint) = self.joints.get_mut(follower.0) {
            joint.mimic = Some(Mimic {
                joint: leader,
                multiplier: if is_mirrored { -1.0 } else { 1.0 },
                offset: 0.0,
            });
        }
        for placed in &mut self.order {
            if placed.joint == follower {
                placed.leader = Some(leader);
            }
        }
    }

    /// Fixes a frame without a body to a link. It comes after all other links.
    pub(crate) fn mount(&mut self, frame: &MountedFrame) {
        let (child, id) = (LinkId(self.links.len()), JointId(self.joints.len()));
        self.links.push(Link {
            name: frame.name.clone(),
            parent_joint: Some(id),
            children: Vec::new(),
            collisions: Vec::new(),
            visuals: Vec::new(),
            mass: 0.0,
        });
        self.joints.push(Joint {
            name: format!("{}_joint", frame.name),
            kind: JointKind::Fixed,
            parent: frame.parent,
            child,
            origin: frame.at,
            axis: Vector3::x_axis(),
            limits: None,
            soft_limits: None,
            max_velocity: None,
            max_effort: None,
            mimic: None,
        });
        if let Some(parent) = self.links.get_mut(frame.parent.0) {
            parent.children.push(id);
        }
        // Its parent has been placed before.
        self.order.push(Placement {
            joint: id,
            parent: frame.parent,
            child,
            leader: None,
        });
    }

    /// Every joint at zero.
    pub fn zero_positions(&self) -> JointPositions {
        JointPositions::zero(self.joints.len())
    }

    /// Position of the joint (rad or m): its own entry, or derived from the joint it follows.
    pub fn position(&self, q: &JointPositions, joint: JointId) -> f64 {
        match self.joint(joint).mimic {
            Some(m) => m.multiplier * q.get(m.joint) + m.offset,
            None => q.get(joint),
        }
    }

    /// Poses of all links, at [`LinkId::index`] in `out`, in the frame in which `root` is given.
    pub fn forward_kinematics(&self, root: &Pose, q: &JointPositions, out: &mut Vec<Pose>) {
        out.clear();
        out.resize(self.links.len(), *root);
        for placed in &self.order {
            out[placed.child.0] = out[placed.parent.0] * self.local_pose(placed, q);
        }
    }

    /// The poses of a link and those that carry it as [`Self::forward_kinematics`] gives them, with the same bits.
    pub(crate) fn place_link(
        &self,
        link: LinkId,
        root: &Pose,
        q: &JointPositions,
        out: &mut [Pose],
    ) {
        let Some(id) = self.link(link).parent_joint else {
            out[link.0] = *root;
            return;
        };
        let joint = self.joint(id);
        self.place_link(joint.parent, root, q, out);
        let local = match joint.kind {
            JointKind::Fixed => joint.origin,
            _ => joint.pose_at(self.position(q, id)),
        };
        out[link.0] = out[joint.parent.0] * local;
    }

    /// As [`Self::forward_kinematics`], with the same bits, if `out` holds the poses for other
    /// positions and the same root: only the links that have moved are placed anew.
    pub(crate) fn update_forward_kinematics(
        &self,
        before: &JointPositions,
        q: &JointPositions,
        out: &mut [Pose],
        moved: &mut Vec<bool>,
    ) {
        moved.clear();
        moved.resize(self.links.len(), false);
        for placed in &self.order {
            let turns = |joint| q.get(joint).to_bits() != before.get(joint).to_bits();
            if moved[placed.parent.0] || placed.leader.is_some_and(turns) {
                moved[placed.child.0] = true;
                out[placed.child.0] = out[placed.parent.0] * self.local_pose(placed, q);
            }
        }
    }

    /// Pose of a link in the frame of its parent.
    fn local_pose(&self, placed: &Placement, q: &JointPositions) -> Pose {
        let joint = self.joint(placed.joint);
        match placed.leader {
            None => joint.origin,
            Some(_) => joint.pose_at(self.position(q, placed.joint)),
        }
    }

    /// Pose of one link, in the frame in which `root` is given.
    pub fn link_pose(&self, link: LinkId, root: &Pose, q: &JointPositions) -> Pose {
        root * self
            .relative_pose(self.root, link, q)
            .unwrap_or_else(Pose::identity)
    }

    /// Pose of `link` in the frame of `base`, or `None` if `link` is not a descendant of `base`.
    pub fn relative_pose(&self, base: LinkId, link: LinkId, q: &JointPositions) -> Option<Pose> {
        let mut pose = Pose::identity();
        let mut at = link;
        while at != base {
            let id = self.link(at).parent_joint?;
            let joint = self.joint(id);
            pose = joint.pose_at(self.position(q, id)) * pose;
            at = joint.parent;
        }
        Some(pose)
    }

    /// Joins the parts, whose indices must form one tree; followers of followers are
    /// made to follow the last joint of the chain directly.
    ///
    /// Fails with the index of a link that is its own ancestor, or of a joint that follows itself.
    pub(super) fn assemble(
        name: String,
        links: Vec<LinkPart>,
        joints: Vec<JointPart>,
        root: usize,
    ) -> Result<Self, AssemblyError> {
        let mut tree = Self {
            name,
            links: links.into_iter().map(Link::from).collect(),
            joints: Vec::with_capacity(joints.len()),
            root: LinkId(root),
            order: Vec::with_capacity(joints.len()),
            aliases: Vec::new(),
        };
        for (i, part) in joints.iter().enumerate() {
            let mimic = follow(&joints, i)?;
            tree.links[part.child].parent_joint = Some(JointId(i));
            tree.links[part.parent].children.push(JointId(i));
            tree.joints.push(Joint {
                name: part.name.clone(),
                kind: part.kind,
                parent: LinkId(part.parent),
                child: LinkId(part.child),
                origin: part.origin,
                axis: part.axis,
                limits: part.limits,
                soft_limits: part.soft_limits,
                max_velocity: part.max_velocity,
                max_effort: part.max_effort,
                mimic,
            });
        }
        tree.sort_joints()?;
        Ok(tree)
    }

    /// Fills `order`, depth first; fails with a link that cannot be reached from the root.
    fn sort_joints(&mut self) -> Result<(), AssemblyError> {
        let mut reached = vec![false; self.links.len()];
        let mut open = vec![self.root];
        while let Some(link) = open.pop() {
            reached[link.0] = true;
            if let Some(id) = self.links[link.0].parent_joint {
                let joint = &self.joints[id.0];
                let followed = joint.mimic.map_or(id, |mimic| mimic.joint);
                self.order.push(Placement {
                    joint: id,
                    parent: joint.parent,
                    child: joint.child,
                    leader: (joint.kind != JointKind::Fixed).then_some(followed),
                });
            }
            let children = self.links[link.0].children.iter().rev();
            open.extend(children.map(|j| self.joints[j.0].child));
        }
        let Some(mut link) = reached.iter().position(|r| !r) else {
            return Ok(());
        };
        // The parents of an unreachable link must lead into a cycle.
        for _ in 0..self.links.len() {
            if let Some(joint) = self.links[link].parent_joint {
                link = self.joints[joint.0].parent.0;
            }
        }
        Err(AssemblyError::LinkHangsOnItself(link))
    }
}

/// Why parts do not form a tree; holds the index of the part.
pub(super) enum AssemblyError {
    LinkHangsOnItself(usize),
    JointFollowsItself(usize),
}

impl From<LinkPart> for Link {
    fn from(part: LinkPart) -> Self {
        Self {
            name: part.name,
            parent_joint: None,
            children: Vec::new(),
            collisions: part.collisions,
            visuals: part.visuals,
            mass: part.mass,
        }
    }
}

/// The joint at the end of the chain of followers that starts at `joint`.
fn follow(joints: &[JointPart], joint: usize) -> Result<Option<Mimic>, AssemblyError> {
    let mut at = joint;
    let (mut multiplier, mut offset) = (1.0, 0.0);
    for _ in 0..=joints.len() {
        match joints[at].mimic {
            Some((next, m, o)) => {
                offset += multiplier * o;
                multiplier *= m;
                at = next;
            }
            None if at == joint => return Ok(None),
            None => {
                return Ok(Some(Mimic {
                    joint: JointId(at),
                    multiplier,
                    offset,
                }));
            }
        }
    }
    Err(AssemblyError::JointFollowsItself(joint))
}
