//! Where a hand could be, with the base where it is and nothing else moved: one copy of all that does not depend on
//! the pose, for many questions.
//!
//! Whatever is asked, what rules out most poses comes first: the hand alone, wherever its arm may be.

use std::ops::ControlFlow;

use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::touching::TouchingPairs;
use crate::motion::planning::configuration_checker::{
    ConfigurationChecker, PLAN_MARGIN, TOUCH_DEPTH,
};
use crate::motion::planning::planning_group::PlanningGroup;
use crate::motion::planning::pose_goal::{PathSearch, PoseGoalTask, TORSO_STEP};
use crate::robot::Side;
use crate::world::{
    AllowedPairs, CollisionChecker, CollisionHit, InTheWay, RobotConfiguration, SomeLinks, World,
};
use spatial::Pose;

/// By how much less (m) than planned configurations keep clear a hand has to, to be ruled out before inverse
/// kinematics, which places it exactly to far less.
const ROUNDING: f64 = 1e-6;

/// A hand of the robot in one configuration of everything else.
pub struct HandReach<'w> {
    world: &'w World,
    robot: RobotConfiguration,
    side: Side,
    absent: &'w [String],
    links: SomeLinks,
    lone: Option<LoneLinks<'w>>,
    /// The pairs that are close in the configuration.
    near: Option<Vec<CollisionHit>>,
    /// What may be close, by what the mode permits, and for which object.
    touching: Vec<(CollisionMode, Option<String>, TouchingPairs)>,
    /// For the arm alone, and with the torso.
    groups: [Option<Group<'w>>; 2],
}

/// Joints that move, and what tells which of their positions are free.
struct Group<'w> {
    group: PlanningGroup,
    checker: ConfigurationChecker<'w>,
}

/// The links of the hand without its arm.
struct LoneLinks<'w> {
    checker: CollisionChecker<'w>,
    /// Poses of the robot's links in the frame of the tool, and in the map.
    in_tool: Vec<Pose>,
    in_map: Vec<Pose>,
}

impl<'w> HandReach<'w> {
    /// For the robot in a configuration that differs from the world's only in the pose of the base and the joints of
    /// hands, as if some objects that no hand holds were not there.
    pub fn new(
        world: &'w World,
        robot: RobotConfiguration,
        side: Side,
        absent: &'w [String],
    ) -> Self {
        let tree = &world.models().robot;
        let hand = world.models().description.arm(side).gripper.links();
        let links = SomeLinks::new(hand, tree.links().count());
        Self {
            world,
            robot,
            side,
            absent,
            links,
            lone: None,
            near: None,
            touching: Vec::new(),
            groups: [None, None],
        }
    }

    /// Whether the tool could be at each of some poses in the frame of the base, at any height of the torso, while
    /// the robot touches nothing but what the mode there permits, and of objects only the target, if one is named.
    pub fn reaches(&mut self, way: &[(Pose, CollisionMode)], target: Option<&str>) -> bool {
        let is_blocked = way
            .iter()
            .any(|(tool, mode)| self.is_surely_blocked(tool, *mode, target));
        !is_blocked
            && way
                .iter()
                .all(|(tool, mode)| self.reaches_pose(tool, *mode, target))
    }

    /// Whether the hand would touch something at the pose, wherever its arm is.
    pub fn is_surely_blocked(
        &mut self,
        tool: &Pose,
        mode: CollisionMode,
        target: Option<&str>,
    ) -> bool {
        self.touched_at(tool, mode, target).is_some()
    }

    /// What the hand would touch at the pose, wherever its arm is, one of all.
    fn touched_at(
        &mut self,
        tool: &Pose,
        mode: CollisionMode,
        target: Option<&str>,
    ) -> Option<InTheWay<'w>> {
        let arm = self.world.models().description.arm(self.side);
        // Where solutions are searched for, they are less exact.
        if !arm.kinematics.is_closed_form() {
            return None;
        }
        let at = self.touching_at(mode, target);
        let (world, robot, side) = (self.world, &self.robot, self.side);
        let lone = self
            .lone
            .get_or_insert_with(|| LoneLinks::new(world, robot, side, self.absent));
        let tool = robot.base * tool;
        for (in_map, in_tool) in lone.in_map.iter_mut().zip(&lone.in_tool) {
            *in_map = tool * in_tool;
        }
        let relaxed = self.touching[at].2.relaxed();
        let margin = PLAN_MARGIN - ROUNDING;
        lone.checker
            .in_the_way_at(&lone.in_map, &self.links, relaxed, margin)
    }

    fn task(&self, tool: &Pose) -> PoseGoalTask<'w> {
        PoseGoalTask {
            world: self.world,
            goals: vec![(self.side, *tool)],
            contacts: ExpectedContacts::default(),
            search: PathSearch::Long,
            leaves_room: false,
        }
    }

    /// The objects of which one has to be taken away at least for the tool to be at each of the poses, as in
    /// [`Self::reaches`]: if that is possible without a single object, it is one of these. `None` if the tool could be
    /// there already.
    pub fn hindrances(
        &mut self,
        way: &[(Pose, CollisionMode)],
        target: Option<&str>,
    ) -> Option<Vec<&'w str>> {
        let is_other = |found: &InTheWay<'w>| match found {
            InTheWay::Object(name) if Some(*name) != target => Some(*name),
            InTheWay::Object(_) | InTheWay::Fixed => None,
        };
        // What the hand alone touches has to go in any case.
        for (tool, mode) in way {
            if let Some(touched) = self.touched_at(tool, *mode, target) {
                return Some(is_other(&touched).into_iter().collect());
            }
        }
        let mut all: Option<Vec<&'w str>> = None;
        for (tool, mode) in way {
            let Some(met) = self.met_at(tool, *mode, target) else {
                continue;
            };
            let met = met.iter().filter_map(is_other);
            let some: Vec<&str> = match &all {
                Some(all) => met.filter(|name| all.contains(name)).collect(),
                None => met.collect(),
            };
            if some.is_empty() {
                return Some(some);
            }
            all = Some(some);
        }
        all
    }

    /// What is met by the configurations with the tool at the pose, one thing of each; `None` if one is free.
    fn met_at(
        &mut self,
        tool: &Pose,
        mode: CollisionMode,
        target: Option<&str>,
    ) -> Option<Vec<InTheWay<'w>>> {
        let mut met = Vec::new();
        let at = self.touching_at(mode, target);
        let task = self.task(tool);
        for height in task.heights(TORSO_STEP) {
            let moves = usize::from(height != task.torso_now());
            let Group { group, checker } = self.group(&task, height, moves, at);
            let now = group.now(task.world);
            let next = task.visit_configurations(height, &now, |positions| {
                let Some(found) = checker.in_the_way(positions) else {
                    return ControlFlow::Break(());
                };
                if !met.contains(&found) {
                    met.push(found);
                }
                ControlFlow::Continue(())
            });
            if next.is_break() {
                return None;
            }
        }
        Some(met)
    }

    fn reaches_pose(&mut self, tool: &Pose, mode: CollisionMode, target: Option<&str>) -> bool {
        let at = self.touching_at(mode, target);
        let task = self.task(tool);
        let heights = task.heights(TORSO_STEP);
        // The first one is the present one, at which the torso need not move.
        let (now, others) = heights.split_at(1);
        for heights in [now, others] {
            match self.reaches_at(&task, heights, at) {
                Reach::Reaches => return true,
                Reach::HandBlocked => return false,
                Reach::Fails => {}
            }
        }
        false
    }

    /// Tries heights of the torso for which the same joints move.
    fn reaches_at(&mut self, task: &PoseGoalTask<'_>, heights: &[f64], at: usize) -> Reach {
        let Some(first) = heights.first() else {
            return Reach::Fails;
        };
        let moves = usize::from(*first != task.torso_now());
        let links = self.links.clone();
        let Group { group, checker } = self.group(task, *first, moves, at);
        let now = group.now(task.world);
        let (mut is_new, mut reach) = (true, Reach::Fails);
        for height in heights {
            let next = task.visit_configurations(*height, &now, |positions| {
                if is_new && checker.touches_surroundings(positions, &links) {
                    reach = Reach::HandBlocked;
                    return ControlFlow::Break(());
                }
                is_new = false;
                if checker.is_free(positions) {
                    reach = Reach::Reaches;
                    return ControlFlow::Break(());
                }
                ControlFlow::Continue(())
            });
            if next.is_break() {
                break;
            }
        }
        reach
    }

    /// The joints for which the torso moves or not, with what may be close.
    fn group(
        &mut self,
        task: &PoseGoalTask<'_>,
        height: f64,
        moves: usize,
        at: usize,
    ) -> &mut Group<'w> {
        let touching = &self.touching[at].2;
        let group = self.groups[moves].get_or_insert_with(|| {
            let group = task.group(height);
            let joints = group.joints.clone();
            let checker = self.world.collision_checker().without(self.absent);
            let robot = self.robot.clone();
            let checker = ConfigurationChecker::with(checker, robot, joints, touching.clone());
            Group { group, checker }
        });
        group.checker.set_touching(&self.robot, touching);
        group
    }

    /// The place in the list of what may be close.
    fn touching_at(&mut self, mode: CollisionMode, target: Option<&str>) -> usize {
        let target = target.filter(|_| mode != CollisionMode::AvoidAll);
        let mut known = self.touching.iter();
        let place = known.position(|(m, object, _)| *m == mode && object.as_deref() == target);
        if let Some(at) = place {
            return at;
        }
        let near = self.near.get_or_insert_with(|| {
            let mut checker = self.world.collision_checker().without(self.absent);
            checker.all_hits(&self.robot, &AllowedPairs::none(), PLAN_MARGIN)
        });
        let contacts = ExpectedContacts::of(self.world, [self.side].into_iter(), mode, target);
        let is_allowed = |hit: &CollisionHit| {
            let mut allowed = contacts.allowed.iter();
            allowed.any(|(a, b)| {
                (*a == hit.moving && *b == hit.other) || (*a == hit.other && *b == hit.moving)
            })
        };
        let near: Vec<CollisionHit> = near
            .iter()
            .filter(|hit| !is_allowed(hit))
            .cloned()
            .collect();
        let touching = TouchingPairs::of_hits(near, &contacts, TOUCH_DEPTH, |_| true);
        let target = target.map(str::to_owned);
        self.touching.push((mode, target, touching));
        self.touching.len() - 1
    }
}

impl<'w> LoneLinks<'w> {
    fn new(world: &'w World, robot: &RobotConfiguration, side: Side, absent: &[String]) -> Self {
        let models = world.models();
        let arm = models.description.arm(side);
        let mut in_tool = Vec::new();
        models
            .robot
            .forward_kinematics(&Pose::identity(), &robot.joints, &mut in_tool);
        let wrist = in_tool.get(arm.wrist.index()).copied().unwrap_or_default();
        let tool = arm.tool_for_wrist(&wrist).inverse();
        for pose in &mut in_tool {
            *pose = tool * *pose;
        }
        Self {
            checker: world.collision_checker().without(absent),
            in_map: in_tool.clone(),
            in_tool,
        }
    }
}

/// How a try to reach a pose ends.
enum Reach {
    Reaches,
    /// The hand touches something at the pose, whatever torso and arm do.
    HandBlocked,
    /// No posture is free.
    Fails,
}
