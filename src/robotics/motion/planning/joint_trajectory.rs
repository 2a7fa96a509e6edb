//! Turning a planned path of the arms into a trajectory that stays on it.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use super::configuration_checker::{ConfigurationChecker, PathObstacle};
use super::joint_path::{JointPathEffort, JointPathFailure, Settle, find_joint_path};
use super::planning_group::PlanningGroup;
use crate::motion::failure::motion_failure::MotionFailure;
use crate::motion::trajectories::axis_group::AxisGroup;
use crate::motion::trajectories::speeds;
use crate::motion::trajectories::trajectory::Trajectory;
use crate::world::World;

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
    let level = checker.level().clone();
    let settle = |q: &mut [f64]| level.settle(q);
    let constraint: Option<&Settle<'_>> = (!level.is_empty()).then_some(&settle);
    let path = find_joint_path(
        &group.axes,
        &group.now(world),
        goal,
        effort,
        &mut rng,
        checker,
        constraint,
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
    Trajectory::rounded(path, limits, &mut |q| checker.is_free_on_way(q))
}

fn path_failure(failure: JointPathFailure<PathObstacle>) -> MotionFailure {
    use JointPathFailure::{Goal, NotFound, Start};
    use PathObstacle::{Tilt, Touch};
    match failure {
        Start(Touch(hit)) => MotionFailure::ArmStartInCollision { hit: hit.into() },
        Goal(Touch(hit)) => MotionFailure::ArmGoalInCollision { hit: hit.into() },
        NotFound {
            blocker: Touch(hit),
            samples,
        } => MotionFailure::ArmPathNotFound {
            hit: hit.into(),
            samples,
        },
        Start(Tilt(tilt)) | Goal(Tilt(tilt)) => MotionFailure::NoLevelPath {
            tilt: tilt.into(),
            samples: 0,
        },
        NotFound {
            blocker: Tilt(tilt),
            samples,
        } => MotionFailure::NoLevelPath {
            tilt: tilt.into(),
            samples,
        },
    }
}
