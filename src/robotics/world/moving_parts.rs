//! Which parts of the robot move relative to each other, and to the world, when something of it
//! moves.
//!
//! The distance of two parts that move together does not change. What is looked for in many
//! configurations that differ in a few joints need not look at such pairs again and again.

use super::robot_configuration::RobotConfiguration;
use crate::robot::{JointId, JointKind, KinematicTree, LinkId};

/// The group of what does not move.
const AT_REST: usize = 0;

/// The links of the robot in groups that move as a whole.
#[derive(Clone, Debug)]
pub struct MovingParts {
    /// The group of each link, at [`LinkId::index`].
    groups: Vec<usize>,
}

impl MovingParts {
    /// When the joints move.
    pub(crate) fn of_joints(tree: &KinematicTree, joints: &[JointId]) -> Self {
        Self::new(tree, false, |joint| {
            let leader = tree.joint(joint).mimic.map(|mimic| mimic.joint);
            joints.contains(&leader.unwrap_or(joint))
        })
    }

    /// When the base moves, and nothing else.
    pub(crate) fn of_base(tree: &KinematicTree) -> Self {
        Self::new(tree, true, |_| false)
    }

    /// When the robot moves from one configuration to another.
    pub fn between(
        tree: &KinematicTree,
        from: &RobotConfiguration,
        to: &RobotConfiguration,
    ) -> Self {
        Self::new(tree, from.base != to.base, |joint| {
            tree.position(&from.joints, joint) != tree.position(&to.joints, joint)
        })
    }

    fn new(tree: &KinematicTree, base_moves: bool, moves: impl Fn(JointId) -> bool) -> Self {
        let mut groups = vec![AT_REST; tree.links().len()];
        let mut count = AT_REST;
        if base_moves {
            count += 1;
            groups.fill(count);
        }
        for (id, joint) in tree.joints_from_root() {
            // Every link has its place in the list.
            let mut group = groups[joint.parent.index()];
            if joint.kind != JointKind::Fixed && moves(id) {
                count += 1;
                group = count;
            }
            groups[joint.child.index()] = group;
        }
        Self { groups }
    }

    /// The group of a link, or of what the link carries.
    fn group(&self, link: LinkId) -> usize {
        self.groups.get(link.index()).copied().unwrap_or(AT_REST)
    }

    /// Whether a link moves in the map frame.
    pub fn moves(&self, link: LinkId) -> bool {
        self.group(link) != AT_REST
    }

    /// Whether any two links may move relative to each other.
    pub(crate) fn any_part(&self) -> bool {
        self.groups.windows(2).any(|pair| pair[0] != pair[1])
    }

    /// Whether two links may move relative to each other.
    pub fn part(&self, one: LinkId, other: LinkId) -> bool {
        self.group(one) != self.group(other)
    }
}

/// Which pairs a query looks at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pairs {
    /// All.
    #[default]
    All,
    /// Those whose distance may change.
    Changing,
    /// Those whose distance does not change.
    Constant,
}
