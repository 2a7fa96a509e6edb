//! Choosing a torso height and arm configurations for goals of the hands, and planning the
//! path there.
//!
//! The present height of the torso comes first, then others, the nearest first. At each
//! height all configurations over the arm's redundant angle are considered; those in collision
//! are left out, the rest are ranked by how far away they are and how much clearance they have.

use nalgebra::Translation3;

use super::cartesian_path::{
    CartesianEnd, CartesianLine, CartesianPath, CartesianTask, tcp_in_base, wrist_in_arm_base,
};
use super::configuration_checker::ConfigurationChecker;
use super::goal_configurations::GoalConfiguration;
use super::joint_path::{JointPathEffort, is_free_between};
use super::joint_plan::JointPlan;
use super::joint_trajectory::{plan_joint_trajectory, smooth};
use super::planning_group::PlanningGroup;
use crate::motion::contact::expected_contacts::ExpectedContacts;
use crate::motion::contact::hand::releasing_opening;
use crate::motion::contact::holding::held_objects;
use crate::motion::contact::level::LevelHands;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::unreachable::{UnreachablePose, UnreachableReason};
use crate::motion::trajectories::axis_group::AxisGroup;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::description::Speed;
use crate::robot::{self, JointId, Limits, RobotDescription, Side};
use crate::world::{CollisionHit, World};
use spatial::Pose;

/// Step (m) between torso heights that are tried.
pub(crate) const TORSO_STEP: f64 = 0.01;
/// Step (m) between torso heights at which a cause of failure is looked for.
pub(crate) const REASON_STEP: f64 = 0.03;
/// How many configurations are ranked by clearance.
const SHORT_LIST: usize = 10;
/// Clearance (m) around the arm beyond which more is not better.
const ROOM: f64 = 0.05;
/// Cost of a configuration without any clearance, in radians of joint motion.
const NO_ROOM_COST: f64 = 2.0;
/// Cost of a configuration in which the hand could not open, in radians of joint motion.
const SHUT_COST: f64 = 4.0;
/// Number of configurations at one height that first get a short search for a level path, how far they are
/// apart in the order of cost, and the random configurations of each.
const SHORT_SEARCHES: usize = 6;
const SPREAD: usize = 3;
const SHORT_SAMPLES: usize = 200;
/// Number of configurations at one height that get a long search for a path.
const LONG_SEARCHES: usize = 2;
/// Random configurations of each search after the first long one.
const AFTER_LONG_SEARCH: usize = 500;
/// Number of final configurations at one height that are tried for a straight line.
const LINE_ENDS: usize = 6;
/// Number of heights at which the search for a path may fail before giving up.
const MAX_HEIGHTS: usize = 4;
/// The same for one of several goals, and the random configurations and checks of each search.
const SHORT_HEIGHTS: usize = 2;
const SHORT_CHOICE: (usize, usize) = (300, 6000);

/// How far (m) before its goal a hand that is to touch something slows down.
const TOUCH_STRETCH: f64 = 0.03;

/// Goals of the hands: tool poses in the frame of the base.
pub(crate) struct PoseGoalTask<'a> {
    pub(crate) world: &'a World,
    pub(crate) goals: Vec<(Side, Pose)>,
    pub(crate) contacts: ExpectedContacts,
    pub(crate) search: PathSearch,
    /// Whether fingers that are opening meanwhile have room on the whole way.
    pub(crate) leaves_room: bool,
}

/// How long a path of the arms is searched for, where a straight one is blocked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathSearch {
    /// To find out which of several goals has a path: most paths that there are, are found soon. The long
    /// search finds the same ones.
    Short,
    /// As for a motion.
    #[default]
    Long,
}

impl PathSearch {
    fn effort(self) -> JointPathEffort {
        let long = JointPathEffort::default();
        match self {
            Self::Long => long,
            Self::Short => JointPathEffort {
                samples: SHORT_CHOICE.0,
                checks: SHORT_CHOICE.1,
                ..long
            },
        }
    }

    /// Number of heights at which a search may fail.
    fn heights(self) -> usize {
        match self {
            Self::Long => MAX_HEIGHTS,
            Self::Short => SHORT_HEIGHTS,
        }
    }
}

impl PoseGoalTask<'_> {
    pub(super) fn body(&self) -> &RobotDescription {
        &self.world.models().description
    }

    fn sides(&self) -> Vec<Side> {
        self.goals.iter().map(|(side, _)| *side).collect()
    }

    pub(crate) fn torso_now(&self) -> f64 {
        let torso = &self.body().torso;
        torso.height(&self.world.robot_configuration().joints)
    }

    fn torso_limits(&self) -> Limits {
        self.body().torso.limits
    }

    /// Heights of the torso (m), the present one first, then the nearest first.
    pub(crate) fn heights(&self, step: f64) -> Vec<f64> {
        let (now, limits) = (self.torso_now(), self.torso_limits());
        let count = ((limits.upper - limits.lower) / step).ceil() as u32;
        let mut others: Vec<f64> = (0..=count)
            .map(|i| (limits.lower + f64::from(i) * step).min(limits.upper))
            .filter(|h| (h - now).abs() > 1e-3)
            .collect();
        others.sort_by(|a, b| (a - now).abs().total_cmp(&(b - now).abs()));
        others.insert(0, now);
        others
    }

    /// The torso is one of the axes only if it has to move.
    pub(crate) fn group(&self, height: f64) -> PlanningGroup {
        PlanningGroup::new(self.world, height != self.torso_now(), &self.sides())
    }

    pub(super) fn wrist(&self, side: Side, tcp: &Pose, height: f64) -> Pose {
        let mut robot = self.world.robot_configuration().clone();
        self.body().torso.set_height(&mut robot.joints, height);
        wrist_in_arm_base(self.world.models(), &robot, self.body().arm(side), tcp)
    }

    /// Tells which configurations are free. What is upright in the hands and will be stays so on the way.
    pub(super) fn checker(
        &self,
        group: &PlanningGroup,
        contacts: &ExpectedContacts,
    ) -> ConfigurationChecker<'_> {
        let level = LevelHands::of(self.world, &group.joints).level_with(&self.goals);
        let checker = ConfigurationChecker::new(self.world, group.joints.clone(), contacts);
        let checker = match self.leaves_room {
            true => checker.beside_opening_fingers(self.world),
            false => checker,
        };
        checker.keeping(level)
    }

    /// The finger joints of the moving hands: wide open, or, if they hold something, as far as they
    /// open to let it go.
    fn open_hands(&self) -> Vec<(JointId, f64)> {
        let open = |side| {
            let gripper = &self.body().arm(side).gripper;
            let fingers = match held_objects(self.world, side).is_empty() {
                true => gripper.limits.upper,
                false => gripper.position_for_opening(releasing_opening(self.world, side)),
            };
            (gripper.joint, fingers)
        };
        self.sides().into_iter().map(open).collect()
    }

    /// The collision-free configurations at the height, the best one first; or else how many
    /// were checked and what one of them touches.
    fn free_configurations(
        &self,
        configurations: Vec<GoalConfiguration>,
        checker: &mut ConfigurationChecker<'_>,
    ) -> Result<Vec<GoalConfiguration>, (usize, Option<CollisionHit>)> {
        let count = configurations.len();
        let mut first_hit = None;
        let mut free = Vec::new();
        let open_hands = self.open_hands();
        for mut configuration in configurations {
            let positions = &configuration.positions;
            if !checker.is_free(positions) {
                // One is told of.
                first_hit = first_hit.or_else(|| checker.blocked(positions));
                continue;
            }
            if !checker.is_free_with(&configuration.positions, &open_hands) {
                configuration.cost += SHUT_COST;
            }
            free.push(configuration);
        }
        if free.is_empty() {
            return Err((count, first_hit));
        }
        free.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        for configuration in free.iter_mut().take(SHORT_LIST) {
            let room = checker.clearance(&configuration.positions, ROOM);
            configuration.cost += NO_ROOM_COST * (1.0 - room.max(0.0) / ROOM);
        }
        let listed = free.len().min(SHORT_LIST);
        free[..listed].sort_by(|a, b| a.cost.total_cmp(&b.cost));
        Ok(free)
    }

    /// A path to the goals, whatever route the hands take.
    pub(crate) fn plan_free(&self) -> Result<JointPlan, MotionFailure> {
        let mut touching: Option<(usize, CollisionHit)> = None;
        let mut last_failure = None;
        let mut searched = 0;
        for height in self.heights(TORSO_STEP) {
            let group = self.group(height);
            let configurations = self.configurations(height, &group);
            if configurations.is_empty() {
                continue;
            }
            let mut checker = self.checker(&group, &self.contacts);
            let free = match self.free_configurations(configurations, &mut checker) {
                Ok(free) => free,
                Err((count, hit)) => {
                    let all = touching.as_ref().map_or(0, |t| t.0) + count;
                    touching = hit.or(touching.map(|t| t.1)).map(|hit| (all, hit));
                    continue;
                }
            };
            match self.plan_to_one_of(&free, &group, &mut checker, searched) {
                Ok(trajectory) => {
                    return Ok(JointPlan::new(
                        group.joints,
                        trajectory,
                        self.contacts.allowed.clone(),
                    ));
                }
                Err(failure @ MotionFailure::ArmStartInCollision { .. }) => return Err(failure),
                Err(failure) => last_failure = Some(failure),
            }
            searched += 1;
            if searched >= self.search.heights() {
                break;
            }
        }
        Err(last_failure.unwrap_or_else(|| self.unreachable(touching)))
    }

    /// Tries straight joint paths to the best configurations, then searches to the very best: a long one first;
    /// where it was in vain, also at another height before, others are rarely worth as much.
    fn plan_to_one_of(
        &self,
        free: &[GoalConfiguration],
        group: &PlanningGroup,
        checker: &mut ConfigurationChecker<'_>,
        searched: usize,
    ) -> Result<Trajectory, MotionFailure> {
        let effort = self.search.effort();
        let now = group.now(self.world);
        for configuration in free.iter().take(SHORT_LIST) {
            let positions = &configuration.positions;
            if is_free_between(&group.axes, &now, positions, effort.resolution, checker) {
                let limits = speeds::limits_of(self.body(), &group.joints);
                let path = [now, configuration.positions.clone()];
                return Ok(Trajectory::new(&path, &limits));
            }
        }
        let mut result = None;
        // Whether a level path leads to a configuration depends much on which one it is.
        let short = JointPathEffort {
            samples: SHORT_SAMPLES.min(effort.samples),
            ..effort
        };
        let short = (!checker.level().is_empty()).then_some(short);
        let short = short.into_iter().flat_map(|short| {
            let some = free.iter().step_by(SPREAD).take(SHORT_SEARCHES);
            some.map(move |configuration| (configuration, short))
        });
        let after = JointPathEffort {
            samples: AFTER_LONG_SEARCH.min(effort.samples),
            ..effort
        };
        let long = free.iter().take(LONG_SEARCHES).enumerate();
        let long = long.map(|(i, one)| match i + searched {
            0 => (one, effort),
            _ => (one, after),
        });
        for (configuration, effort) in short.chain(long) {
            match plan_joint_trajectory(
                self.world,
                group,
                &configuration.positions,
                checker,
                effort,
            ) {
                Ok(trajectory) => return Ok(trajectory),
                Err(failure) => result = Some(failure),
            }
        }
        Err(result.unwrap_or_else(|| self.unreachable(None)))
    }

    pub(super) fn line_task(&self, height: f64, group: &PlanningGroup) -> CartesianTask<'_> {
        CartesianTask {
            models: self.world.models(),
            robot: self.world.robot_configuration().clone(),
            group: group.clone(),
            lines: self
                .goals
                .iter()
                .map(|(side, to)| CartesianLine {
                    side: *side,
                    from: tcp_in_base(self.world, *side),
                    to: *to,
                })
                .collect(),
            torso: (height != self.torso_now()).then_some(height),
        }
    }

    /// Whether empty hands are to touch something.
    fn is_to_touch(&self) -> bool {
        let is_empty = |(side, _): &(Side, Pose)| held_objects(self.world, *side).is_empty();
        self.contacts.allowed.iter().next().is_some() && self.goals.iter().all(is_empty)
    }

    /// A path that moves the tools straight to the goals, if there is one.
    pub(crate) fn plan_line(&self) -> Option<JointPlan> {
        for height in self.heights(REASON_STEP) {
            let group = self.group(height);
            let configurations = self.configurations(height, &group);
            if configurations.is_empty() {
                continue;
            }
            let mut checker = self.checker(&group, &self.contacts);
            let task = self.line_task(height, &group);
            let start = group.now(self.world);
            let ends = configurations
                .iter()
                .take(LINE_ENDS)
                .map(|p| Some(p.positions.as_slice()));
            for end in std::iter::once(None).chain(ends) {
                let (mut path, met) = task.follow(&start, end, Some(&mut checker));
                if matches!(met, CartesianEnd::Complete) {
                    if self.is_to_touch() {
                        let times = speeds::HAND.velocity / speeds::TOUCH_VELOCITY;
                        path.slow_down(TOUCH_STRETCH, times);
                    }
                    let trajectory =
                        self.cartesian_trajectory(&path, &group, speeds::HAND, &mut checker);
                    return Some(JointPlan::new(
                        group.joints,
                        trajectory,
                        self.contacts.allowed.clone(),
                    ));
                }
            }
        }
        None
    }

    /// A path to a configuration from which the tools can move straight to the goals, with the
    /// tools where they are now, or by an offset (m) from the goals, if one is given; on it the
    /// robot touches only what is given.
    pub(crate) fn plan_to_start_of_line(
        &self,
        from: Option<Translation3<f64>>,
        contacts: &ExpectedContacts,
    ) -> Option<JointPlan> {
        let mut searches = 0;
        for height in self.heights(REASON_STEP) {
            let group = self.group(height);
            let configurations = self.configurations(height, &group);
            if configurations.is_empty() {
                continue;
            }
            let mut checker = self.checker(&group, &self.contacts);
            let mut back = self.line_task(height, &group);
            for line in &mut back.lines {
                let start = from.map_or(line.from, |offset| offset * line.to);
                (line.from, line.to) = (line.to, start);
            }
            for end in &configurations {
                if !checker.is_free(&end.positions) {
                    continue;
                }
                let (path, met) = back.follow(&end.positions, None, Some(&mut checker));
                let (CartesianEnd::Complete, Some(start)) = (met, path.points.last()) else {
                    continue;
                };
                let mut checker = self.checker(&group, contacts);
                let effort = self.search.effort();
                if let Ok(trajectory) =
                    plan_joint_trajectory(self.world, &group, start, &mut checker, effort)
                {
                    let allowed = contacts.allowed.clone();
                    return Some(JointPlan::new(group.joints, trajectory, allowed));
                }
                searches += 1;
                if searches >= LONG_SEARCHES {
                    return None;
                }
            }
        }
        None
    }

    /// The path as a trajectory: the distance travelled by the tool is one more axis, with its own
    /// speed limit.
    pub(super) fn cartesian_trajectory(
        &self,
        path: &CartesianPath,
        group: &PlanningGroup,
        speed: Speed,
        checker: &mut ConfigurationChecker<'_>,
    ) -> Trajectory {
        let mut limits = speeds::limits_of(self.body(), &group.joints);
        limits.push(AxisGroup::single(
            group.joints.len(),
            speed.velocity,
            speed.acceleration,
        ));
        let points: Vec<Vec<f64>> = path
            .points
            .iter()
            .zip(&path.lengths)
            .map(|(q, length)| q.iter().copied().chain([*length]).collect())
            .collect();
        smooth(&points, &limits, checker)
    }

    /// Explains why no configuration was found.
    fn unreachable(&self, touching: Option<(usize, CollisionHit)>) -> MotionFailure {
        let limits = self.torso_limits();
        let torso = [limits.lower, limits.upper];
        let now = self.torso_now();
        let tree = &self.world.models().robot;
        let report = |side: Side, tcp: &Pose, reason| {
            let unreachable = UnreachablePose {
                side,
                frame: tree.link(self.body().torso.link).name.clone(),
                wrist: self.wrist(side, tcp, now),
                tool: *tcp,
                torso,
                reason,
            };
            MotionFailure::PoseUnreachable(Box::new(unreachable))
        };
        let mut suitable = Vec::new();
        for (side, tcp) in &self.goals {
            let kinematics = &self.body().arm(*side).kinematics;
            let mut range: Option<[f64; 2]> = None;
            let mut nearest: Option<(robot::Unreachable, f64)> = None;
            let zero = kinematics.joints().iter().map(|_| 0.0).collect();
            for height in self.heights(REASON_STEP) {
                let wrist = self.wrist(*side, tcp, height);
                match kinematics.nearest(&wrist, &zero) {
                    Ok(_) => {
                        let [least, most] = range.unwrap_or([height; 2]);
                        range = Some([least.min(height), most.max(height)]);
                    }
                    Err(reason) => {
                        if nearest
                            .as_ref()
                            .is_none_or(|n| reason.badness() < n.0.badness())
                        {
                            nearest = Some((reason, height));
                        }
                    }
                }
            }
            if let (None, Some((nearest, torso))) = (range, nearest) {
                return report(*side, tcp, UnreachableReason::Arm { nearest, torso });
            }
            suitable.push((*side, range));
        }
        match (touching, self.goals.as_slice()) {
            (Some((configurations, hit)), [(side, tcp), ..]) => report(
                *side,
                tcp,
                UnreachableReason::Collisions {
                    hit,
                    configurations,
                },
            ),
            _ => {
                let of = |wanted| {
                    suitable
                        .iter()
                        .find(|(s, _)| *s == wanted)
                        .and_then(|(_, r)| *r)
                };
                MotionFailure::TorsoConflict {
                    left: of(Side::Left),
                    right: of(Side::Right),
                }
            }
        }
    }
}
