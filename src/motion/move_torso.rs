//! Raising and lowering the torso.

use super::failure::MotionFailure;
use super::job::{Motion, MotionOutcome, MotionStatus, ProcessModule, Progress, check_finite};
use super::joint_follower::{FollowStep, JointFollower};
use super::speeds;
use super::trajectory::{Corners, Trajectory};
use crate::robot::Limits;
use crate::world::{AllowedPairs, World};

/// A goal farther outside of the limits than this (m) is a failure.
const CROPPED: f64 = 1e-4;
/// How long (s) the way may be blocked while nothing moves: longer than the arms wait before
/// they look for another way.
const BLOCKED_TIMEOUT: f64 = 1.0;

/// Moves the torso to a height. A goal beyond the joint's limits is first cropped and
/// reached as far as possible, then reported.
#[derive(Clone, Debug)]
pub(crate) struct MoveTorso {
    goal: f64,
    follow: Option<JointFollower>,
    ended: bool,
}

impl MoveTorso {
    /// To the height (m) of the lift joint.
    pub(crate) fn new(goal: f64) -> Self {
        Self {
            goal,
            follow: None,
            ended: false,
        }
    }

    fn limits(world: &World) -> Limits {
        world.models().description.torso.limits
    }

    fn start(&self, world: &World) -> JointFollower {
        let joints = vec![world.models().description.torso.joint];
        let now = world
            .robot_configuration()
            .joints
            .get(world.models().description.torso.joint);
        let points = [vec![now], vec![Self::limits(world).clamp(self.goal)]];
        let limits = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&points, &limits, Corners::Round);
        JointFollower::new(joints, trajectory, AllowedPairs::none())
    }

    fn arrived(&self, world: &World) -> MotionStatus {
        let limits = Self::limits(world);
        if limits.excess(self.goal) <= CROPPED {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        MotionStatus::failed(MotionFailure::TorsoGoalOutOfLimits {
            goal: self.goal,
            lower: limits.lower,
            upper: limits.upper,
        })
    }
}

impl Motion for MoveTorso {
    fn module(&self) -> ProcessModule {
        ProcessModule::Torso
    }

    fn tick(&mut self, world: &mut World) -> MotionStatus {
        if self.ended {
            return MotionStatus::Done(MotionOutcome::Arrived);
        }
        if let Err(failure) = check_finite(ProcessModule::Torso, &[self.goal]) {
            self.ended = true;
            return MotionStatus::failed(failure);
        }
        let mut follow = self.follow.take().unwrap_or_else(|| self.start(world));
        let step = follow.tick(world, |_| true);
        self.follow = Some(follow);
        let end = match step {
            FollowStep::Moving => return MotionStatus::Running,
            FollowStep::Blocked { still, .. } if still < BLOCKED_TIMEOUT => {
                return MotionStatus::Running;
            }
            FollowStep::Blocked { hit, .. } => MotionStatus::failed(MotionFailure::TorsoBlocked {
                goal: self.goal,
                height: world
                    .robot_configuration()
                    .joints
                    .get(world.models().description.torso.joint),
                hit: hit.into(),
            }),
            FollowStep::Stuck(stuck) => {
                MotionStatus::failed(MotionFailure::HeldObjectStuck(Box::new(stuck)))
            }
            FollowStep::Arrived => self.arrived(world),
        };
        self.ended = true;
        end
    }

    fn cancel(&mut self) {
        self.ended = true;
    }

    fn progress(&self) -> Progress {
        let fraction = self.follow.as_ref().map_or(0.0, JointFollower::fraction);
        Progress {
            what: "moving the torso",
            fraction,
        }
    }
}
