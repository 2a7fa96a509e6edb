//! A frame in the form in which many boxes are placed fast.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Matrix, Pose as ParryPose, Vector};

use super::oriented_box::OrientedBox;

/// A body's frame, with its axes as the columns of a matrix.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    pub(super) turn: Matrix,
    origin: Vector,
}

impl Frame {
    /// The frame at a pose.
    #[inline]
    pub fn new(pose: &ParryPose) -> Self {
        Self {
            turn: Matrix::from_quat(pose.rotation),
            origin: pose.translation,
        }
    }

    /// The bounds of a box that is given in this frame (m), in the frame of the pose.
    #[inline]
    pub(crate) fn bounds_of(&self, body: &OrientedBox) -> Aabb {
        let center = self.place(body.center);
        let half = self.turn.abs() * body.half;
        Aabb::new(center - half, center + half)
    }

    /// A point of this frame, in the frame of the pose (m).
    #[inline]
    pub(super) fn place(&self, point: Vector) -> Vector {
        self.turn * point + self.origin
    }
}
