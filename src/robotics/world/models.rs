//! Everything about a world that never changes: the trees of robot and kitchen, the robot's
//! description and the kinds of objects, with the geometry prepared for queries.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use super::at_rest::{PairsAtRest, pair, pairs_at_rest};
use super::body_name::BodyName;
use super::kitchen_description::KitchenDescription;
use super::link_geometry::TreeGeometry;
use super::link_pairs::LinkPairs;
use super::map_area::MapArea;
use super::object_library::{OBJECTS, ObjectLibrary};
use super::part_key::PartKey;
use super::physics::Surface;
use crate::robot::description::Arm;
use crate::robot::{JointId, KinematicTree, LinkId, RobotDescription, Side, UrdfError, UrdfRemark};
use crate::sexp::DataError;
use descriptions::{KITCHEN_DESCRIPTION, KITCHEN_URDF, PR2_DESCRIPTION, PR2_URDF};
use thiserror::Error;

/// For each joint of the kitchen whose part is behind another one, the joint of that.
type Orders = BTreeMap<JointId, JointId>;

/// The models that worlds are built from; shared by a world and its copies. A clone shares all parts.
#[derive(Clone)]
pub struct Models {
    /// The robot's body.
    pub robot: Arc<KinematicTree>,
    /// The roles of the robot's links and joints.
    pub description: Arc<RobotDescription>,
    /// The furniture.
    pub kitchen: Arc<KinematicTree>,
    /// What the furniture is for.
    pub kitchen_description: Arc<KitchenDescription>,
    /// The kinds of objects that can be spawned.
    pub objects: Arc<ObjectLibrary>,
    /// What was taken leniently in the files of robot and furniture.
    pub remarks: Vec<UrdfRemark>,
    pub(crate) robot_geometry: Arc<TreeGeometry>,
    pub(crate) kitchen_geometry: Arc<TreeGeometry>,
    /// The pairs of furniture that overlap as their file has them, once somebody has asked.
    pairs_at_rest: Arc<OnceLock<PairsAtRest>>,
    /// Which drawers and doors are behind which, once somebody has asked.
    orders: Arc<OnceLock<Orders>>,
    /// The floor that the robot can drive on.
    pub map: MapArea,
    /// Pairs of the robot's solid links that must not touch.
    pub(crate) self_pairs: Arc<LinkPairs>,
    /// The hand that each link of the robot belongs to, if any.
    hand_of: Vec<Option<Side>>,
    /// For each body of the robot in the physics engine, the number of the hand that it is of.
    pub hands: Vec<Option<usize>>,
    /// The relation of each link of the robot to the floor.
    footing: Vec<Footing>,
}

/// The relation of a link to the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Footing {
    /// It rolls on the floor.
    Rolls,
    /// It moves over the floor at its own height.
    Rides,
    /// It may reach for the floor.
    Reaches,
}

/// An error in a file that describes the world.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ModelsError {
    /// In a URDF.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// In a file of s-expressions.
    #[error(transparent)]
    Data(#[from] DataError),
}

impl Models {
    /// The built-in PR2 in the built-in kitchen.
    pub fn pr2_in_kitchen() -> Result<Self, ModelsError> {
        let robot = KinematicTree::from_urdf(PR2_URDF, "pr2.urdf")?;
        let description = RobotDescription::from_sexp(PR2_DESCRIPTION, "pr2.sexp", &robot)?;
        let kitchen = KinematicTree::from_urdf(KITCHEN_URDF, "kitchen.urdf")?;
        let furnishing =
            KitchenDescription::from_sexp(KITCHEN_DESCRIPTION, "kitchen.sexp", &kitchen)?;
        let objects = ObjectLibrary::from_sexp(OBJECTS, "objects.sexp")?;
        Ok(Self::new(robot, description, kitchen, furnishing, objects))
    }

    /// Prepares the models; the descriptions must belong to that robot and that kitchen.
    pub fn new(
        mut robot: KinematicTree,
        description: RobotDescription,
        mut kitchen: KinematicTree,
        kitchen_description: KitchenDescription,
        objects: ObjectLibrary,
    ) -> Self {
        for (follower, leader) in &description.joined {
            robot.join(*follower, *leader);
        }
        for frame in &description.frames {
            robot.mount(frame);
        }
        robot.set_aliases(description.aliases.clone());
        kitchen.set_aliases(kitchen_description.aliases.clone());
        let idle = &description.idle_joints;
        let robot_geometry = TreeGeometry::new(&robot, |joint| idle.contains(&joint));
        let kitchen_geometry = TreeGeometry::new(&kitchen, |_| false);
        let map = MapArea::new(&kitchen, &kitchen_geometry);
        let links = &robot_geometry.solid_links;
        let mut self_pairs = Vec::new();
        for (a, one) in links.iter().enumerate() {
            for (b, two) in links.iter().enumerate().skip(a + 1) {
                if !may_touch(&description, one.link, two.link) {
                    self_pairs.push((a, b));
                }
            }
        }
        let hand_of = |link| {
            let palm = |side: &Side| description.arm(*side).gripper.palm;
            description
                .sides()
                .find(|side| robot.carries(palm(side), link))
        };
        let hand_of = robot.links().map(|(link, _)| hand_of(link)).collect();
        let hands = robot_geometry.groups.iter().map(|group| {
            let is_of = |arm: &&Arm| {
                let palm = arm.gripper.palm;
                let body = robot_geometry.group_of.get(palm.index()).copied();
                let palm_root = body.and_then(|body| robot_geometry.groups.get(body));
                palm_root.is_some_and(|palm| palm.root == group.root)
                    || robot.carries(palm, group.root)
            };
            let arm = description.arms.iter().find(is_of);
            arm.map(|arm| arm.side.index())
        });
        let hands = hands.collect();
        let is_of_arm = |link| {
            let mut arms = description.arms.iter();
            arms.any(|arm| robot.carries(arm.shoulder(&robot), link))
        };
        let footing = |link| {
            if description.wheels.contains(&link) {
                Footing::Rolls
            } else if is_of_arm(link) {
                Footing::Reaches
            } else {
                Footing::Rides
            }
        };
        let footing = robot.links().map(|(link, _)| footing(link)).collect();
        Self {
            robot: Arc::new(robot),
            description: Arc::new(description),
            kitchen: Arc::new(kitchen),
            kitchen_description: Arc::new(kitchen_description),
            objects: Arc::new(objects),
            remarks: Vec::new(),
            robot_geometry: Arc::new(robot_geometry),
            kitchen_geometry: Arc::new(kitchen_geometry),
            pairs_at_rest: Arc::default(),
            orders: Arc::default(),
            map,
            self_pairs: Arc::new(LinkPairs::new(self_pairs)),
            hand_of,
            hands,
            footing,
        }
    }

    /// The same with other kinds of objects.
    #[must_use]
    pub fn with_objects(&self, objects: Arc<ObjectLibrary>) -> Self {
        Self {
            objects,
            ..self.clone()
        }
    }

    /// Another robot in the same kitchen; the description must belong to that robot.
    #[must_use]
    pub fn with_robot(&self, robot: KinematicTree, description: RobotDescription) -> Self {
        let kitchen = (*self.kitchen).clone();
        let (furnishing, objects) = (&self.kitchen_description, &self.objects);
        let new = Self::new(
            robot,
            description,
            kitchen,
            (**furnishing).clone(),
            (**objects).clone(),
        );
        Self {
            kitchen: Arc::clone(&self.kitchen),
            kitchen_description: Arc::clone(furnishing),
            kitchen_geometry: Arc::clone(&self.kitchen_geometry),
            pairs_at_rest: Arc::clone(&self.pairs_at_rest),
            orders: Arc::clone(&self.orders),
            objects: Arc::clone(objects),
            ..new
        }
    }

    /// The same in another kitchen; the description must belong to that.
    #[must_use]
    pub fn with_kitchen(
        &self,
        mut kitchen: KinematicTree,
        kitchen_description: KitchenDescription,
    ) -> Self {
        kitchen.set_aliases(kitchen_description.aliases.clone());
        let geometry = TreeGeometry::new(&kitchen, |_| false);
        Self {
            map: MapArea::new(&kitchen, &geometry),
            kitchen: Arc::new(kitchen),
            kitchen_description: Arc::new(kitchen_description),
            kitchen_geometry: Arc::new(geometry),
            pairs_at_rest: Arc::default(),
            orders: Arc::default(),
            remarks: Vec::new(),
            ..self.clone()
        }
    }

    /// The same in the kitchen of others.
    #[must_use]
    pub fn with_kitchen_of(&self, other: &Self) -> Self {
        Self {
            map: other.map,
            kitchen: Arc::clone(&other.kitchen),
            kitchen_description: Arc::clone(&other.kitchen_description),
            kitchen_geometry: Arc::clone(&other.kitchen_geometry),
            pairs_at_rest: Arc::clone(&other.pairs_at_rest),
            orders: Arc::clone(&other.orders),
            ..self.clone()
        }
    }

    /// Whether two have the same robot.
    pub fn share_robot(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.robot, &other.robot)
    }

    /// Whether two have the same kitchen.
    pub fn share_kitchen(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.kitchen, &other.kitchen)
    }

    /// The name of a link of the robot; the floor for a link of another tree.
    pub fn robot_body(&self, link: LinkId) -> BodyName {
        let name = self.robot_geometry.names.get(link.index());
        name.map_or(BodyName::Floor, |name| BodyName::Robot(name.clone()))
    }

    /// The name of a link of the kitchen; the floor for a link of another tree.
    pub(crate) fn furniture_body(&self, link: LinkId) -> BodyName {
        let name = self.kitchen_geometry.names.get(link.index());
        name.map_or(BodyName::Floor, |name| BodyName::Furniture(name.clone()))
    }

    /// Whether two links of the kitchen overlap by more than `slack` (m) as their file has them, with every
    /// drawer and door shut. The first question decides about the slack.
    pub(super) fn overlap_at_rest(&self, a: PartKey, b: PartKey, slack: f64) -> bool {
        let pairs = self
            .pairs_at_rest
            .get_or_init(|| pairs_at_rest(&self.kitchen, &self.kitchen_geometry, slack));
        pairs.contains(&pair(a, b))
    }

    /// Where it is kept which drawers and doors are behind which.
    pub(crate) fn kept_orders(&self) -> &OnceLock<Orders> {
        &self.orders
    }

    /// Whether both links are part of the same hand.
    pub(crate) fn belong_to_same_hand(&self, a: LinkId, b: LinkId) -> bool {
        match (self.hand_of.get(a.index()), self.hand_of.get(b.index())) {
            (Some(Some(x)), Some(Some(y))) => x == y,
            _ => false,
        }
    }

    /// What the link is to the physics engine: part of a hand, a gripping surface, or neither.
    pub(crate) fn surface_of(&self, link: LinkId) -> Surface {
        let group = |link: LinkId| self.robot_geometry.group_of.get(link.index());
        for arm in &self.description.arms {
            let gripper = &arm.gripper;
            if gripper
                .fingers
                .iter()
                .flatten()
                .any(|finger| *finger == link)
            {
                return Surface::Pad(arm.side.index());
            }
            let hand = self.hand_of.get(link.index()).copied().flatten();
            if hand == Some(arm.side) || group(link) == group(gripper.palm) {
                return Surface::Hand(arm.side.index());
            }
        }
        Surface::Plain
    }

    /// The relation of the part to the floor; held objects may reach for it.
    pub(crate) fn footing(&self, key: PartKey) -> Footing {
        let PartKey::Robot(i) = key else {
            return Footing::Reaches;
        };
        let place = usize::try_from(i).unwrap_or(usize::MAX);
        self.footing.get(place).copied().unwrap_or(Footing::Reaches)
    }
}

/// Whether two links of the robot are never checked against each other.
fn may_touch(description: &RobotDescription, a: LinkId, b: LinkId) -> bool {
    let rolls = |link| description.wheels.contains(&link);
    let together = |group: &Vec<LinkId>| group.contains(&a) && group.contains(&b);
    rolls(a) || rolls(b) || description.touching.iter().any(together)
}
