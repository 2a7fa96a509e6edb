//! A quick test that two bodies are far apart, by boxes that contain them.
//!
//! Two convex bodies are at least as far apart as their extents along any axis. Here the axes are
//! the normals of both boxes, which suffices to tell most pairs apart that are (Gottschalk, Lin and
//! Manocha: OBBTree, 1996, with the normals only).

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Vector;

use super::frame::Frame;

/// A box that contains a body, in the body's frame.
#[derive(Clone, Copy, Debug)]
pub struct OrientedBox {
    pub(super) center: Vector,
    /// Half of the size along each axis (m).
    pub(super) half: Vector,
}

impl OrientedBox {
    /// The bounds, given in the body's frame (m).
    pub fn new(bounds: &Aabb) -> Self {
        Self {
            center: bounds.center(),
            half: bounds.half_extents(),
        }
    }

    /// Whether two bodies, in their frames, are farther apart than the gap (m), which is not
    /// negative. The answer may be no for bodies that are.
    #[inline]
    pub(crate) fn is_apart(&self, frame: &Frame, other: &Self, at: &Frame, gap: f64) -> bool {
        let between = at.place(other.center) - frame.place(self.center);
        let gap = Vector::splat(gap);
        // Column by column, the axes of the other box in the frame of this one.
        let turn = frame.turn.transpose() * at.turn;
        let cosines = turn.abs();
        let along = frame.turn.mul_transpose_vec3(between).abs();
        if along.cmpgt(self.half + gap + cosines * other.half).any() {
            return true;
        }
        let along = at.turn.mul_transpose_vec3(between).abs();
        let reach = other.half + gap + cosines.mul_transpose_vec3(self.half);
        along.cmpgt(reach).any()
    }
}

#[cfg(test)]
mod tests {
    use parry3d_f64::math::{Pose as ParryPose, Rotation};
    use parry3d_f64::query;
    use parry3d_f64::shape::Cuboid;
    use proptest::prelude::*;

    use super::*;

    fn size() -> impl Strategy<Value = Vector> {
        (0.01f64..1.0, 0.01f64..1.0, 0.01f64..1.0).prop_map(|(x, y, z)| Vector::new(x, y, z))
    }

    fn pose() -> impl Strategy<Value = ParryPose> {
        let number = || -1.0f64..1.0;
        let place = (number(), number(), number());
        let turn = (number(), number(), number(), 0.1f64..1.0);
        (place, turn).prop_map(|((x, y, z), (i, j, k, w))| {
            let turn = Rotation::from_xyzw(i, j, k, w).normalize();
            ParryPose::from_parts(Vector::new(x, y, z), turn)
        })
    }

    fn around(half: Vector) -> OrientedBox {
        OrientedBox::new(&Aabb::new(-half, half))
    }

    proptest! {
        #[test]
        fn boxes_that_are_apart_are_farther_apart_than_the_gap(
            (one, at) in (size(), pose()),
            (other, there) in (size(), pose()),
            gap in 0.0f64..0.2,
        ) {
            let (frame, far) = (Frame::new(&at), Frame::new(&there));
            let is_apart = around(one).is_apart(&frame, &around(other), &far, gap);
            prop_assert_eq!(is_apart, around(other).is_apart(&far, &around(one), &frame, gap));
            let (one, other) = (Cuboid::new(one), Cuboid::new(other));
            let near = query::contact(&at, &one, &there, &other, gap).unwrap();
            let is_near = near.is_some_and(|contact| contact.dist < gap - 1e-9);
            prop_assert!(!(is_apart && is_near), "{near:?} with a gap of {gap}");
        }

        #[test]
        fn boxes_on_both_sides_of_a_face_are_apart(
            (one, at) in (size(), pose()),
            (other, turned) in (size(), pose()),
            gap in 0.0f64..0.2,
        ) {
            let turned = ParryPose::from_parts(Vector::ZERO, turned.rotation);
            // How far the other box reaches towards this one.
            let reach = (Frame::new(&turned).bounds_of(&around(other)).maxs).z;
            let up = Vector::Z * (one.z + reach + gap + 1e-6);
            let above = at * ParryPose::from_parts(up, turned.rotation);
            let is_apart = around(one).is_apart(
                &Frame::new(&at),
                &around(other),
                &Frame::new(&above),
                gap,
            );
            prop_assert!(is_apart);
        }
    }
}
