//! From a planned path of the arms to a trajectory that keeps to it.

use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use super::arm_axes::ArmAxes;
use super::arm_path::{ArmPathEffort, ArmPathFailure, find_arm_path};
use super::failure::MotionFailure;
use super::judge::Judge;
use super::speeds;
use super::trajectory::{AxisGroup, Corners, Trajectory};
use crate::world::{CollisionHit, World};

/// Time (s) between two places of a trajectory that are checked.
const CHECK_EVERY: f64 = 0.02;

/// A path of the axes from where they are now to the goal, as a trajectory.
pub(super) fn plan_way(
    world: &World,
    axes: &ArmAxes,
    goal: &[f64],
    judge: &mut Judge<'_>,
    effort: ArmPathEffort,
) -> Result<Trajectory, MotionFailure> {
    // One generator per plan, seeded by the time: a plan depends on nothing but the world.
    let mut rng = Pcg64::seed_from_u64(world.steps());
    let mut blocked = |q: &[f64]| judge.blocked(q);
    let path = find_arm_path(
        &axes.path,
        &axes.now(world),
        goal,
        effort,
        &mut rng,
        &mut blocked,
    )
    .map_err(path_failure)?;
    let limits = speeds::limits_of(&world.models().description, &axes.joints);
    Ok(smooth(&path, &limits, judge))
}

/// The path with rounded corners where they are free, and stops in them otherwise.
pub(super) fn smooth(path: &[Vec<f64>], limits: &[AxisGroup], judge: &mut Judge<'_>) -> Trajectory {
    let round = Trajectory::new(path, limits, Corners::Round);
    if path.len() <= 2 || is_free(&round, judge) {
        return round;
    }
    Trajectory::new(path, limits, Corners::Stop)
}

fn is_free(way: &Trajectory, judge: &mut Judge<'_>) -> bool {
    let parts = (way.duration() / CHECK_EVERY).ceil().max(1.0) as u32;
    (1..parts).all(|i| {
        let t = way.duration() * f64::from(i) / f64::from(parts);
        judge.blocked(&way.position(t)).is_none()
    })
}

fn path_failure(failure: ArmPathFailure<CollisionHit>) -> MotionFailure {
    match failure {
        ArmPathFailure::Start(hit) => MotionFailure::ArmStartInCollision { hit: hit.into() },
        ArmPathFailure::Goal(hit) => MotionFailure::ArmGoalInCollision { hit: hit.into() },
        ArmPathFailure::NotFound { blocker, samples } => MotionFailure::ArmPathNotFound {
            hit: blocker.into(),
            samples,
        },
    }
}
