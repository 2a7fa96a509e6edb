//! Where a solid is in the map frame.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose as ParryPose;

use super::frame::Frame;
use super::oriented_box::OrientedBox;
use super::solid::Solid;

/// The place of a solid in the map frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedSolid {
    /// Pose of the primitive.
    pub(crate) pose: ParryPose,
    /// The same as a frame.
    pub(crate) frame: Frame,
    /// Bounds (m).
    pub(crate) bounds: Aabb,
}

impl PlacedSolid {
    /// The place of a solid whose owner is at a pose in the map frame.
    pub(crate) fn new(solid: &Solid, owner: &ParryPose) -> Self {
        Self::at(&(owner * solid.pose), &solid.containing_box)
    }

    /// The place of a primitive with that pose and that box about it.
    pub(crate) fn at(pose: &ParryPose, containing_box: &OrientedBox) -> Self {
        let frame = Frame::new(pose);
        Self {
            pose: *pose,
            frame,
            bounds: frame.bounds_of(containing_box),
        }
    }
}
