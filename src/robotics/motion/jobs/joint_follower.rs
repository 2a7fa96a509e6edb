//! Moving a set of joints along a trajectory, one guarded step at a time.

use super::standstill::StandstillTimer;
use crate::motion::contact::guard;
use crate::motion::contact::pushing::Pushing;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::planning::configuration::with_joints;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::planned_trajectory::{PlannedTrajectory, TrajectoryAxes};
use crate::motion::trajectories::trajectory_follower::TrajectoryFollower;
use crate::robot::{JointId, LinkId};
use crate::world::{AllowedPairs, CollisionHit, World};

/// The outcome of a step.
#[derive(Debug)]
pub(super) enum FollowStep {
    /// The joints continue.
    Moving,
    /// The joints are at the end of the trajectory.
    Arrived,
    /// The step was refused.
    Blocked {
        /// What would touch.
        hit: CollisionHit,
        /// How long (s) the whole robot has not moved.
        still: f64,
    },
    /// A held object does not follow the hand, is too heavy, or has slipped away; or another one is
    /// pressed onto something or pushed along.
    Trouble(Box<MotionFailure>),
}

/// Joints that follow a plan.
#[derive(Clone, Debug)]
pub(super) struct JointFollower {
    joints: Vec<JointId>,
    follower: TrajectoryFollower,
    allowed: AllowedPairs,
    standstill: StandstillTimer,
    /// The world's step when the joints began to move.
    began: Option<u64>,
    pushing: Pushing,
}

impl JointFollower {
    pub(super) fn new(plan: JointPlan) -> Self {
        let JointPlan {
            joints,
            trajectory,
            allowed,
        } = plan;
        let follower = TrajectoryFollower::new(trajectory);
        Self {
            joints,
            follower,
            allowed,
            standstill: StandstillTimer::default(),
            began: None,
            pushing: Pushing::default(),
        }
    }

    /// The planned trajectory.
    pub(super) fn planned(&self) -> PlannedTrajectory<'_> {
        PlannedTrajectory {
            axes: TrajectoryAxes::Joints(&self.joints),
            trajectory: self.follower.trajectory(),
        }
    }

    pub(super) fn fraction(&self) -> f64 {
        self.follower.fraction()
    }

    /// Sets the joints for the next step; objects held by links for which `is_hand` must follow.
    pub(super) fn tick(
        &mut self,
        world: &mut World,
        is_hand: impl Fn(LinkId) -> bool,
    ) -> FollowStep {
        let began = *self.began.get_or_insert(world.steps());
        if let Some(failure) = guard::trouble_with_held(world, began, is_hand) {
            return FollowStep::Trouble(Box::new(failure));
        }
        if let Some(pinned) = self.pushing.pinned(world, &self.allowed) {
            let failure = MotionFailure::ObjectPinned(Box::new(pinned));
            return FollowStep::Trouble(Box::new(failure));
        }
        if let Some(pushed) = self.pushing.pushed(world, &self.allowed) {
            let failure = MotionFailure::ObjectPushed(Box::new(pushed));
            return FollowStep::Trouble(Box::new(failure));
        }
        if self.follower.is_at_end() {
            return FollowStep::Arrived;
        }
        let next = with_joints(
            world.robot_configuration(),
            &self.joints,
            &self.follower.next(),
        );
        match guard::obstacle(world, &next, &self.allowed) {
            None => {
                self.follower.advance();
                self.standstill.reset();
                world.set_robot_configuration(&next);
                FollowStep::Moving
            }
            Some(hit) => {
                self.follower.hold();
                FollowStep::Blocked {
                    hit,
                    still: self.standstill.wait(world),
                }
            }
        }
    }

    pub(super) fn is_moving(&self) -> bool {
        self.follower.is_moving()
    }

    /// Sets the joints for a step of braking; a step that would collide is not taken.
    pub(super) fn brake(&mut self, world: &mut World) {
        let robot = world.robot_configuration();
        let next = with_joints(robot, &self.joints, &self.follower.next());
        if guard::obstacle(world, &next, &self.allowed).is_some() {
            self.follower.stop();
            return;
        }
        self.follower.brake();
        world.set_robot_configuration(&next);
    }
}
