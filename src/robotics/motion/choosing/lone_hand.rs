//! Whether a hand has room at a pose, and a forearm behind it, whatever the rest of the arm does: what stands
//! around them does not move with the base, so a few queries rule out what thousands of postures would.

use std::cell::OnceCell;
use std::f64::consts::PI;

use super::grasp_reach::Station;
use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::hand::hand_names;
use crate::motion::failure::grasp_obstacle::{GraspObstacle, GraspPart};
use crate::motion::planning::configuration_checker::PLAN_MARGIN;
use crate::robot::{JointId, JointKind, LinkId, Side};
use crate::world::{
    AllowedPairs, BodyName, CollisionChecker, CollisionHit, MovingParts, Pairs, World,
};
use spatial::Pose;

/// In how many steps each of the two joints of the wrist is turned to look for room for the forearm.
const FOREARM_TURNS: u32 = 24;

/// After how many postures in vain it is worth looking for room for the forearm.
const FOREARM_AFTER: u32 = 1500;

/// What has been looked at of the room that there is, wherever the base is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Looked {
    /// Nothing.
    #[default]
    Nowhere,
    /// Room for the hand.
    Hand,
    /// Room for the hand and the forearm.
    Forearm,
}

impl Looked {
    /// What is to be looked at next, after a base pose in vain for which, with those before, a number of
    /// postures has been checked; `None` if nothing is.
    pub(super) fn next(self, postures: u32) -> Option<Self> {
        match self {
            Self::Nowhere => Some(Self::Hand),
            Self::Hand if postures >= FOREARM_AFTER => Some(Self::Forearm),
            Self::Hand | Self::Forearm => None,
        }
    }
}

/// A hand without its arm, opened as far as it is for a grasp.
pub(super) struct LoneHand<'w> {
    world: &'w World,
    side: Side,
    checker: CollisionChecker<'w>,
    links: Vec<BodyName>,
    /// Poses of the robot's links in the frame of the wrist, and in the map for the pose checked last.
    in_wrist: Vec<Pose>,
    in_map: Vec<Pose>,
    /// What it may touch once it has approached its object.
    touching: AllowedPairs,
    opening: f64,
    forearm: OnceCell<Option<Forearm<'w>>>,
}

/// A forearm behind a hand.
struct Forearm<'w> {
    checker: CollisionChecker<'w>,
    /// The links that turn with it, as indices.
    links: Vec<usize>,
    /// Poses of these links in the frame of the wrist, for each way to turn the joints of the wrist.
    in_wrist: Vec<Vec<Pose>>,
}

impl<'w> LoneHand<'w> {
    /// The hand, opened as far as given (m), that is to hold the object or has let it go; `None` if the arm
    /// has no joint that moves it.
    pub(super) fn new(
        world: &'w World,
        side: Side,
        opening: f64,
        object: Option<&str>,
    ) -> Option<Self> {
        let models = world.models();
        let arm = models.description.arm(side);
        let mut joints = world.robot_configuration().joints.clone();
        let fingers = arm.gripper.position_for_opening(opening);
        joints.set(arm.gripper.joint, fingers);
        let mut in_wrist = Vec::new();
        models
            .robot
            .forward_kinematics(&Pose::identity(), &joints, &mut in_wrist);
        let to_wrist = in_wrist.get(arm.wrist.index())?.inverse();
        for pose in &mut in_wrist {
            *pose = to_wrist * *pose;
        }
        let mut checker = world.collision_checker();
        let moving = MovingParts::of_joints(&models.robot, arm.joints().last_chunk::<1>()?);
        checker.expect_once(moving, Pairs::Changing);
        let mode = CollisionMode::AllowHand;
        let contacts = ExpectedContacts::of(world, [side].into_iter(), mode, object);
        Some(Self {
            world,
            side,
            checker,
            links: hand_names(world, side),
            in_map: in_wrist.clone(),
            in_wrist,
            touching: contacts.allowed,
            opening,
            forearm: OnceCell::new(),
        })
    }

    /// What is in the way of the hand, or of the forearm, at one of the stations, whose tools are in the map frame.
    pub(super) fn obstacle(
        &mut self,
        stations: &[Station],
        looked: Looked,
    ) -> Option<GraspObstacle> {
        match looked {
            Looked::Nowhere => None,
            Looked::Hand => self.hand_obstacle(stations),
            Looked::Forearm => self.forearm_obstacle(stations),
        }
    }

    fn hand_obstacle(&mut self, stations: &[Station]) -> Option<GraspObstacle> {
        stations.iter().find_map(|station| {
            let hit = Box::new(self.hit(station)?);
            let part = station.part;
            Some(GraspObstacle::Collision { part, hit })
        })
    }

    fn hit(&mut self, station: &Station) -> Option<CollisionHit> {
        let arm = self.world.models().description.arm(self.side);
        let wrist = arm.wrist_for_tool(&station.tool);
        for (in_map, in_wrist) in self.in_map.iter_mut().zip(&self.in_wrist) {
            *in_map = wrist * *in_wrist;
        }
        let none = AllowedPairs::none();
        let allowed = match station.part {
            GraspPart::Approach => &none,
            GraspPart::Grasp | GraspPart::Lift => &self.touching,
        };
        let hit = self
            .checker
            .first_hit_around(&self.in_map, allowed, PLAN_MARGIN);
        hit.filter(|hit| self.links.contains(&hit.moving))
    }

    /// What is in the way of the forearm at one of the stations, however the wrist is turned, up to the steps
    /// in which that is tried; the gap that planned configurations keep is not asked for.
    fn forearm_obstacle(&mut self, stations: &[Station]) -> Option<GraspObstacle> {
        let (world, side, opening) = (self.world, self.side, self.opening);
        self.forearm
            .get_or_init(|| Forearm::new(world, side, opening));
        let forearm = self.forearm.get_mut()?.as_mut()?;
        let arm = world.models().description.arm(side);
        stations.iter().find_map(|station| {
            let wrist = arm.wrist_for_tool(&station.tool);
            let mut first = None;
            for placed in &forearm.in_wrist {
                for (link, in_wrist) in forearm.links.iter().zip(placed) {
                    self.in_map[*link] = wrist * *in_wrist;
                }
                let hit = forearm
                    .checker
                    .first_hit_around(&self.in_map, &self.touching, 0.0)?;
                first = first.or(Some(hit));
            }
            let part = station.part;
            first.map(|hit| GraspObstacle::Collision {
                part,
                hit: Box::new(hit),
            })
        })
    }
}

impl<'w> Forearm<'w> {
    /// `None` for an arm that has no wrist of two joints that turn.
    fn new(world: &'w World, side: Side, opening: f64) -> Option<Self> {
        let models = world.models();
        let arm = models.description.arm(side);
        let [turned, flex, roll] = arm.joints().last_chunk::<3>()?;
        let limits = arm.kinematics.limits().last_chunk::<2>()?;
        let turns = |joint: &JointId| {
            let kind = models.robot.joint(*joint).kind;
            matches!(kind, JointKind::Revolute | JointKind::Continuous)
        };
        if ![turned, flex, roll].into_iter().all(turns) {
            return None;
        }
        let ranges = limits.map(|limits| limits.map_or([-PI, PI], |l| [l.lower, l.upper]));
        let at = |[from, to]: [f64; 2], i: u32| {
            from + (to - from) * f64::from(i) / f64::from(FOREARM_TURNS)
        };
        let mut joints = world.robot_configuration().joints.clone();
        let fingers = arm.gripper.position_for_opening(opening);
        joints.set(arm.gripper.joint, fingers);
        let moving = MovingParts::of_joints(&models.robot, &[*turned]);
        let links = models.robot.links().map(|(link, _)| link);
        let links = links.filter(|link| moving.moves(*link));
        let links: Vec<usize> = links.map(LinkId::index).collect();
        let mut in_wrist = Vec::new();
        let mut poses = Vec::new();
        for (i, j) in (0..=FOREARM_TURNS).flat_map(|i| (0..=FOREARM_TURNS).map(move |j| (i, j))) {
            joints.set(*flex, at(ranges[0], i));
            joints.set(*roll, at(ranges[1], j));
            models
                .robot
                .forward_kinematics(&Pose::identity(), &joints, &mut poses);
            let to_wrist = poses.get(arm.wrist.index())?.inverse();
            in_wrist.push(links.iter().map(|link| to_wrist * poses[*link]).collect());
        }
        let mut checker = world.collision_checker();
        checker.expect_once(moving, Pairs::Changing);
        Some(Self {
            checker,
            links,
            in_wrist,
        })
    }
}
