//! Moving one or both hands to poses.

use super::job::{Job, MotionOutcome, check_finite, numbers_of};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use crate::motion::contact::expected_contacts::{CollisionMode, ExpectedContacts};
use crate::motion::contact::holding::held_objects;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::cartesian_path::tcp_in_base;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::planning::opening_hands::with_room_for_fingers;
use crate::motion::planning::pose_goal::{PathSearch, PoseGoalTask};
use crate::robot::Side;
use crate::world::{AllowedPairs, CollisionHit, World};
use spatial::Pose;
use spatial::pose::{angle_between, distance_between};

/// A hand that ends farther from its goal than this (m, rad) has missed it.
const MISSED: (f64, f64) = (0.001, 0.01);

/// A goal pose of a tool centre point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoseGoal {
    /// In the frame of the robot's base when the motion starts.
    InBase(Pose),
    /// In the map frame.
    InMap(Pose),
}

/// The kind of path that a hand takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TcpPath {
    /// Any path around obstacles.
    Free,
    /// Straight, as for approaching and lifting; any path if there is no straight one.
    Straight,
}

/// Moves one or both hands to poses, with the torso's help if necessary.
pub type MoveTcp = Job<JointMotion<HandGoal>>;

/// Poses of one or both hands.
#[derive(Clone, Debug)]
pub struct HandGoal {
    /// Goals of the left and of the right hand.
    poses: [Option<PoseGoal>; 2],
    path: TcpPath,
    mode: CollisionMode,
    /// Name of the only object that the hands may touch; any if there is none.
    target: Option<String>,
    /// Whether the goals have got the errors of the robot.
    has_erred: bool,
    search: PathSearch,
}

impl MoveTcp {
    /// Moves the left and the right hand to their goals; an arm without a goal stays.
    pub fn new(
        left: Option<PoseGoal>,
        right: Option<PoseGoal>,
        path: TcpPath,
        mode: CollisionMode,
    ) -> Self {
        let goal = HandGoal::new([left, right], path, mode, None);
        Self::begin(JointMotion::to(goal))
    }

    /// The motion with hands that may touch only the target, where they may touch any object.
    #[must_use]
    pub(crate) fn touching_only(mut self, target: Option<String>) -> Self {
        self.activity.goal_mut().target = target;
        self
    }
}

impl HandGoal {
    /// The plan to goals in the frame of the base.
    fn plan_to(
        &self,
        world: &World,
        goals: Vec<(Side, Pose)>,
        plans: u32,
        leaves_room: bool,
    ) -> Result<JointPlan, MotionFailure> {
        let sides = goals.iter().map(|(side, _)| *side);
        let contacts = ExpectedContacts::of(world, sides, self.mode, self.target.as_deref());
        let mut task = PoseGoalTask {
            world,
            goals,
            contacts,
            search: self.search,
            leaves_room,
        };
        if self.path == TcpPath::Straight {
            if let Some(straight) = task.plan_line() {
                return Ok(straight);
            }
            // A hand that approaches straight may touch an object; one on a detour would sweep
            // it away. So the arm first takes another posture, from which the next plan can
            // lead straight, or makes the detour without touching.
            if self.mode == CollisionMode::AllowHand {
                let careful = ExpectedContacts {
                    allowed: AllowedPairs::none(),
                    touching: task.contacts.touching.clone(),
                };
                if plans == 0
                    && let Some(first) = task.plan_to_start_of_line(None, &careful)
                {
                    return Ok(first);
                }
                task.contacts = careful;
            }
        }
        task.plan_free()
    }

    /// Goals of the left and of the right hand, which may touch only the target.
    pub(super) fn new(
        poses: [Option<PoseGoal>; 2],
        path: TcpPath,
        mode: CollisionMode,
        target: Option<String>,
    ) -> Self {
        Self {
            poses,
            path,
            mode,
            target,
            has_erred: false,
            search: PathSearch::Long,
        }
    }

    /// The goals with paths that are searched for as given.
    #[must_use]
    pub(super) fn searching(mut self, search: PathSearch) -> Self {
        self.search = search;
        self
    }
}

impl JointGoal for HandGoal {
    const MODULE: ProcessModule = ProcessModule::Arms;
    const BLOCKED_TIMEOUT: f64 = 0.3;
    const MAX_PLANS: u32 = 4;
    const SEARCHES: bool = true;

    fn what(&self) -> &'static str {
        match self.path {
            TcpPath::Free => "reaching",
            TcpPath::Straight => "moving the hand straight",
        }
    }

    /// Empty hands that approach an object miss it.
    fn err(&mut self, world: &mut World) {
        if self.has_erred || world.noise().is_none() || self.mode == CollisionMode::AvoidAll {
            return;
        }
        self.has_erred = true;
        for (side, goal) in Side::BOTH.into_iter().zip(&mut self.poses) {
            if held_objects(world, side).is_empty()
                && let Some(goal) = goal
            {
                *goal = missed(*goal, side, world);
            }
        }
    }

    fn plan(&mut self, world: &World, plans: u32) -> Result<JointPlan, MotionFailure> {
        let base = world.believed_base();
        let goals = Side::BOTH.into_iter().zip(self.poses);
        let goals: Vec<(Side, Pose)> = goals
            .filter_map(|(side, goal)| Some((side, in_base(goal?, &base))))
            .collect();
        for (_, goal) in &goals {
            check_finite(Self::MODULE, &numbers_of(goal))?;
        }
        with_room_for_fingers(world, |leaves_room| {
            self.plan_to(world, goals.clone(), plans, leaves_room)
        })
    }

    /// Another job may have moved the torso, or the base for a goal in the map frame.
    fn arrived(&mut self, world: &mut World) -> Arrival {
        let base = world.believed_base();
        for (side, goal) in Side::BOTH.into_iter().zip(self.poses) {
            let Some(goal) = goal else { continue };
            let hand = tcp_in_base(world, side);
            let goal = in_base(goal, &base);
            let distance = distance_between(&hand, &goal);
            let angle = angle_between(&hand, &goal);
            let arm = world.models().description.arm(side);
            let tolerance = arm.kinematics.tolerance();
            if distance <= MISSED.0 + tolerance.0 && angle <= MISSED.1 + tolerance.1 {
                continue;
            }
            return Arrival::Missed(MotionFailure::HandGoalMissed {
                side,
                distance,
                angle,
            });
        }
        Arrival::Done(MotionOutcome::Arrived)
    }

    fn blocked(&self, _: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::ArmBlocked { hit: hit.into() }
    }
}

/// Where a hand arrives instead of at the goal.
pub(super) fn missed(goal: PoseGoal, side: Side, world: &mut World) -> PoseGoal {
    let (step, base) = (world.steps(), world.believed_base());
    match world.noise_mut() {
        None => goal,
        Some(noise) => PoseGoal::InBase(noise.of_approach(step, side, &in_base(goal, &base))),
    }
}

/// The goal in the frame of the base, which the robot takes to be at the pose in the map.
pub(super) fn in_base(goal: PoseGoal, base: &Pose) -> Pose {
    match goal {
        PoseGoal::InBase(pose) => pose,
        PoseGoal::InMap(pose) => base.inverse() * pose,
    }
}
