//! Turning a planned path of the arms into a trajectory that stays on it.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use super::configuration_checker::ConfigurationChecker;
use super::joint_path::{JointPathEffort, JointPathFailure, find_joint_path};
use super::planning_group::PlanningGroup;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::trajectories::axis_group::AxisGroup;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::world::{CollisionHit, World};

/// A path of the axes from their current positions to the goal, as a trajectory.
pub(crate) fn plan_joint_trajectory(
    world: &World,
    group: &PlanningGroup,
    goal: &[f64],
    checker: &mut ConfigurationChecker<'_>,
    effort: JointPathEffort,
) -> Result<Trajectory, MotionFailure> {
    // One generator per plan, seeded by simulated time: a plan depends only on the world.
    let mut rng = Pcg64::seed_from_u64(world.steps());
    let mut blocked = |q: &[f64]| checker.blocked(q);
    let path = find_joint_path(
        &group.axes,
        &group.now(world),
        goal,
        effort,
        &mut rng,
        &mut blocked,
    )
    .map_err(path_failure)?;
    let limits = speeds::limits_of(&world.models().description, &group.joints);
    Ok(smooth(&path, &limits, checker))
}

/// The path as a trajectory, with corners rounded where that is collision-free.
pub(super) fn smooth(
    path: &[Vec<f64>],
    limits: &[AxisGroup],
    checker: &mut ConfigurationChecker<'_>,
) -> Trajectory {
    Trajectory::rounded(path, limits, &mut |q| checker.blocked(q).is_none())
}

fn path_failure(failure: JointPathFailure<CollisionHit>) -> MotionFailure {
    match failure {
        JointPathFailure::Start(hit) => MotionFailure::ArmStartInCollision { hit: hit.into() },
        JointPathFailure::Goal(hit) => MotionFailure::ArmGoalInCollision { hit: hit.into() },
        JointPathFailure::NotFound { blocker, samples } => MotionFailure::ArmPathNotFound {
            hit: blocker.into(),
            samples,
        },
    }
}
