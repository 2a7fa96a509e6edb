//! What the robot's links are for, as far as the world must know.

use crate::robot::{KinematicTree, LinkId};

/// The links of one gripper.
#[derive(Clone, Debug, PartialEq)]
pub struct HandRoles {
    /// The link that held objects are welded to.
    pub palm: LinkId,
    /// The links of the two fingers, tips included: one that closes from the left, then one
    /// that closes from the right.
    pub fingers: [Vec<LinkId>; 2],
}

impl HandRoles {
    /// Palm and fingers.
    pub fn links(&self) -> impl Iterator<Item = LinkId> {
        let [one, two] = &self.fingers;
        std::iter::once(self.palm)
            .chain(one.iter().copied())
            .chain(two.iter().copied())
    }
}

/// What the robot's links are for.
#[derive(Clone, Debug, PartialEq)]
pub struct Roles {
    /// The hands of the left and of the right arm.
    pub hands: [HandRoles; 2],
    /// Links within one set are never judged against each other.
    pub touching: Vec<Vec<LinkId>>,
    /// Links that roll on the floor and are never judged against it or the robot.
    pub wheels: Vec<LinkId>,
    /// Joints that can move but never do.
    pub idle_joints: Vec<String>,
}

impl Roles {
    /// Whether the two links are never judged against each other.
    pub fn may_touch(&self, a: LinkId, b: LinkId) -> bool {
        self.wheels.contains(&a)
            || self.wheels.contains(&b)
            || self
                .touching
                .iter()
                .any(|set| set.contains(&a) && set.contains(&b))
    }

    /// The hand that the link belongs to, if any: palm, fingers and what they are fixed to.
    pub fn hand_of(&self, tree: &KinematicTree, link: LinkId) -> Option<usize> {
        self.hands
            .iter()
            .position(|hand| hand.links().any(|l| l == link) || tree.carries(hand.palm, link))
    }
}
