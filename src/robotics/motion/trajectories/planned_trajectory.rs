//! A trajectory with what its numbers mean.

use super::trajectory::Trajectory;
use crate::robot::JointId;

/// A planned trajectory.
#[derive(Clone, Copy, Debug)]
pub struct PlannedTrajectory<'a> {
    /// What the numbers of the trajectory mean.
    pub axes: TrajectoryAxes<'a>,
    /// The positions of the axes over time.
    pub trajectory: &'a Trajectory,
}

/// What moves along a trajectory.
#[derive(Clone, Copy, Debug)]
pub enum TrajectoryAxes<'a> {
    /// The base: x, y (m) and heading (rad) in the map.
    Base,
    /// Joints (rad or m); further axes of the trajectory move nothing.
    Joints(&'a [JointId]),
}
