//! Moving a set of joints along a trajectory, one guarded step at a time.

use super::failure::MotionFailure;
use super::guard;
use super::job::{PlannedTrajectory, TrajectoryAxes};
use super::pushing::Pushing;
use super::standstill::StandstillTimer;
use super::trajectory::Trajectory;
use super::trajectory_follower::TrajectoryFollower;
use crate::robot::{JointId, LinkId};
use crate::world::{AllowedPairs, CollisionHit, RobotConfiguration, World};

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

/// Joints that follow a trajectory. Axes of the trajectory beyond the joints only limit its
/// speed.
#[derive(Clone, Debug)]
pub struct JointFollower {
    joints: Vec<JointId>,
    follower: TrajectoryFollower,
    allowed: AllowedPairs,
    standstill: StandstillTimer,
    /// The world's step when the joints began to move.
    began: Option<u64>,
    pushing: Pushing,
}

impl JointFollower {
    pub(super) fn new(joints: Vec<JointId>, trajectory: Trajectory, allowed: AllowedPairs) -> Self {
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

    /// The robot at the end of the trajectory.
    pub(super) fn end(&self, robot: &RobotConfiguration) -> RobotConfiguration {
        with_joints(robot, &self.joints, self.follower.trajectory().last())
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

/// The configuration with some joints at other positions.
pub(super) fn with_joints(
    robot: &RobotConfiguration,
    joints: &[JointId],
    positions: &[f64],
) -> RobotConfiguration {
    let mut there = robot.clone();
    for (joint, position) in joints.iter().zip(positions) {
        there.joints.set(*joint, *position);
    }
    there
}
