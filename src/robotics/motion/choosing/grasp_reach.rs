//! Whether a hand could grasp an object with the base at some pose, without moving anything.
//!
//! Cheap tests come first: inverse kinematics for all poses of the hand, then collisions. The
//! answers agree with those of the motions; whether a path leads there is another question.

use std::cell::Cell;

use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::hand::{arm_names, hand_names};
use crate::motion::failure::grasp_obstacle::{GraspObstacle, GraspPart};
use crate::motion::planning::configuration_checker::ConfigurationChecker;
use crate::motion::planning::goal_configurations::CONFIGURATION_STEP;
use crate::robot::description::Arm;
use crate::robot::torso_search::TorsoSearch;
use crate::robot::{ArmPositions, JointId, Side};
use crate::world::{BodyName, CollisionHit, RobotConfiguration, World};
use spatial::Pose;

/// Step (m) between torso heights that are tried.
const HEIGHT_STEP: f64 = 0.06;
/// How long it takes to ask an arm whether it reaches a pose, in tenths of the time in which a posture is checked (10 to
/// 20 µs): one that is solved in closed form, and a numeric one that does, that does not, and that does not at any
/// height of the torso, which is asked with less patience.
const ASKED: u32 = 1;
const ASKED_AND_FOUND: u32 = 10;
const ASKED_IN_VAIN: u32 = 100;
const ASKED_OF_ALL_IN_VAIN: u32 = 50;
/// Open fingers may overlap their object this much (m) where they will grip it.
const TIGHT_FIT: f64 = 0.002;

/// How much is tried before the hand counts as unable to be somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Maximum number of postures of the arm for one pose of the hand, spread evenly.
    postures: usize,
    /// Maximum number of heights of the torso at which collisions are looked for.
    heights: usize,
    /// Maximum number of postures that are checked for collisions for one base pose.
    checks: usize,
}

impl Effort {
    /// For one of many base poses.
    pub const QUICK: Self = Self {
        postures: 6,
        heights: 2,
        checks: 120,
    };
    /// For a base pose where the first postures are in the way of something.
    pub const PATIENT: Self = Self {
        postures: 24,
        heights: usize::MAX,
        checks: 1000,
    };
    /// For where the robot stands.
    pub const THOROUGH: Self = Self {
        postures: usize::MAX,
        heights: usize::MAX,
        checks: 20_000,
    };

    /// Maximum number of postures of the arm for one pose of the hand.
    pub(super) fn most_postures(self) -> usize {
        self.postures
    }

    /// Maximum number of postures that are checked for collisions for one base pose.
    pub(super) fn most_checks(self) -> usize {
        self.checks
    }
}

/// A pose of the hand on its way to an object and off again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Where on the way.
    pub part: GraspPart,
    /// The pose of the tool in the frame of the base.
    pub tool: Pose,
}

/// What the hands may touch for the parts of a grasp, for any base pose.
pub(crate) struct GraspReach<'w> {
    world: &'w World,
    object: Option<&'w str>,
    hands: [Hand<'w>; 2],
    heights: Vec<f64>,
    /// Number of postures that have been checked for collisions.
    postures: Cell<u32>,
    /// How long arms have been asked whether they reach a pose, in tenths of that.
    asked: Cell<u32>,
}

/// One hand.
struct Hand<'w> {
    torso: TorsoSearch<'w>,
    links: Vec<BodyName>,
    /// All links of the arm, those of the hand among them.
    arm: Vec<BodyName>,
    careful: ExpectedContacts,
    touching: ExpectedContacts,
}

impl<'w> GraspReach<'w> {
    /// For an object of the world, if it is about one. The torso stays as it is, unless it may move.
    pub(crate) fn new(world: &'w World, object: Option<&'w str>, torso_moves: bool) -> Self {
        let description = &world.models().description;
        let hands = Side::BOTH.map(|side| {
            let contacts = |mode| ExpectedContacts::of(world, [side].into_iter(), mode, object);
            let models = world.models();
            let joints = &world.robot_configuration().joints;
            Hand {
                torso: description.torso_search(&models.robot, joints, side),
                links: hand_names(world, side),
                arm: arm_names(world, side),
                careful: contacts(CollisionMode::AvoidAll),
                touching: contacts(CollisionMode::AllowHand),
            }
        });
        let torso = &description.torso;
        let now = torso.height(&world.robot_configuration().joints);
        let mut heights = vec![now];
        if torso_moves {
            let count = ((torso.limits.upper - torso.limits.lower) / HEIGHT_STEP).ceil() as u32;
            let others = (0..=count)
                .map(|i| (torso.limits.lower + f64::from(i) * HEIGHT_STEP).min(torso.limits.upper));
            heights.extend(others.filter(|height| (height - now).abs() > 1e-3));
            heights.sort_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs()));
        }
        Self {
            world,
            object,
            hands,
            heights,
            postures: Cell::new(0),
            asked: Cell::new(0),
        }
    }

    /// Number of postures that have been checked for collisions, for all base poses, and of what takes as
    /// long: most of the time goes there.
    pub(crate) fn postures(&self) -> u32 {
        self.postures.get() + self.asked.get() / 10
    }

    /// Counts that an arm was asked whether it reaches a pose: `in_vain` for a numeric one that does not.
    fn count_asked(&self, arm: &Arm, reached: bool, in_vain: u32) {
        let tenths = match (arm.kinematics.is_closed_form(), reached) {
            (true, _) => ASKED,
            (false, true) => ASKED_AND_FOUND,
            (false, false) => in_vain,
        };
        self.asked.set(self.asked.get().saturating_add(tenths));
    }

    /// Names of the links of a hand.
    pub(crate) fn hand_links(&self, side: Side) -> &[BodyName] {
        &self.hands[side.index()].links
    }

    /// As [`Self::with_base_at`], for whoever does not tell what is met: how far bodies overlap is meaningless then.
    pub(crate) fn glancing_from(&self, base: &Pose, effort: Effort) -> GraspReachFrom<'_> {
        GraspReachFrom {
            depths_matter: false,
            ..self.with_base_at(base, effort)
        }
    }

    /// The robot with its base at a pose in the map frame; everything else is as it is.
    pub(crate) fn with_base_at(&self, base: &Pose, effort: Effort) -> GraspReachFrom<'_> {
        let mut robot = self.world.robot_configuration().clone();
        robot.base = *base;
        GraspReachFrom {
            reach: self,
            robot,
            effort,
            depths_matter: true,
            checks: 0,
            checkers: Vec::new(),
        }
    }
}

/// A hand during a check.
#[derive(Clone, Copy, PartialEq)]
struct OpenHand {
    side: Side,
    /// Its opening (m).
    opening: f64,
    /// Whether it may touch the object.
    touches: bool,
}

/// The robot with its base at some pose.
pub(crate) struct GraspReachFrom<'w> {
    reach: &'w GraspReach<'w>,
    robot: RobotConfiguration,
    effort: Effort,
    /// Whether it matters how far bodies overlap, and where.
    depths_matter: bool,
    /// Number of postures that have been checked for collisions.
    checks: usize,
    /// Those that have been needed.
    checkers: Vec<(OpenHand, ConfigurationChecker<'w>)>,
}

impl<'w> GraspReachFrom<'w> {
    /// The height of the torso (m) nearest to the present one at which the arm reaches all
    /// stations, if collisions did not matter.
    pub(crate) fn height(&self, side: Side, stations: &[Station]) -> Result<f64, GraspObstacle> {
        self.height_from(side, stations, 0)
            .map(|(height, _)| height)
    }

    /// The first such height from that index on, and its index.
    fn height_from(
        &self,
        side: Side,
        stations: &[Station],
        first: usize,
    ) -> Result<(f64, usize), GraspObstacle> {
        let mut part = GraspPart::Grasp;
        // Of many base poses, the next one is as good as one at which that is wrong.
        if self.effort == Effort::QUICK && first == 0 {
            let lost = stations.iter().find(|s| !self.may_reach(side, &s.tool));
            if let Some(Station { part, .. }) = lost {
                return Err(GraspObstacle::OutOfReach { part: *part });
            }
        }
        for (i, height) in self.reach.heights.iter().enumerate().skip(first) {
            let lost = stations
                .iter()
                .find(|s| !self.reaches(side, &s.tool, *height));
            match lost {
                None => return Ok((*height, i)),
                Some(station) => part = station.part,
            }
        }
        Err(GraspObstacle::OutOfReach { part })
    }

    /// Whether the arm reaches the pose at that height of the torso (m), if collisions did not
    /// matter.
    pub(crate) fn reaches(&self, side: Side, tool: &Pose, height: f64) -> bool {
        let arm = self.reach.world.models().description.arm(side);
        let reached = arm.kinematics.reaches(&self.wrist(side, tool, height));
        self.reach.count_asked(arm, reached, ASKED_IN_VAIN);
        reached
    }

    /// Whether the arm may reach the pose at some height of the torso; most that it does not reach are ruled out.
    fn may_reach(&self, side: Side, tool: &Pose) -> bool {
        let arm = self.reach.world.models().description.arm(side);
        let torso = &self.reach.hands[side.index()].torso;
        let wrist = arm.wrist_for_tool(tool);
        let heights = &self.reach.heights;
        if !torso.may_reach(&wrist, heights.iter().copied()) {
            return false;
        }
        // One question in place of many.
        let reached = (heights.len() > 1).then(|| torso.any_height_reaches(&wrist));
        let Some(reached) = reached.flatten() else {
            return true;
        };
        self.reach.count_asked(arm, reached, ASKED_OF_ALL_IN_VAIN);
        reached
    }

    /// The pose of the wrist in the frame of the arm's base.
    fn wrist(&self, side: Side, tool: &Pose, height: f64) -> Pose {
        let hand = &self.reach.hands[side.index()];
        let arm = self.reach.world.models().description.arm(side);
        hand.torso.in_arm_base(&arm.wrist_for_tool(tool), height)
    }

    fn postures(&self, side: Side, tool: &Pose, height: f64) -> Vec<ArmPositions> {
        let arm = self.reach.world.models().description.arm(side);
        let wrist = self.wrist(side, tool, height);
        let all = arm.kinematics.solutions(&wrist, CONFIGURATION_STEP);
        let count = all.len().min(self.effort.postures);
        (0..count).map(|i| all[i * all.len() / count]).collect()
    }

    /// Whether the hand, opened as far as given (m), can be at all stations, with the torso at one of
    /// its heights, without touching anything else. The value is the height (m).
    pub(crate) fn check(
        &mut self,
        side: Side,
        opening: f64,
        stations: &[Station],
    ) -> Result<f64, GraspObstacle> {
        let mut first = 0;
        let mut met = None;
        let mut heights = 0;
        loop {
            if heights == self.effort.heights {
                return Err(met.unwrap_or(GraspObstacle::NotTried));
            }
            heights += 1;
            let (height, index) = match self.height_from(side, stations, first) {
                Ok(found) => found,
                Err(lost) => return Err(met.unwrap_or(lost)),
            };
            let mut all = stations.iter();
            match all.try_for_each(|station| self.check_station(side, opening, station, height)) {
                Ok(()) => return Ok(height),
                // Another height does not move the hand.
                Err(Met::Hand(obstacle)) => return Err(obstacle),
                Err(Met::Arm(obstacle)) => met = met.or(Some(obstacle)),
            }
            first = index + 1;
        }
    }

    fn check_station(
        &mut self,
        side: Side,
        opening: f64,
        station: &Station,
        height: f64,
    ) -> Result<(), Met> {
        let object = self.reach.object;
        let hand = &self.reach.hands[side.index()];
        let open = OpenHand {
            side,
            opening,
            touches: station.part != GraspPart::Approach,
        };
        let mut first_hit = None;
        for posture in self.postures(side, &station.tool, height) {
            if self.checks == self.effort.checks {
                return Err(Met::Hand(GraspObstacle::NotTried));
            }
            self.checks += 1;
            self.reach.postures.set(self.reach.postures.get() + 1);
            let lift = self.reach.world.models().description.torso.joint;
            let lift = lift.map(|_| height);
            let positions: Vec<f64> = lift.into_iter().chain(posture).collect();
            let depths_matter = self.depths_matter;
            let checker = self.checker(open);
            let hit = match depths_matter {
                true => checker.blocked(&positions),
                false => checker.touching(&positions),
            };
            let Some(hit) = hit else {
                if station.part != GraspPart::Grasp {
                    return Ok(());
                }
                let is_own = |hit: &CollisionHit| {
                    hit.other.object().is_some_and(|name| Some(name) == object)
                        && hand.links.contains(&hit.moving)
                };
                let mut overlaps = checker.overlaps(&positions, TIGHT_FIT).into_iter();
                return match overlaps.find(is_own) {
                    None => Ok(()),
                    Some(hit) => Err(Met::Hand(GraspObstacle::NoFit { hit: Box::new(hit) })),
                };
            };
            let is_hand = hand.links.contains(&hit.moving);
            let is_robot = matches!(hit.other, BodyName::Robot(_));
            let hit = Box::new(hit);
            if is_hand && !is_robot {
                let part = station.part;
                return Err(Met::Hand(GraspObstacle::Collision { part, hit }));
            }
            first_hit = first_hit.or(Some(hit));
        }
        let part = station.part;
        Err(Met::Arm(match first_hit {
            Some(hit) => GraspObstacle::Collision { part, hit },
            None => GraspObstacle::OutOfReach { part },
        }))
    }

    fn checker(&mut self, open: OpenHand) -> &mut ConfigurationChecker<'w> {
        let known = self.checkers.iter().position(|(hand, _)| *hand == open);
        let place = known.unwrap_or_else(|| {
            let checker = self.new_checker(open);
            self.checkers.push((open, checker));
            self.checkers.len() - 1
        });
        &mut self.checkers[place].1
    }

    fn new_checker(&self, open: OpenHand) -> ConfigurationChecker<'w> {
        let reach = self.reach;
        let hand = &reach.hands[open.side.index()];
        let description = &reach.world.models().description;
        let arm = description.arm(open.side);
        let contacts = if open.touches {
            &hand.touching
        } else {
            &hand.careful
        };
        let joints: Vec<JointId> = (description.torso.joint.into_iter())
            .chain(arm.joints().iter().copied())
            .collect();
        let mut robot = self.robot.clone();
        let fingers = arm.gripper.position_for_opening(open.opening);
        robot.joints.set(arm.gripper.joint, fingers);
        ConfigurationChecker::away_from_start(reach.world, robot, joints, contacts, &hand.arm)
    }
}

/// What is in the way.
enum Met {
    /// Of the hand, whatever the arm does.
    Hand(GraspObstacle),
    /// Of the arm, in the postures that were tried.
    Arm(GraspObstacle),
}
