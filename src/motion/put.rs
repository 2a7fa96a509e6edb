//! Putting a held object down.
//!
//! The hand goes straight to the goal, slowly, and ends as soon as something carries the
//! object: earlier than the goal when the surface is higher, below the goal when it is lower.
//! Without any surface within reach below the goal it ends in the goal.

use super::cartesian_path::tcp_in_base;
use super::expected_contacts::{CollisionMode, ExpectedContacts};
use super::failure::MotionFailure;
use super::hold::held_objects;
use super::job::{
    Motion, MotionOutcome, MotionStatus, PlannedTrajectory, ProcessModule, Progress, check_finite,
    numbers_of,
};
use super::joint_follower::{FollowStep, JointFollower};
use super::move_tcp::{PoseGoal, in_base};
use super::pose_goal::PoseGoalTask;
use super::put_plan::PutPlan;
use crate::robot::Side;
use crate::world::{BodyName, World};

/// How far (m) below the goal a surface is looked for.
const DEPTH: f64 = 0.10;
/// Force (N) from which on something carries the object.
const CARRIED: f64 = 0.5;
/// How long (s) the way may be blocked while nothing moves.
const BLOCKED_TIMEOUT: f64 = 0.3;

/// Puts down what a hand holds.
#[derive(Clone, Debug)]
pub(crate) struct Put {
    side: Side,
    goal: PoseGoal,
    object: String,
    follow: Option<JointFollower>,
    ended: bool,
}

impl Put {
    /// With the tool centre point going to the goal.
    pub(crate) fn new(side: Side, goal: PoseGoal) -> Self {
        Self {
            side,
            goal,
            object: String::new(),
            follow: None,
            ended: false,
        }
    }

    fn plan(&mut self, world: &World) -> Result<JointFollower, MotionFailure> {
        let side = self.side;
        let held = held_objects(world, side).into_iter().next();
        self.object = held.ok_or(MotionFailure::HoldsNothing { side })?;
        let goal = in_base(self.goal, &world.robot_configuration().base);
        check_finite(ProcessModule::Arms, &numbers_of(&goal))?;
        let goals = vec![(side, goal)];
        let contacts = ExpectedContacts::of(world, [side].into_iter(), CollisionMode::AllowAll);
        let task = PoseGoalTask {
            world,
            goals,
            contacts,
        };
        let object = BodyName::Object(self.object.clone());
        PutPlan {
            task,
            side,
            object,
            depth: DEPTH,
        }
        .plan()
    }

    /// What carries the object, if anything does.
    fn support(&self, world: &World) -> Option<BodyName> {
        let forces = world.supports(&self.object).ok()?;
        let most = forces
            .into_iter()
            .max_by(|a, b| a.force.total_cmp(&b.force))?;
        (most.force > CARRIED).then_some(most.body)
    }

    fn done(&self, world: &World, support: Option<BodyName>) -> MotionStatus {
        let base = world.robot_configuration().base;
        let hand = tcp_in_base(world, self.side);
        let raised = hand.translation.z - in_base(self.goal, &base).translation.z;
        MotionStatus::Done(MotionOutcome::Put { support, raised })
    }

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        if self.follow.is_none() {
            match self.plan(world) {
                Ok(follow) => self.follow = Some(follow),
                Err(failure) => return Some(MotionStatus::failed(failure)),
            }
        }
        let support = self.support(world);
        let follow = self.follow.as_mut()?;
        // What the object stood on when the way began does not count at once.
        if support.is_some() && follow.fraction() > 0.1 {
            return Some(self.done(world, support));
        }
        let palm = world.models().description.arm(self.side).gripper.palm;
        match follow.tick(world, |link| link == palm) {
            FollowStep::Moving => None,
            FollowStep::Blocked { still, .. } if still < BLOCKED_TIMEOUT => None,
            FollowStep::Blocked { hit, .. } => {
                Some(MotionStatus::failed(MotionFailure::ArmBlocked {
                    hit: hit.into(),
                }))
            }
            FollowStep::Stuck(stuck) => Some(MotionStatus::failed(MotionFailure::HeldObjectStuck(
                Box::new(stuck),
            ))),
            FollowStep::Arrived => Some(self.done(world, None)),
        }
    }
}

impl Motion for Put {
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

    fn progress(&self) -> Progress {
        Progress {
            what: "putting down",
            fraction: self.follow.as_ref().map_or(0.0, JointFollower::fraction),
        }
    }
}
