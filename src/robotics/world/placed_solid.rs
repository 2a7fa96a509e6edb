//! Where a solid is in the map frame.

use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::Pose as ParryPose;

use super::frame::Frame;
use super::oriented_box::OrientedBox;
use super::solid::Solid;

/// The place of a solid in the map frame.
#[derive(Clone, Copy, Debug)]
pub struct PlacedSolid {
    /// Pose of the primitive.
    pub pose: ParryPose,
    /// The same as a frame.
    pub frame: Frame,
    /// Bounds (m).
    pub bounds: Aabb,
}

impl PlacedSolid {
    /// The place of a solid whose owner is at a pose in the map frame.
    pub fn new(solid: &Solid, owner: &ParryPose) -> Self {
        Self::at(&(owner * solid.pose), &solid.containing_box)
    }

    /// The place of a primitive with that pose and that box about it.
    pub fn at(pose: &ParryPose, containing_box: &OrientedBox) -> Self {
        let frame = Frame::new(pose);
        Self {
            pose: *pose,
            frame,
            bounds: frame.bounds_of(containing_box),
        }
    }
}
