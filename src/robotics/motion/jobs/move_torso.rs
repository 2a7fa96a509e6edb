//! Raising and lowering the torso.

use super::job::{Job, MotionOutcome, check_finite};
use super::joint_motion::{Arrival, JointGoal, JointMotion};
use crate::motion::contact::expected_contacts::ExpectedContacts;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::failure::process_module::ProcessModule;
use crate::motion::planning::configuration_checker::{ConfigurationChecker, PLAN_MARGIN};
use crate::motion::planning::joint_plan::JointPlan;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::robot::{JointId, Limits};
use crate::world::{AllowedPairs, CollisionHit, World};

/// A goal farther outside the limits than this (m) is a failure.
const CROPPED: f64 = 1e-4;
/// Heights this far apart (m) are checked on the way: no more than the clearance that is kept.
const STEP: f64 = PLAN_MARGIN;

/// Moves the torso to a height. Where the goal is beyond the joint's limits, or something is in the way
/// of the robot or of what it holds, the torso moves as far as possible, and then the motion fails.
pub(crate) type MoveTorso = Job<JointMotion<TorsoGoal>>;

/// A goal height of the torso.
#[derive(Clone, Debug)]
pub(crate) struct TorsoGoal {
    /// Position (m) of the lift joint.
    height: f64,
    /// What is in the way behind the end of the trajectory.
    ahead: Option<CollisionHit>,
}

impl MoveTorso {
    /// Moves to the height (m) of the lift joint.
    pub fn new(height: f64) -> Self {
        Self::begin(JointMotion::to(TorsoGoal {
            height,
            ahead: None,
        }))
    }
}

/// How far the torso can be moved from one height (m) towards another, and what is in the way there.
fn free_way(world: &World, lift: JointId, from: f64, to: f64) -> (f64, Option<CollisionHit>) {
    let contacts = ExpectedContacts::default();
    let mut checker = ConfigurationChecker::new(world, vec![lift], &contacts);
    let steps = ((to - from).abs() / STEP).ceil();
    let mut free = from;
    let mut step = 1.0;
    while step <= steps {
        let next = from + (to - from) * (step / steps);
        if let Some(hit) = checker.blocked(&[next]) {
            return (free, Some(hit));
        }
        free = next;
        step += 1.0;
    }
    (free, None)
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
    /// Arms that move meanwhile may free the way.
    const MAX_PLANS: u32 = 8;

    fn what(&self) -> &'static str {
        "moving the torso"
    }

    fn plan(&mut self, world: &World, _: u32) -> Result<JointPlan, MotionFailure> {
        check_finite(Self::MODULE, &[self.height])?;
        let lift = world.models().description.torso.joint;
        let joints: Vec<_> = lift.into_iter().collect();
        let path = match lift {
            Some(lift) => {
                let (now, goal) = (height(world), limits(world).clamp(self.height));
                let (free, hit) = free_way(world, lift, now, goal);
                if let Some(hit) = hit.as_ref().filter(|_| free == now) {
                    return Err(self.blocked(world, hit.clone()));
                }
                self.ahead = hit;
                vec![vec![now], vec![free]]
            }
            None => vec![],
        };
        let speeds = speeds::limits_of(&world.models().description, &joints);
        let trajectory = Trajectory::new(&path, &speeds);
        Ok(JointPlan::new(joints, trajectory, AllowedPairs::none()))
    }

    fn arrived(&mut self, world: &mut World) -> Arrival {
        if let Some(hit) = self.ahead.take() {
            return Arrival::Missed(self.blocked(world, hit));
        }
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
