//! Limits of speed and acceleration of the axes of a trajectory.

use std::ops::Range;

/// Limits that apply to some neighbouring axes together: to the Euclidean norms of their
/// velocities and accelerations. A single joint is a group of one.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisGroup {
    /// The axes of the group.
    pub axes: Range<usize>,
    /// Greatest speed (rad/s or m/s), positive.
    pub velocity: f64,
    /// Greatest acceleration (rad/s² or m/s²), positive.
    pub acceleration: f64,
}

impl AxisGroup {
    /// The limits of a single axis.
    pub fn single(axis: usize, velocity: f64, acceleration: f64) -> Self {
        Self {
            axes: axis..axis + 1,
            velocity,
            acceleration,
        }
    }

    /// Scalar product of the group's parts of two vectors; missing numbers count as 0.
    pub(super) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        let product = |axis: usize| Some(a.get(axis)? * b.get(axis)?);
        self.axes.clone().filter_map(product).sum()
    }

    /// Norm of the group's part of a vector.
    pub(super) fn norm(&self, vector: &[f64]) -> f64 {
        self.dot(vector, vector).sqrt()
    }
}
