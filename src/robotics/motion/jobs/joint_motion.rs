//! What all motions of joints to a goal share: planning a trajectory, following it, and
//! replanning if it is blocked.

use nalgebra::Point3;

use super::job::{Activity, MotionOutcome, MotionStatus, Progress};
use super::joint_follower::{FollowStep, JointFollower};
use super::replanning::{Attempt, Replanning};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::planning::rigid_loop::broken_loop;
use crate::motion::trajectories::planned_trajectory::PlannedTrajectory;
use crate::robot::LinkId;
use crate::world::{CollisionHit, World};

/// A goal for joints: how to plan a trajectory to it, and when it counts as reached.
pub trait JointGoal: Clone + 'static {
    /// The part of the robot that moves.
    const MODULE: ProcessModule;
    /// How long (s) planning or the trajectory may stay blocked while nothing moves.
    const BLOCKED_TIMEOUT: f64;
    /// How many trajectories are planned before giving up.
    const MAX_PLANS: u32 = 1;
    /// Whether planning searches for a path, which may take seconds.
    const SEARCHES: bool = false;

    /// What the robot is doing, such as "looking".
    fn what(&self) -> &'static str;

    /// Lets the robot miss the goal by as much as it errs. Called before each plan.
    fn err(&mut self, _: &mut World) {}

    /// The plan to the goal; `plans` is the number of earlier plans.
    fn plan(&mut self, world: &World, plans: u32) -> Result<JointPlan, MotionFailure>;

    /// The links whose held objects must follow.
    fn carriers(&self, world: &World) -> Vec<LinkId> {
        let arms = world.models().description.arms.iter();
        arms.map(|arm| arm.gripper.palm).collect()
    }

    /// What ends the motion before the trajectory does, if anything; `fraction` (0..1) of the
    /// trajectory has been completed.
    fn met(&self, _: &World, _fraction: f64) -> Option<MotionOutcome> {
        None
    }

    /// Called in each step while the trajectory is followed.
    fn follows(&self, _: &mut World) {}

    /// How the motion ends at the end of the trajectory.
    fn arrived(&mut self, _: &mut World) -> Arrival {
        Arrival::Done(MotionOutcome::Arrived)
    }

    /// The point (m) of the map at which it aims the head.
    fn aims_at(&self, _: &World) -> Option<Point3<f64>> {
        None
    }

    /// The failure of a motion that was stopped and could not continue.
    fn blocked(&self, world: &World, hit: CollisionHit) -> MotionFailure;
}

/// The state at the end of a trajectory.
#[derive(Debug)]
pub enum Arrival {
    /// The goal is reached.
    Done(MotionOutcome),
    /// The goal was reached only as far as possible.
    Failed(MotionFailure),
    /// The goal has moved meanwhile; a new trajectory may lead there.
    Missed(MotionFailure),
}

/// A motion of joints to a goal.
#[derive(Clone, Debug)]
pub struct JointMotion<G> {
    goal: G,
    follower: Option<JointFollower>,
    replanning: Replanning,
    plans: u32,
}

impl<G: JointGoal> JointMotion<G> {
    /// A motion to the goal from where the joints are when it starts.
    pub(super) fn to(goal: G) -> Self {
        Self {
            goal,
            follower: None,
            replanning: Replanning::default(),
            plans: 0,
        }
    }

    /// The goal.
    pub(super) fn goal(&self) -> &G {
        &self.goal
    }

    /// The goal, to complete it before the motion starts.
    pub(super) fn goal_mut(&mut self) -> &mut G {
        &mut self.goal
    }

    /// Plans. What is in the way while the robot is still moving may be gone later.
    fn try_plan(&mut self, world: &mut World) -> Result<(), MotionFailure> {
        match self.replanning.next(world, G::BLOCKED_TIMEOUT) {
            Attempt::Later => return Ok(()),
            Attempt::GiveUp(failure) => return Err(failure),
            Attempt::Now => {}
        }
        self.goal.err(world);
        match self.goal.plan(world, self.plans) {
            Ok(plan) => {
                if let Some(broken) = broken_loop(world, &plan) {
                    return Err(MotionFailure::LoopBroken(Box::new(broken)));
                }
                self.plans += 1;
                self.follower = Some(JointFollower::new(plan));
                self.replanning.reset();
                Ok(())
            }
            Err(failure) if G::MAX_PLANS > 1 && failure.may_pass() => {
                self.replanning.failed(world, failure);
                Ok(())
            }
            Err(failure) => Err(failure),
        }
    }

    /// Replans in the next step, unless that has been done often enough.
    fn plan_anew(&mut self, failure: MotionFailure) -> Result<(), MotionFailure> {
        if self.plans >= G::MAX_PLANS {
            return Err(failure);
        }
        self.follower = None;
        Ok(())
    }

    /// Advances by one step; returns the result if the motion ends.
    fn go_on(&mut self, world: &mut World) -> Result<Option<MotionOutcome>, MotionFailure> {
        if self.follower.is_none() {
            self.try_plan(world)?;
        }
        let Some(follower) = &mut self.follower else {
            return Ok(None);
        };
        let met = self.goal.met(world, follower.fraction());
        if met.is_some() {
            return Ok(met);
        }
        self.goal.follows(world);
        let carriers = self.goal.carriers(world);
        match follower.tick(world, |link| carriers.contains(&link)) {
            FollowStep::Moving => {}
            FollowStep::Blocked { still, .. } if still < G::BLOCKED_TIMEOUT => {}
            FollowStep::Blocked { hit, .. } => {
                let failure = self.goal.blocked(world, hit);
                self.plan_anew(failure)?;
            }
            FollowStep::Trouble(failure) => return Err(*failure),
            FollowStep::Arrived => match self.goal.arrived(world) {
                Arrival::Done(outcome) => return Ok(Some(outcome)),
                Arrival::Failed(failure) => return Err(failure),
                Arrival::Missed(failure) => self.plan_anew(failure)?,
            },
        }
        Ok(None)
    }
}

impl<G: JointGoal> Activity for JointMotion<G> {
    const MODULE: ProcessModule = G::MODULE;

    fn step(&mut self, world: &mut World) -> Option<MotionStatus> {
        match self.go_on(world) {
            Ok(None) => None,
            Ok(Some(outcome)) => Some(MotionStatus::Done(outcome)),
            Err(failure) => Some(MotionStatus::failed(failure)),
        }
    }

    fn progress(&self) -> Progress {
        Progress {
            what: self.goal.what(),
            fraction: self.follower.as_ref().map_or(0.0, JointFollower::fraction),
        }
    }

    fn is_moving(&self) -> bool {
        self.follower.as_ref().is_some_and(JointFollower::is_moving)
    }

    fn brake(&mut self, world: &mut World) {
        if let Some(follower) = &mut self.follower {
            follower.brake(world);
        }
    }

    fn planned(&self) -> Option<PlannedTrajectory<'_>> {
        let shown = self.follower.as_ref().filter(|_| G::SEARCHES);
        shown.map(JointFollower::planned)
    }

    fn aims_at(&self, world: &World) -> Option<Point3<f64>> {
        self.goal.aims_at(world)
    }

    fn may_search(&self) -> bool {
        G::SEARCHES && self.follower.is_none()
    }
}
