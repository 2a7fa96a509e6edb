//! Raising and lowering the torso.

use super::job::{Job, MotionOutcome, check_finite};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::Limits;
use crate::world::{AllowedPairs, CollisionHit, World};

/// A goal farther outside the limits than this (m) is a failure.
const CROPPED: f64 = 1e-4;

/// Moves the torso to a height. A goal beyond the joint's limits is clamped, the torso moves
/// as far as possible, and then the motion fails.
pub(crate) type MoveTorso = Job<JointMotion<TorsoGoal>>;

/// A goal height of the torso.
#[derive(Clone, Debug)]
pub(crate) struct TorsoGoal {
    /// Position (m) of the lift joint.
    height: f64,
}

impl MoveTorso {
    /// Moves to the height (m) of the lift joint.
    pub fn new(height: f64) -> Self {
        Self::begin(JointMotion::to(TorsoGoal { height }))
    }
}

fn limits(world: &World) -> Limits {
    world.models().description.torso.limits
}

fn height(world: &World) -> f64 {
    let torso = &world.models().description.torso;
    torso.height(&world.robot_configuration().joints)
}

impl JointGoal for TorsoGoal {
    const MODULE: ProcessModule = ProcessModule::Torso;
    /// Longer than the arms wait before they look for another path.
    const BLOCKED_TIMEOUT: f64 = 1.0;

    fn what(&self) -> &'static str {
        "moving the torso"
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        check_finite(Self::MODULE, &[self.height])?;
        let lift = world.models().description.torso.joint;
        let joints: Vec<_> = lift.into_iter().collect();
        let path = match lift {
            Some(_) => vec![vec![height(world)], vec![limits(world).clamp(self.height)]],
            None => vec![],
        };
        let speeds = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&path, &speeds);
        Ok(JointPlan::new(joints, trajectory, AllowedPairs::none()))
    }

    fn arrived(&mut self, world: &mut World) -> Arrival {
        let limits = limits(world);
        if limits.excess(self.height) <= CROPPED {
            return Arrival::Done(MotionOutcome::Arrived);
        }
        Arrival::Failed(MotionFailure::TorsoGoalOutOfLimits {
            goal: self.height,
            lower: limits.lower,
            upper: limits.upper,
        })
    }

    fn blocked(&self, world: &World, hit: CollisionHit) -> MotionFailure {
        MotionFailure::TorsoBlocked {
            goal: self.height,
            height: height(world),
            hit: hit.into(),
        }
    }
}
