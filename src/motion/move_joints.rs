//! Moving one or both arms to given joint positions, around what is in the way.

use super::configuration_checker::ConfigurationChecker;
use super::expected_contacts::ExpectedContacts;
use super::failure::MotionFailure;
use super::job::{
    Motion, MotionOutcome, MotionStatus, PlannedTrajectory, ProcessModule, Progress, check_finite,
};
use super::joint_follower::{FollowStep, JointFollower, with_joints};
use super::joint_limit::violation;
use super::joint_path::JointPathEffort;
use super::joint_trajectory::plan_joint_trajectory;
use super::planning_group::PlanningGroup;
use super::replanning::{Attempt, Replanning};
use crate::robot::{ARM_JOINTS, Side};
use crate::spatial::trig;
use crate::world::{AllowedPairs, World};

/// How long (s) a plan or the way may be blocked while nothing moves.
const BLOCKED_TIMEOUT: f64 = 0.3;
/// How often a path is searched before giving up.
const MOST_PLANS: u32 = 4;

/// Moves the joints of one or both arms. Both arrive at the same time.
#[derive(Clone, Debug)]
pub(crate) struct MoveJoints {
    goals: [Option<Vec<f64>>; 2],
    follow: Option<JointFollower>,
    replanning: Replanning,
    plans: u32,
    ended: bool,
}

impl MoveJoints {
    /// The positions (rad) of the left and of the right arm, from the shoulder to the wrist;
    /// an arm without positions stays. Continuous joints turn the shorter way.
    pub(crate) fn new(left: Option<Vec<f64>>, right: Option<Vec<f64>>) -> Self {
        Self {
            goals: [left, right],
            follow: None,
            replanning: Replanning::default(),
            plans: 0,
            ended: false,
        }
    }

    fn sides(&self) -> Vec<Side> {
        Side::BOTH
            .into_iter()
            .filter(|s| self.goals[s.index()].is_some())
            .collect()
    }

    /// The goals one after the other, within hard limits.
    fn goal(&self, world: &World, group: &PlanningGroup) -> Result<Vec<f64>, MotionFailure> {
        let mut goal = Vec::new();
        for (side, given) in Side::BOTH.into_iter().zip(&self.goals) {
            let Some(given) = given else { continue };
            if given.len() != ARM_JOINTS {
                let (given, expected) = (given.len(), ARM_JOINTS);
                return Err(MotionFailure::JointCount {
                    side,
                    given,
                    expected,
                });
            }
            goal.extend(given);
        }
        check_finite(ProcessModule::Arms, &goal)?;
        let tree = &world.models().robot;
        let joints = group.joints.iter().zip(group.now(world));
        for ((&id, now), wanted) in joints.zip(&mut goal) {
            let joint = tree.joint(id);
            match joint.limits {
                Some(l) if l.excess(*wanted) > 0.0 => {
                    let violation = violation(joint, l, *wanted);
                    return Err(MotionFailure::JointLimit { violation });
                }
                Some(_) => {}
                None => *wanted = now + trig::wrap(*wanted - now),
            }
        }
        Ok(goal)
    }

    fn plan(&self, world: &World) -> Result<JointFollower, MotionFailure> {
        let group = PlanningGroup::new(world, false, &self.sides());
        let goal = self.goal(world, &group)?;
        let none = AllowedPairs::none();
        let contacts = ExpectedContacts::default();
        let mut checker = ConfigurationChecker::new(world, group.joints.clone(), &contacts);
        checker.accept_goal(&goal);
        let trajectory = plan_joint_trajectory(
            world,
            &group,
            &goal,
            &mut checker,
            JointPathEffort::default(),
        )?;
        Ok(JointFollower::new(group.joints, trajectory, none))
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
            FollowStep::Arrived => {
                self.name_positions(world);
                Some(MotionStatus::Done(MotionOutcome::Arrived))
            }
        }
    }

    /// Gives the joints the very numbers that were asked for: continuous joints were unwound.
    fn name_positions(&self, world: &mut World) {
        let group = PlanningGroup::new(world, false, &self.sides());
        let goal: Vec<f64> = self.goals.iter().flatten().flatten().copied().collect();
        let exact = with_joints(world.robot_configuration(), &group.joints, &goal);
        world.set_robot_configuration(&exact);
    }
}

impl Motion for MoveJoints {
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
        let fraction = self.follow.as_ref().map_or(0.0, JointFollower::fraction);
        Progress {
            what: "moving the arms",
            fraction,
        }
    }
}
