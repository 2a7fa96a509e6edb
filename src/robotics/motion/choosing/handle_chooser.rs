//! Choosing the arm and the grasp by which a drawer or door can be opened or closed, or a knob turned.
//!
//! A handle is a bar: the fingers close across it, and the hand comes from outside, straight or
//! tilted about the bar. On a knob they close across its axis, turned by some angle about it, just before what it is
//! fixed to. A grasp works if one continuous motion of the arm approaches the bar with
//! open fingers, takes it all the way and withdraws, and the robot touches nothing on it. The
//! motions follow the same points, so that what is found here is what they do.

use std::cell::Cell;

use nalgebra::Point3;

use super::aligned_bases::AlignedBases;
use super::grasp_reach::Effort;
use super::handle_grasps::{HandleGrasp, SHIFTS, handle_grasps};
use super::shoulder::Shoulder;
use crate::motion::failure::no_handle_grasp::{HandleObstacle, NoHandleGrasp};
use crate::motion::planning::goal_configurations::CONFIGURATION_STEP;
use crate::motion::planning::handle_approach::{
    APPROACH_JUMP, approach, away, close_links, obstacle, with_open_hand, withdrawal,
};
use crate::motion::planning::handle_way::{PIVOTS, PartWay, follow_tools};
use crate::motion::planning::way_obstacle::{part_obstacle, robot_obstacle};
use crate::robot::torso_search::TorsoSearch;
use crate::robot::{ArmPositions, JointKind, LinkId, Side};
use crate::world::{AllowedPairs, CollisionHit, MovedPart, Part, RobotConfiguration, World};
use spatial::Pose;

/// Step (m) between torso heights that are tried.
const HEIGHT_STEP: f64 = 0.06;
/// Distance (m or rad) of points of the way for one of many base poses, and by how much more the
/// joints of the arm may change between them.
const COARSE: ((f64, f64), f64) = ((0.03, 0.06), 1.8);
/// At about how many points of a way the arm is asked whether it may get there.
const PROBES: usize = 12;
/// How many postures before the bar are tried first for one of many base poses.
const FIRST_CHECKS: usize = 24;

/// What is to be opened or closed, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct HandleQuestion {
    /// The joint.
    pub part: Part,
    /// The link that has the bar.
    pub handle: LinkId,
    /// The wanted position (rad or m), within the limits of the joint.
    pub position: f64,
    /// The arms, in the order in which they are to be tried.
    pub arms: Vec<Side>,
    /// Names of the grasps to try; all if there are none.
    pub grasps: Vec<String>,
}

/// An arm and a grasp that work.
#[derive(Clone, Debug, PartialEq)]
pub struct HandleChoice {
    /// The arm.
    pub side: Side,
    /// Name of the grasp.
    pub grasp: &'static str,
    /// Height of the torso (m).
    pub torso: f64,
    /// Positions of the arm's joints before the approach.
    pub posture: ArmPositions,
    /// Pose of the tool before the approach, and at the bar, in the map frame.
    pub pregrasp: Pose,
    /// Pose of the tool at the bar, in the map frame.
    pub tool: Pose,
}

/// Tells from which base poses a drawer or door can be opened or closed.
pub struct HandleChooser<'w> {
    world: &'w World,
    question: &'w HandleQuestion,
    way: PartWay<'w>,
    /// Factor of the changes of joints between neighbouring points.
    jump: f64,
    grasps: Vec<HandleGrasp>,
    blocked: Option<(f64, CollisionHit)>,
    hands: Vec<(Side, TorsoSearch<'w>, Shoulder)>,
    /// Links of the robot that are close to each other as it stands, and that nothing here moves apart.
    close: AllowedPairs,
    heights: Vec<f64>,
    effort: Effort,
    /// Number of points along which an arm has been followed, and of postures in which it would begin.
    points: Cell<u32>,
}

impl<'w> HandleChooser<'w> {
    /// For the part in the world as it is.
    pub fn new(world: &'w World, question: &'w HandleQuestion, effort: Effort) -> Self {
        let models = world.models();
        let from = world.kitchen_positions().get(question.part.joint);
        let (step, jump) = match effort == Effort::THOROUGH {
            true => (None, 1.0),
            false => (Some(COARSE.0), COARSE.1),
        };
        let way = PartWay::new(world, &question.part, [from, question.position], step);
        let blocked = part_obstacle(&way).map(|(i, hit)| (way.positions[i], hit));
        let joints = &world.robot_configuration().joints;
        let free = question
            .arms
            .iter()
            .filter(|side| world.handle_hold(**side).is_none());
        let hands = free.map(|side| {
            let torso = models
                .description
                .torso_search(&models.robot, joints, *side);
            (*side, torso, Shoulder::of(world, *side, true))
        });
        let torso = &models.description.torso;
        let now = torso.height(joints);
        let count = ((torso.limits.upper - torso.limits.lower) / HEIGHT_STEP).ceil() as u32;
        let others = (0..=count)
            .map(|i| (torso.limits.lower + f64::from(i) * HEIGHT_STEP).min(torso.limits.upper));
        let mut heights = vec![now];
        heights.extend(others.filter(|height| (height - now).abs() > 1e-3));
        heights.sort_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs()));
        Self {
            world,
            question,
            way,
            jump,
            grasps: handle_grasps(world, question),
            blocked,
            hands: hands.collect(),
            close: close_links(world, &question.arms),
            heights,
            effort,
            points: Cell::new(0),
        }
    }

    /// Number of points along which an arm has been followed, and of postures in which it would begin, for all base
    /// poses: most of the time goes there.
    pub(crate) fn points(&self) -> u32 {
        self.points.get()
    }

    /// What is in the way of the part itself, wherever the robot stands, and at which position of
    /// the joint (rad or m).
    pub fn blocked(&self) -> Option<&(f64, CollisionHit)> {
        self.blocked.as_ref()
    }

    /// Whether the handle may be near enough to the base at a pose in the map frame, at both ends
    /// of its way. Cheap.
    pub fn is_near(&self, base: &Pose) -> bool {
        let mut hands = self.hands.iter();
        hands.any(|(side, _, shoulder)| {
            let arm = self.world.models().description.arm(*side);
            let mut ends = [self.way.parts.first(), self.way.parts.last()]
                .into_iter()
                .flatten();
            ends.all(|part| {
                let handle = part.pose(self.question.handle).translation.vector;
                let point = base.inverse_transform_point(&Point3::from(handle));
                shoulder.reaches(&point.coords, arm.tool_offset + SHIFTS[1])
            })
        })
    }

    /// The base poses near one (map frame) from which the handle may be taken: that one, unless the arms
    /// have to be turned towards it.
    pub fn bases_near(&self, base: &Pose) -> Vec<Pose> {
        let mut aligned = AlignedBases::new(self.world, base);
        for (side, ..) in &self.hands {
            for grasp in &self.grasps {
                if let Some(tool) = self.stations(grasp).get(1) {
                    aligned.add(*side, tool);
                }
            }
        }
        aligned.bases()
    }

    /// The first arm and grasp that work with the base at a pose in the map frame.
    pub fn with_base_at(&self, base: &Pose) -> Result<HandleChoice, NoHandleGrasp> {
        self.within(base, self.effort.most_checks())
    }

    /// As [`Self::with_base_at`], for a base pose that is one of many: where it is good, the first few postures do most
    /// of the time, so that no more are tried, unless with effort.
    pub(crate) fn as_one_of_many(
        &self,
        base: &Pose,
        effort: Effort,
    ) -> Result<HandleChoice, NoHandleGrasp> {
        let all = self.effort.most_checks();
        let checks = match effort == Effort::QUICK {
            true => all.min(FIRST_CHECKS),
            false => all,
        };
        self.within(base, checks)
    }

    /// As [`Self::with_base_at`], with a maximum number of postures.
    fn within(&self, base: &Pose, most_checks: usize) -> Result<HandleChoice, NoHandleGrasp> {
        let kitchen = &self.world.models().kitchen;
        let joint = self.question.part.joint;
        let now = self.world.kitchen_positions().get(joint);
        let mut nothing = NoHandleGrasp {
            handle: kitchen.link(self.question.handle).name.clone(),
            joint: kitchen.joint(joint).name.clone(),
            positions: [now, self.question.position],
            causes: Vec::new(),
        };
        if let Some((_, hit)) = &self.blocked {
            nothing.add(None, HandleObstacle::Part(Box::new(hit.clone())));
            return Err(nothing);
        }
        let mut robot = self.world.robot_configuration().clone();
        robot.base = *base;
        if let Some(hit) = self.standing_in_the_way(&robot) {
            nothing.add(None, HandleObstacle::Base(Box::new(hit)));
            return Err(nothing);
        }
        let mut checks = 0;
        for (side, torso, _) in &self.hands {
            for grasp in &self.grasps {
                let stations = self.stations(grasp);
                for height in &self.heights {
                    let arm = self.world.models().description.arm(*side);
                    let wrist = |tool: &Pose| {
                        let tool = arm.wrist_for_tool(&(base.inverse() * tool));
                        torso.in_arm_base(&tool, *height)
                    };
                    let may_reach = |tool: &Pose| !arm.kinematics.surely_misses(&wrist(tool));
                    if !stations
                        .iter()
                        .all(|tool| arm.kinematics.reaches(&wrist(tool)))
                    {
                        nothing.add(Some(*side), HandleObstacle::OutOfReach);
                        continue;
                    }
                    let torso_of = &self.world.models().description.torso;
                    torso_of.set_height(&mut robot.joints, *height);
                    if checks >= most_checks {
                        nothing.add(Some(*side), HandleObstacle::NotTried);
                        return Err(nothing);
                    }
                    // What is out of reach is so in every posture.
                    let pivots = self.pivots_within_reach(grasp, may_reach);
                    if pivots.is_empty() {
                        nothing.add(Some(*side), HandleObstacle::OutOfReach);
                        continue;
                    }
                    let so_far = (&mut checks, most_checks);
                    match self.postures(*side, torso, grasp, &pivots, &robot, so_far) {
                        Ok(choice) => match self.standing_in_the_way(&robot) {
                            None => return Ok(choice),
                            // With the torso at that height, the arms as they are touch something.
                            Some(hit) => {
                                let obstacle = HandleObstacle::Collision(Box::new(hit));
                                nothing.add(Some(*side), obstacle);
                            }
                        },
                        Err(obstacle) => nothing.add(Some(*side), obstacle),
                    }
                }
            }
        }
        Err(nothing)
    }

    /// What the robot as it stands would touch, with the part at the beginning or end of its way.
    fn standing_in_the_way(&self, robot: &RobotConfiguration) -> Option<CollisionHit> {
        let ends = [self.way.parts.first(), self.way.parts.last()];
        let mut ends = ends.into_iter().flatten();
        ends.find_map(|part| part.checker().first_hit(robot, &self.close, 0.0))
    }

    /// The poses of the tool that must be within reach: before the bar, at it, and at the end.
    fn stations(&self, grasp: &HandleGrasp) -> Vec<Pose> {
        let ends = [self.way.parts.first(), self.way.parts.last()];
        let [Some(first), Some(last)] = ends.map(|part| part.map(|p| p.pose(grasp.grip.handle)))
        else {
            return Vec::new();
        };
        let at = grasp.grip.tool(&first, 0.0);
        let mut stations = vec![at * away(), at];
        if self.pivots().len() == 1 {
            let end = grasp.grip.tool(&last, 0.0);
            stations.extend([end, end * away()]);
        }
        stations
    }

    fn is_knob(&self) -> bool {
        let models = self.world.models();
        models.knob(self.question.handle).is_some()
    }

    fn pivots(&self) -> Vec<f64> {
        let joint = self.world.models().kitchen.joint(self.question.part.joint);
        let opens = self.way.positions.first() < self.way.positions.last();
        let sign = if opens { -1.0 } else { 1.0 };
        match joint.kind {
            JointKind::Prismatic => vec![0.0],
            _ if self.is_knob() => vec![0.0],
            _ => PIVOTS.iter().map(|pivot| sign * pivot).collect(),
        }
    }

    /// The angles about the bar with which the hand may be within reach all the way and after it: the arm is
    /// asked at some points, the last ones first, since most ways lead out of reach.
    fn pivots_within_reach(
        &self,
        grasp: &HandleGrasp,
        may_reach: impl Fn(&Pose) -> bool,
    ) -> Vec<f64> {
        let mut pivots = self.pivots();
        pivots.retain(|pivot| {
            let tools = self.way.tools(&grasp.grip, [0.0, *pivot]);
            let apart = (tools.len() / PROBES).max(1);
            let withdrawn = tools.last().map(|tool| tool * away());
            let mut asked = withdrawn.iter().chain(tools.iter().rev().step_by(apart));
            asked.all(&may_reach)
        });
        pivots
    }

    /// Tries postures of the arm before the bar, with the angles about it that may do.
    fn postures(
        &self,
        side: Side,
        torso: &TorsoSearch<'_>,
        grasp: &HandleGrasp,
        pivots: &[f64],
        robot: &RobotConfiguration,
        (checks, most_checks): (&mut usize, usize),
    ) -> Result<HandleChoice, HandleObstacle> {
        let models = self.world.models();
        let arm = models.description.arm(side);
        let height = models.description.torso.height(&robot.joints);
        let Some(first) = self.way.parts.first() else {
            return Err(HandleObstacle::OutOfReach);
        };
        let tool = grasp.grip.tool(&first.pose(grasp.grip.handle), 0.0);
        let pregrasp = tool * away();
        let wrist = arm.wrist_for_tool(&(robot.base.inverse() * pregrasp));
        let wrist = torso.in_arm_base(&wrist, height);
        let all = arm.kinematics.solutions(&wrist, CONFIGURATION_STEP);
        let count = all.len().min(self.effort.most_postures());
        let mut met = HandleObstacle::OutOfReach;
        let robot = with_open_hand(self.world, robot, side);
        for i in 0..count {
            if *checks >= most_checks {
                break;
            }
            *checks += 1;
            let posture = all[i * all.len() / count];
            match self.whole_way(side, grasp, pivots, &robot, &posture) {
                Ok(()) => {
                    return Ok(HandleChoice {
                        side,
                        grasp: grasp.name,
                        torso: height,
                        posture,
                        pregrasp,
                        tool,
                    });
                }
                Err(HandleObstacle::OutOfReach) => {}
                Err(obstacle) => met = obstacle,
            }
        }
        Err(met)
    }

    /// Whether the arm can approach, take the bar all the way and withdraw, beginning in a posture.
    fn whole_way(
        &self,
        side: Side,
        grasp: &HandleGrasp,
        pivots: &[f64],
        robot: &RobotConfiguration,
        posture: &ArmPositions,
    ) -> Result<(), HandleObstacle> {
        let models = self.world.models();
        let handle = grasp.grip.handle;
        let ends = (self.way.parts.first(), self.way.parts.last());
        let (Some(first), Some(last)) = ends else {
            return Err(HandleObstacle::OutOfReach);
        };
        let follow = |tools: &[Pose], start: &ArmPositions, jump: f64| {
            let points = follow_tools(models, robot, side, tools, start, jump);
            self.points.set(self.points() + points.len() as u32);
            (points.len() == tools.len())
                .then_some(points)
                .ok_or(HandleObstacle::OutOfReach)
        };
        let is_free = |points: &[ArmPositions], part: &MovedPart<'_>| {
            let hit = obstacle(self.world, (robot, side), part, &self.close, points);
            hit.map_or(Ok(()), |hit| Err(HandleObstacle::Collision(Box::new(hit))))
        };
        self.points.set(self.points() + 1);
        is_free(&[*posture], first)?;
        let tool = grasp.grip.tool(&first.pose(handle), 0.0);
        let at_bar = follow(&approach(&tool), posture, APPROACH_JUMP)?;
        is_free(&at_bar, first)?;
        let start = at_bar.last().unwrap_or(posture);
        let mut met = HandleObstacle::OutOfReach;
        for pivot in pivots {
            let tools = self.way.tools(&grasp.grip, [0.0, *pivot]);
            let Ok(points) = follow(&tools, start, self.jump) else {
                continue;
            };
            let own = (side, handle);
            if let Some((_, hit)) = robot_obstacle(self.world, robot, own, &self.way, &points) {
                met = HandleObstacle::Collision(Box::new(hit));
                continue;
            }
            let (Some(end), Some(tool)) = (points.last(), tools.last()) else {
                continue;
            };
            let back = match follow(&withdrawal(tool), end, APPROACH_JUMP) {
                Ok(back) => back,
                Err(_) => continue,
            };
            match is_free(&back, last) {
                Ok(()) => return Ok(()),
                Err(obstacle) => met = obstacle,
            }
        }
        Err(met)
    }
}
