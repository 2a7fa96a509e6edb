//! Everything about a world that never changes: the trees of robot and kitchen, the roles
//! of the robot's links and the kinds of objects, with the geometry prepared for queries.

use super::link_geometry::TreeGeometry;
use super::part_key::PartKey;
use super::roles::Roles;
use crate::robot::{KinematicTree, LinkId};

/// The models that worlds are built from; shared by a world and its copies.
pub struct Models {
    /// The robot's body.
    pub robot: KinematicTree,
    /// The furniture.
    pub kitchen: KinematicTree,
    /// What the robot's links are for.
    pub roles: Roles,
    pub(crate) robot_geometry: TreeGeometry,
    pub(crate) kitchen_geometry: TreeGeometry,
    /// Pairs of places in the robot's solid links that must not touch.
    pub(crate) self_pairs: Vec<(usize, usize)>,
    /// For each link of the robot: the hand that it belongs to.
    hand_of: Vec<Option<usize>>,
    /// For each link of the robot: whether it rolls on the floor.
    rolls: Vec<bool>,
}

impl Models {
    /// Prepares the models.
    pub fn new(robot: KinematicTree, kitchen: KinematicTree, roles: Roles) -> Self {
        let robot_geometry =
            TreeGeometry::new(&robot, |joint| roles.idle_joints.iter().any(|j| j == joint));
        let kitchen_geometry = TreeGeometry::new(&kitchen, |_| false);
        let links = &robot_geometry.solid_links;
        let mut self_pairs = Vec::new();
        for (a, one) in links.iter().enumerate() {
            for (b, two) in links.iter().enumerate().skip(a + 1) {
                if !roles.may_touch(one.link, two.link) {
                    self_pairs.push((a, b));
                }
            }
        }
        let hand_of = robot
            .links()
            .map(|(link, _)| roles.hand_of(&robot, link))
            .collect();
        let rolls = robot
            .links()
            .map(|(link, _)| roles.wheels.contains(&link))
            .collect();
        Self {
            robot,
            kitchen,
            roles,
            robot_geometry,
            kitchen_geometry,
            self_pairs,
            hand_of,
            rolls,
        }
    }

    /// Whether both links are part of the same hand.
    pub(crate) fn belong_to_same_hand(&self, a: LinkId, b: LinkId) -> bool {
        match (self.hand_of.get(a.index()), self.hand_of.get(b.index())) {
            (Some(Some(x)), Some(Some(y))) => x == y,
            _ => false,
        }
    }

    /// Whether the part rolls on the floor.
    pub(crate) fn rolls_on_floor(&self, key: PartKey) -> bool {
        match key {
            PartKey::Robot(i) => {
                let place = usize::try_from(i).unwrap_or(usize::MAX);
                self.rolls.get(place).copied().unwrap_or(false)
            }
            _ => false,
        }
    }
}
