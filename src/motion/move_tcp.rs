//! Bringing one or both hands to poses.

use super::cartesian_path::tcp_in_base;
use super::expected_contacts::{CollisionMode, ExpectedContacts};
use super::failure::MotionFailure;
use super::job::{
    Motion, MotionOutcome, MotionStatus, PlannedTrajectory, ProcessModule, Progress, check_finite,
    numbers_of,
};
use super::joint_follower::{FollowStep, JointFollower};
use super::pose_goal::PoseGoalTask;
use super::replanning::{Attempt, Replanning};
use crate::robot::Side;
use crate::spatial::Pose;
use crate::spatial::pose::{angle_between, distance_between};
use crate::world::{AllowedPairs, World};

/// How long (s) a plan or the way may be blocked while nothing moves.
const BLOCKED_TIMEOUT: f64 = 0.3;
/// A hand that ends farther from its goal than this (m, rad) has missed it.
const MISSED: (f64, f64) = (0.001, 0.01);
/// How often a path is searched before giving up.
const MOST_PLANS: u32 = 4;

/// A pose of a tool centre point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PoseGoal {
    /// In the frame of the robot's base when the motion starts.
    InBase(Pose),
    /// In the map frame.
    InMap(Pose),
}

/// The way that a hand takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TcpPath {
    /// Any way around what is there.
    Free,
    /// Straight, as for approaching and lifting; any way where there is no straight one.
    Straight,
}

/// Moves one or both hands to poses, with the torso's help where that is needed.
#[derive(Clone, Debug)]
pub(crate) struct MoveTcp {
    goals: [Option<PoseGoal>; 2],
    path: TcpPath,
    mode: CollisionMode,
    follow: Option<JointFollower>,
    replanning: Replanning,
    plans: u32,
    ended: bool,
}

impl MoveTcp {
    /// Goals of the left and of the right hand; a hand without one stays with its arm.
    pub(crate) fn new(
        left: Option<PoseGoal>,
        right: Option<PoseGoal>,
        path: TcpPath,
        mode: CollisionMode,
    ) -> Self {
        Self {
            goals: [left, right],
            path,
            mode,
            follow: None,
            replanning: Replanning::default(),
            plans: 0,
            ended: false,
        }
    }

    fn plan(&self, world: &World) -> Result<JointFollower, MotionFailure> {
        let base = world.robot_configuration().base;
        let goals = Side::BOTH.into_iter().zip(self.goals);
        let goals: Vec<(Side, Pose)> = goals
            .filter_map(|(side, goal)| Some((side, in_base(goal?, &base))))
            .collect();
        for (_, goal) in &goals {
            check_finite(ProcessModule::Arms, &numbers_of(goal))?;
        }
        let sides = goals.iter().map(|(side, _)| *side);
        let contacts = ExpectedContacts::of(world, sides, self.mode);
        let mut task = PoseGoalTask {
            world,
            goals,
            contacts,
        };
        if self.path == TcpPath::Straight {
            if let Some(straight) = task.plan_line() {
                return Ok(straight);
            }
            // A hand that comes straight may touch an object; one that goes around would
            // sweep it away. So it takes another posture first, from which it can go
            // straight in the next plan, or goes around without touching.
            if self.mode == CollisionMode::AllowHand {
                let careful = ExpectedContacts {
                    allowed: AllowedPairs::none(),
                    touching: task.contacts.touching.clone(),
                };
                if self.plans == 0
                    && let Some(first) = task.plan_to_start_of_line(&careful)
                {
                    return Ok(first);
                }
                task.contacts = careful;
            }
        }
        task.plan_free()
    }

    /// Plans; what is in the way while the robot still moves may be gone later.
    fn try_plan(&mut self, world: &World) -> Option<MotionStatus> {
        match self.replanning.next(world, BLOCKED_TIMEOUT) {
            Attempt::Later => return None,
            Attempt::GiveUp(failure) => return Some(MotionStatus::failed(failure)),
            Attempt::Now => {}
        }
        match self.plan(world) {
            Ok(follow) => {
                self.plans += 1;
                self.follow = Some(follow);
                self.replanning.reset();
                None
            }
            Err(failure) if failure.may_pass() => {
                self.replanning.failed(world, failure);
                None
            }
            Err(failure) => Some(MotionStatus::failed(failure)),
        }
    }

    /// Another job may have moved the torso, or the base under a goal in the map.
    fn arrived(&mut self, world: &World) -> Option<MotionStatus> {
        let base = world.robot_configuration().base;
        for (side, goal) in Side::BOTH.into_iter().zip(self.goals) {
            let Some(goal) = goal else { continue };
            let hand = tcp_in_base(world, side);
            let goal = in_base(goal, &base);
            let distance = distance_between(&hand, &goal);
            let angle = angle_between(&hand, &goal);
            if distance <= MISSED.0 && angle <= MISSED.1 {
                continue;
            }
            self.follow = None;
            let failure = MotionFailure::HandGoalMissed {
                side,
                distance,
                angle,
            };
            return (self.plans >= MOST_PLANS).then(|| MotionStatus::failed(failure));
        }
        Some(MotionStatus::Done(MotionOutcome::Arrived))
    }

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        if self.follow.is_none()
            && let Some(end) = self.try_plan(world)
        {
            return Some(end);
        }
        let follow = self.follow.as_mut()?;
        let hands = [
            world.models().description.arms[0].gripper.palm,
            world.models().description.arms[1].gripper.palm,
        ];
        match follow.tick(world, |link| hands.contains(&link)) {
            FollowStep::Moving => None,
            FollowStep::Blocked { still, .. } if still < BLOCKED_TIMEOUT => None,
            FollowStep::Blocked { hit, .. } if self.plans >= MOST_PLANS => {
                Some(MotionStatus::failed(MotionFailure::ArmBlocked {
                    hit: hit.into(),
                }))
            }
            FollowStep::Blocked { .. } => {
                self.follow = None;
                None
            }
            FollowStep::Stuck(stuck) => Some(MotionStatus::failed(MotionFailure::HeldObjectStuck(
                Box::new(stuck),
            ))),
            FollowStep::Arrived => self.arrived(world),
        }
    }
}

/// The goal in the frame of the base.
pub(super) fn in_base(goal: PoseGoal, base: &Pose) -> Pose {
    match goal {
        PoseGoal::InBase(pose) => pose,
        PoseGoal::InMap(pose) => base.inverse() * pose,
    }
}

impl Motion for MoveTcp {
    fn module(&self) -> ProcessModule {
        ProcessModule::Arms
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        if self.ended {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        match self.step(world) {
            None => MotionStatus::Running,
            Some(end) => {
                self.ended = true;
                end
            }
        }
    }

    fn cancel(&mut self) {
        self.ended = true;
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        self.follow.as_ref().map(JointFollower::planned)
    }

    fn before_planning(&self) -> Option<Box<dyn Motion>> {
        if self.follow.is_some() || self.ended {
            return None;
        }
        Some(Box::new(self.clone()))
    }

    fn progress(&self) -> Progress {
        let what = match self.path {
            TcpPath::Free => "reaching",
            TcpPath::Straight => "moving the hand straight",
        };
        Progress {
            what,
            fraction: self.follow.as_ref().map_or(0.0, JointFollower::fraction),
        }
    }
}
